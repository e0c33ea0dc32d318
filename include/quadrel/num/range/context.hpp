// What ranges (ranged.hpp) are computed under, a thread's own: the errors that are permitted, whose
// lane's decisions are followed one way after another, and the way that is being followed.
//
// A comparison of ranges that overlap has no answer. In the lane that is followed it stays open
// until something depends on it; then one answer is taken, the other one is left for the next run
// of the same stages. In every other lane, and where no lane is followed, it stays a "maybe", of
// which both sides are taken together: no more is known of those lanes, and all that is said of
// them is true. A lane of too many ways can be treated likewise (`together`).
#pragma once

#include <cstdint>
#include <utility>

#include "quadrel/num/range/error_budget.hpp"
#include "quadrel/num/range/interval.hpp"

namespace quadrel {

/// What depends on rounding, a set of bits. Part of the file format (channel "undecided").
struct Undecided {
    static constexpr std::uint32_t coverage = 1, hit = 2, cell = 4, mip_level = 8, cube_face = 16,
                                   branch = 32;
};

/// What is known of a number that a decision has chosen: it is in `rest` where a boolean (a
/// literal, see RangeContext) is true, in `taken` where it is not.
struct RangeAlternative {
    std::int32_t literal;
    RealInterval taken, rest;
};

struct RangeContext {
    /// Undecided booleans of one run, alternatives, and answers that one run may need.
    static constexpr int most_open = 8192, most_alternatives = 4096, most_answers = 64;
    /// Questions whether any lane goes on, of one run and of all runs of a lane: an undecided lane
    /// may never be through with a loop.
    static constexpr int most_questions = 8192, most_questions_of_lane = 65536;

    ErrorBudget budget;
    std::uint64_t maps = 0;      ///< which textures there are: another number for others
    std::uint64_t quad = 0;      ///< which quad of which material runs: likewise
    std::int32_t followed = -1;  ///< lane of the quad; none if negative
    std::uint32_t kind = 0;      ///< what a decision that is met now is about

    /// Which row and column of the quad differences are of: 1 the lower row, plus 2 the right
    /// column. Negative: any that are permitted.
    std::int32_t row_and_column = -1;
    /// The maps (by their texels) that are decoded from sRGB8.
    const float* const* srgb_maps = nullptr;
    std::int32_t srgb_map_count = 0;

    bool is_srgb_map(const float* texels) const {
        for (int i = 0; i < srgb_map_count; ++i)
            if (srgb_maps[i] == texels) return true;
        return false;
    }

    /// Lanes in which both sides of a decision were taken together.
    std::uint32_t joined = 0;
    std::uint32_t undecided[4] = {};  ///< kinds, per lane
    bool too_many = false;            ///< the limits above were not enough
    /// Kinds of decisions of which the followed lane takes both sides together, too.
    std::uint32_t together = 0;
    static constexpr std::uint32_t all_kinds = ~0u;

    std::int32_t open = 0;          ///< undecided booleans of this run
    std::int8_t answer[most_open];  ///< theirs: -1 none yet
    /// A boolean or its contrary is a literal: twice its number, and 1 for the contrary. Those
    /// that are "both a and b" have these two; others, negative numbers.
    std::int32_t parts[most_open][2];
    /// Where the number of "both a and b" is found: a hash table, a run's.
    struct Conjunction {
        std::int32_t a, b, number;
        std::uint32_t run;
    };
    Conjunction conjunctions[most_open];
    std::uint32_t run = 0;
    std::int32_t alternatives = 0;  ///< in use; number 0 is none
    RangeAlternative alternative[most_alternatives];
    std::int32_t answers = 0;  ///< taken in this run
    std::int32_t given = 0;    ///< how many of them are what the way says
    std::int8_t way[most_answers];
    std::int32_t questions = 0, questions_of_lane = 0;
    std::int32_t shared_errors = 0;  ///< groups of named errors so far
    std::int32_t unit_vectors = 0;   ///< likewise
    /// The groups of the coordinates of the place that is shaded, per lane; 0: none yet.
    std::int32_t places = 0;
    /// The level of detail of look-ups there, and of which map: what they share.
    struct PlaceLevel {
        std::int32_t place;
        const float* texels;
        RealInterval level;
    };
    PlaceLevel place_level[4] = {};

