// Chains: stages that run one after another on a packet before the next packet's turn. The stages'
// own texts, over another view of a packet (local_io.hpp): what one hands to the next stays in
// registers or on the stack, and what others read goes into the batch's arrays as ever.
#pragma once

#include <tuple>
#include <utility>

#include "kernels/groups.hpp"
#include "kernels/local_io.hpp"

// Under the sanitizers every copy of a function has its checks: compiling would take minutes.
#ifdef __SANITIZE_ADDRESS__
#define QUADREL_FLAT
#else
#define QUADREL_FLAT [[gnu::flatten]]
#endif

namespace quadrel {

/// Stages in the order of a plan. One that serves a light at a time stands for any number of
/// lights.
template <class... S>
struct Chain {
    static constexpr std::size_t length = sizeof...(S);
    static constexpr const char* ids[] = {S::text.id...};
    template <std::size_t at>
    using Stage = std::tuple_element_t<at, std::tuple<S...>>;

    /// Whether a stage before the one at `at` stores the value.
    static constexpr bool stores_before(std::size_t at, Value v) {
        std::size_t i = 0;
        return ((i++ < at && contains(S::outputs, v)) || ...);
    }
    /// Whether a stage behind the one at `at` loads it.
    static constexpr bool loads_behind(std::size_t at, Value v) {
        std::size_t i = 0;
        return ((i++ > at && contains(S::inputs, v)) || ...);
    }
};

/// Runs the stage at `at` on one packet, for all of its lights.
template <class Chain, std::size_t at, class F>
void run_link(const StageCall& call, const ChainStage& stage, int lane,
              LocalValues<Chain, F>& values, BrokenPromises<F>& broken) {
    using Stage = typename Chain::template Stage<at>;
    const auto& params = *static_cast<const typename Stage::Params*>(stage.parameters);
    for (int light = stage.first_light; light < stage.end_light; ++light) {
        LocalIo<Chain, at, F> io(call, lane, light, values, broken);
        Stage()(io, params);
        if constexpr (contains(Stage::outputs, Value::hit_s)) broken.end_search();
        if constexpr (!serves_lights<Stage>()) break;
    }
}

template <class Chain, class F, std::size_t... at>
bool run_links(const StageCall& call, const ChainStage* stages, std::index_sequence<at...>) {
    Mask<F> broken(false);
    for (int lane = 0; lane < call.lanes; lane += lanes_of<F>) {
        LocalValues<Chain, F> values;
        BrokenPromises<F> found;
        (run_link<Chain, at, F>(call, stages[at], lane, values, found), ...);
        broken = broken | found.any_rule;
    }
    const bool kept = none(broken);
    leave<F>();
    return kept;
}

/// Runs a chain over a batch. Flat: a call hands packets over in memory, which is what chains are
/// to spare. Functions that say so stay out of line.
template <class Chain, class F>
QUADREL_FLAT bool run_chain(const StageCall* call, const ChainStage* stages) {
    return run_links<Chain, F>(*call, stages, std::make_index_sequence<Chain::length>());
}

template <class... C>
struct ChainList {};

/// The rows of a list of chains on one number type.
template <class F, class... C>
ChainGroup chain_rows(ChainList<C...>) {
    static const ChainRow rows[] = {
        {C::ids, static_cast<std::int32_t>(C::length), &run_chain<C, F>}...};
    return {rows, sizeof...(C)};
}

}  // namespace quadrel
