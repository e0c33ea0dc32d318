#include <algorithm>
#include <array>
#include <string_view>

#include "quadrel/compare.hpp"

namespace quadrel {
namespace {

/// Full names and groups in the order in which a fragment's values are made.
constexpr std::array data_flow = {
    std::string_view{"id"},
    std::string_view{"quad"},
    std::string_view{"A"},
    std::string_view{"depth"},
    std::string_view{"P"},
    std::string_view{"Ng"},
    std::string_view{"uv"},
    std::string_view{"bary"},
    std::string_view{"dPdx"},
    std::string_view{"dPdy"},
    std::string_view{"dUVdx"},
    std::string_view{"dUVdy"},
    std::string_view{"relief.depth"},
    std::string_view{"T"},
    std::string_view{"B."},  // the bitangent; "B" is blue
    std::string_view{"frame_normal"},
    std::string_view{"J"},
    std::string_view{"r"},
    std::string_view{"K"},
    std::string_view{"oracle"},
    std::string_view{"certified"},
    std::string_view{"lod.rho"},
    std::string_view{"lod.lambda"},
    std::string_view{"lod.level"},
    std::string_view{"lod.frac"},
    std::string_view{"hit.U"},
    std::string_view{"hit.V"},
    std::string_view{"hit.s"},
    std::string_view{"hit.h"},
    std::string_view{"hit.P"},
    std::string_view{"frag.depth"},
    std::string_view{"Z"},
    std::string_view{"hit.status"},
    std::string_view{"hit.flags"},
    std::string_view{"hit.steps"},
    std::string_view{"hit.fetches"},
    std::string_view{"exact"},
    std::string_view{"derr"},
    std::string_view{"N"},
    std::string_view{"shadow"},
    std::string_view{"occlusion"},
    std::string_view{"light.ambient"},
    std::string_view{"light.diffuse"},
    std::string_view{"light.specular"},
    std::string_view{"light.emissive"},
    std::string_view{"light.reflection"},
    std::string_view{"light.refraction"},
    std::string_view{"integral"},
    std::string_view{"R"},
    std::string_view{"G"},
    std::string_view{"B"},
    std::string_view{"err"},
    std::string_view{"bound"},
    std::string_view{"gpu"},
    std::string_view{"undecided"},
};

/// Whether a row of the order is the channel or a group that it belongs to.
bool covers(std::string_view row, std::string_view channel) {
    if (row.ends_with('.')) return channel.starts_with(row);
    if (row == "B") return channel == row;
    return channel == row || (channel.starts_with(row) && channel[row.size()] == '.');
}

std::vector<const ChannelReport*> in_data_flow(const CompareReport& report) {
    std::vector<const ChannelReport*> channels;
    for (const ChannelReport& channel : report.channels) channels.push_back(&channel);
    std::stable_sort(channels.begin(), channels.end(),
                     [](const ChannelReport* a, const ChannelReport* b) {
                         return data_flow_rank(a->name) < data_flow_rank(b->name);
                     });
    return channels;
}

/// The last in data flow that does not pass and of which a pixel is known, or null.
const ChannelReport* find_symptom(const std::vector<const ChannelReport*>& channels) {
    const auto last = std::find_if(
        channels.rbegin(), channels.rend(),
        [](const ChannelReport* channel) { return !channel->passes() && !channel->worst.empty(); });
    return last == channels.rend() ? nullptr : *last;
}

}  // namespace

std::size_t data_flow_rank(const std::string& channel) {
    const auto row = std::find_if(data_flow.begin(), data_flow.end(),
                                  [&](std::string_view one) { return covers(one, channel); });
    return static_cast<std::size_t>(row - data_flow.begin());
}

std::optional<Blame> find_blame(const Film& reference, const Film& test, const CompareRules& rules,
                                const CompareReport& report) {
    const std::vector<const ChannelReport*> channels = in_data_flow(report);
    const ChannelReport* symptom = find_symptom(channels);
    if (symptom == nullptr) return std::nullopt;
    Blame blame;
    blame.x = symptom->worst[0].x;
    blame.y = symptom->worst[0].y;
    blame.symptom = symptom->name;
    const std::size_t i = reference.index(blame.x, blame.y);
    for (const ChannelReport* channel : channels) {
        blame.first = channel->name;
        blame.reference = reference.find(channel->name)->bits[i];
        blame.test = test.find(channel->name)->bits[i];
        if (exceeds(channel->type, rules.encoding_of(channel->name), channel->tolerance,
                    blame.reference, blame.test))
            break;
        blame.upstream.push_back(channel->name);
    }
    return blame;
}

}  // namespace quadrel
