// Searches that leave out steps by maxima of the map beside the same with every step made.
#pragma once

#include "relief/march/lattice_rays.hpp"

namespace quadrel::test {

/// A search at parameters for which there is something to leave out.
struct BoundedRow {
    std::string id;
    Parameters parameters;
};

inline std::vector<Value> outputs_but_counts(const std::string& id) {
    if (id.starts_with("shadow")) return {Value::shadow_visibility};
    std::vector<Value> list;
    for (const Value v : trace_outputs)
        if (v != Value::hit_steps && v != Value::hit_fetches) list.push_back(v);
    return list;
}

/// What a row of this id reads.
using FillInputs = std::function<void(Batch<float>&, const std::string& id, const Map&, Random&)>;
using Damage = std::function<void(DamagedMaxima&)>;

struct Looks {
    std::uint64_t all = 0, made = 0;
};

/// Runs a row with and without bounds over one map.
inline testing::AssertionResult leaves_no_trace(const StageUnderTest<float>& row,
                                                const Parameters& parameters,
                                                const FillInputs& fill, const Map& map,
                                                Random& random, const Damage& damage,
                                                Looks& looks) {
    Batch<float> with(64);
    with.bind(TextureSlot::height, map.sampled);
    fill(with, row.id, map, random);
    Batch<float> without = with;
    const auto maxima = height_maxima(*map.texture, map.sampled.sampler);
    DamagedMaxima damaged(maxima->maxima);
    if (damage) damage(damaged);
    // Never where they were the last time: a search remembers whether looking at them paid.
    static HeightMaxima places[2];
    static int place = 0;
    place = 1 - place;
    places[place] = damaged.maxima;
    with.material.maxima = &places[place];
    for (Batch<float>* batch : {&with, &without}) batch->counters = {};
    row.run(with, parameters);
    without.run(row.id, parameters);
    looks.made += with.fetches();
    looks.all += without.fetches();
    return same_bits<float>(with, without, outputs_but_counts(row.id));
}

inline testing::AssertionResult leaves_no_trace_on_all_maps(const StageUnderTest<float>& row,
                                                            const Parameters& parameters,
                                                            const FillInputs& fill, int maps,
                                                            const Damage& damage = {}) {
    Looks looks;
    const std::vector<StressMap> kinds = wild_maps();
    for (std::size_t kind = 0; kind < kinds.size(); ++kind)
        for (int i = 0; i < maps; ++i) {
            Random random(kind * 1000003 + static_cast<std::uint64_t>(i) * 7919 + 1);
            const Map map = make_wild_map(kinds[kind], random);
            const auto same = leaves_no_trace(row, parameters, fill, map, random, damage, looks);
            if (!same)
                return testing::AssertionFailure() << row.id << " on " << kinds[kind].name << " "
                                                   << i << ": " << same.message();
        }
    // Not more: packets of rays this different soon stop looking (look_memory.hpp).
    if (looks.made * 50 > looks.all * 49)
        return testing::AssertionFailure()
               << row.id << " makes " << looks.made << " look-ups of " << looks.all;
    return testing::AssertionSuccess();
}

}  // namespace quadrel::test