    /// Look-ups with the same gradients have the same level of detail, which may be far from known:
    /// a run takes the part of what the followed lane's may be from `level_from` to `level_to`.
    /// Levels are those of this map (by its texels), and the first look-up in it says which
    /// gradients are meant.
    const float* leveled_map = nullptr;
    double level_from = -std::numeric_limits<double>::infinity();
    double level_to = std::numeric_limits<double>::infinity();
    bool level_known[4] = {};            ///< whether a lane has asked for a level in this run
    RealInterval lane_level[4] = {};     ///< what it may be as a whole, and
    RealInterval clamped_level[4] = {};  ///< after the sampler's clamps

    bool takes_together() const { return together == all_kinds || (together & kind) != 0; }

    bool is_place(std::int32_t group) const {
        return places > 0 && group >= places && group < places + 4;
    }

    /// Before the stages run.
    void begin_run() {
        open = answers = questions = 0;
        joined = 0;
        shared_errors = unit_vectors = alternatives = places = 0;
        for (PlaceLevel& level : place_level) level.place = 0;
        for (bool& known : level_known) known = false;
        ++run;
    }
    /// Before the first run of a lane (none if negative).
    void begin_lane(std::int32_t lane) {
        followed = lane;
        given = questions_of_lane = 0;
        too_many = false;
    }
    /// After a run: the next way, if there is one.
    bool next_way() {
        int n = answers;
        while (n > 0 && way[n - 1] == 0) --n;
        if (n == 0) return false;
        way[n - 1] = 0;
        given = n;
        return true;
    }

    /// The number of a boolean that nothing is known of; negative where there are no more.
    std::int32_t new_boolean() {
        if (open == most_open) return -1;
        answer[open] = -1;
        parts[open][0] = parts[open][1] = -1;
        return open++;
    }
    /// Of a comparison that is left open; negative where no more can be.
    std::int32_t leave_open() {
        const std::int32_t number = new_boolean();
        too_many |= number < 0;
        return number;
    }
    /// The number of "both a and b", of literals: the same one each time.
    std::int32_t conjunction(std::int32_t a, std::int32_t b) {
        if (a > b) std::swap(a, b);
        const auto hash = static_cast<std::uint32_t>(a) * 0x9e3779b1u ^
                          static_cast<std::uint32_t>(b) * 0x85ebca6bu;
        Conjunction& entry = conjunctions[(hash >> 13) % most_open];
        if (entry.run == run && entry.a == a && entry.b == b) return entry.number;
        const std::int32_t number = new_boolean();
        if (number < 0) return number;
        parts[number][0] = a;
        parts[number][1] = b;
        entry = {a, b, number, run};
        return number;
    }
    bool is_part(std::int32_t literal, std::int32_t of) const {
        return (of & 1) == 0 && (parts[of >> 1][0] == literal || parts[of >> 1][1] == literal);
    }
    /// The number of an alternative; 0 where there are no more.
    std::int32_t keep(const RangeAlternative& what) {
        if (alternatives + 1 >= most_alternatives) return 0;
        alternative[++alternatives] = what;
        return alternatives;
    }
    /// The answer to an open comparison. "Yes" is tried first.
    bool decide(std::int32_t comparison) {
        std::int8_t& known = answer[comparison];
        if (known < 0) known = next_answer();
        return known != 0;
    }
    std::int8_t next_answer() {
        undecided[followed & 3] |= kind;
        if (answers == most_answers) {
            too_many = true;
            return 1;
        }
        if (answers >= given) way[answers] = 1;
        return way[answers++];
    }
    /// Whether there may be an answer to whether any lane goes on. Where there are too many, none
    /// does: what is computed from there on is not used.
    bool may_go_on() {
        too_many |= ++questions > most_questions || ++questions_of_lane > most_questions_of_lane;
        return !too_many;
    }
    /// Both sides are taken together in a lane.
    void join(int lane) {
        joined |= 1u << lane;
        undecided[lane] |= kind;
    }
};

/// This thread's.
inline RangeContext& range_context() {
    static constinit thread_local RangeContext context{};
    return context;
}

}  // namespace quadrel
