// What ranges (ranged.hpp) are computed under, a thread's own: the errors that are permitted, whose
// lane's decisions are followed one way after another, and the way that is being followed.
//
// A comparison of ranges that overlap has no answer. In the lane that is followed it stays open
// until something depends on it; then one answer is taken, the other one is left for the next run
// of the same stages. In every other lane, and where no lane is followed, it stays a "maybe", of
// which both sides are taken together: no more is known of those lanes, and all that is said of
// them is true.
#pragma once

#include <cstdint>

#include "quadrel/num/range/error_budget.hpp"

namespace quadrel {

/// What depends on rounding, a set of bits. Part of the file format (channel "undecided").
struct Undecided {
    static constexpr std::uint32_t coverage = 1, hit = 2, cell = 4, mip_level = 8, cube_face = 16,
                                   branch = 32;
};

struct RangeContext {
    /// Open comparisons of one run, and answers that one run may need.
    static constexpr int most_open = 4096, most_answers = 64;
    /// Questions whether any lane goes on, of one run and of all runs of a lane: an undecided lane
    /// may never be through with a loop.
    static constexpr int most_questions = 8192, most_questions_of_lane = 65536;

    ErrorBudget budget;
    std::uint64_t maps = 0;      ///< which textures there are: another number for others
    std::int32_t followed = -1;  ///< lane of the quad; none if negative
    std::uint32_t kind = 0;      ///< what a decision that is met now is about

    /// Lanes in which both sides of a decision were taken together.
    std::uint32_t joined = 0;
    std::uint32_t undecided[4] = {};  ///< kinds, a lane
    bool too_many = false;            ///< the limits above were not enough

    std::int32_t open = 0;          ///< comparisons that were left open in this run
    std::int8_t answer[most_open];  ///< theirs: -1 none yet
    std::int32_t answers = 0;       ///< taken in this run
    std::int32_t given = 0;         ///< how many of them are what the way says
    std::int8_t way[most_answers];
    std::int32_t questions = 0, questions_of_lane = 0;
    std::int32_t shared_errors = 0;  ///< groups of named errors so far
    std::int32_t unit_vectors = 0;   ///< likewise

    /// Before the stages run.
    void begin_run() {
        open = answers = questions = 0;
        joined = 0;
        shared_errors = unit_vectors = 0;
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

    /// A comparison that is left open; negative where no more can be.
    std::int32_t leave_open() {
        if (open == most_open) {
            too_many = true;
            return -1;
        }
        answer[open] = -1;
        return open++;
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
