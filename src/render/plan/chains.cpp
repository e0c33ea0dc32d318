#include "render/plan/chains.hpp"

#include <algorithm>
#include <string_view>

namespace quadrel {
namespace {

/// How many stages from `first` on are one link: those of one id, light after light.
std::size_t link_length(const std::vector<PlannedStage>& stages, std::size_t first) {
    std::size_t n = 1;
    while (stages[first].light >= 0 && first + n < stages.size() &&
           stages[first + n].info == stages[first].info &&
           stages[first + n].light == stages[first].light + static_cast<int>(n))
        ++n;
    return n;
}

/// How many stages from `first` on the chain runs; 0 if it is another one.
std::size_t matched(const std::vector<PlannedStage>& stages, std::size_t first,
                    const ChainRow& row) {
    std::size_t at = first;
    for (int i = 0; i < row.length; ++i) {
        if (at == stages.size() || stages[at].info->text.id != std::string_view(row.ids[i]))
            return 0;
        at += link_length(stages, at);
    }
    return at - first;
}

/// Values that someone outside of the chains reads, or a link that none before it supplies.
ValueSet values_in_arrays(const MaterialPlan& plan) {
    ValueSet arrays = plan.wanted;
    std::size_t at = 0;
    const auto read_up_to = [&](std::size_t end, bool chained) {
        ValueSet local;
        for (; at < end; ++at) {
            for (const Value v : plan.stages[at].info->inputs)
                if (!local[static_cast<std::size_t>(v)]) arrays.set(static_cast<std::size_t>(v));
            if (!chained) continue;
            for (const Value v : plan.stages[at].info->outputs)
                local.set(static_cast<std::size_t>(v));
        }
    };
    for (const PlannedChain& chain : plan.chains) {
        read_up_to(chain.first, false);
        read_up_to(chain.end, true);
    }
    read_up_to(plan.stages.size(), false);
    return arrays;
}

}  // namespace

void find_chains(MaterialPlan& plan, const KernelTable& table) {
    const std::vector<ChainRow> rows = all_chains(table);
    for (std::size_t at = 0; at < plan.stages.size();) {
        PlannedChain best;
        for (const ChainRow& row : rows)
            if (const std::size_t n = matched(plan.stages, at, row); n > 0 && at + n > best.end)
                best = {at, at + n, row.run};
        if (best.run != nullptr) plan.chains.push_back(best);
        at = best.run != nullptr ? best.end : at + 1;
    }
    plan.in_arrays = values_in_arrays(plan);
}

std::vector<ChainStage> chain_stages(const MaterialPlan& plan, const PlannedChain& chain) {
    std::vector<ChainStage> links;
    for (std::size_t at = chain.first; at < chain.end;) {
        const PlannedStage& stage = plan.stages[at];
        const auto n = link_length(plan.stages, at);
        const int first_light = std::max(stage.light, 0);
        links.push_back(
            {stage.params.data(), first_light, first_light + static_cast<std::int32_t>(n)});
        at += n;
    }
    return links;
}

}  // namespace quadrel
