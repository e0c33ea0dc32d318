// The word for marches that move on by what the step before has left, such as sums, which rounding
// makes part of the next step's bits.
//
//     const Course course{at, passes, next};
//     for (const auto k : steps_on_course<F>(course, position, heights, active, first, last)) {
//         const F h = heights(active, course.at(position));
//         ...
//         active = active & course.passes(position, h);
//         position = select(active, course.next(position), position);
//         if (none(active)) break;
//     }
//
// gives first, first + 1, ... last, and leaves out steps at which every lane of `active` is known
// to pass: `position` then moves on without a look-up, by the same additions. A text may rely on
// nothing of a step that was left out but that; where a step reads what the one before has found,
// steps_on_course<F, Before::needed> gives the last step of each gap as well. Steps may end once
// `active` has no lane.
//
// The bound is the greatest height in the box of the coordinates that the march has now and some
// steps later, which are moved to beforehand: by whole steps, so that no margin has to stand for
// what sums round off.
#pragma once

#include "quadrel/relief/trace/search/beam.hpp"
#include "quadrel/relief/trace/search/look_memory.hpp"

namespace quadrel {

/// A march as steps that pass above the surface need it. `Position` is a number or a vector.
///   at(position)         the coordinates of the look-up. Each goes one way as positions follow
///                        each other, or stays
///   passes(position, h)  lanes whose march goes on if the look-up there gives h; where a lane's
///                        goes on, it would with any smaller h
///   next(position)
template <class At, class Passes, class Next>
struct Course {
    At at;
    Passes passes;
    Next next;
};
template <class At, class Passes, class Next>
Course(At, Passes, Next) -> Course<At, Passes, Next>;

/// Heights that say which levels their look-ups read in the lanes of `active` between two points.
template <class Heights, class F>
concept BoundedBetween = requires(const Heights& heights, Mask<F> active, vec2<F> uv) {
    { heights.levels_between(active, uv, uv, 1) } -> std::same_as<CeilingLevels>;
};

/// Steps `first` to `last` of the lanes of `active` but those at which all of them pass.
template <Packet F, Before before, class Along, class Position, class Heights>
class StepsOnCourse {
  public:
    class Iterator {
      public:
        explicit Iterator(StepsOnCourse& of) : of_(of) {}
        bool operator!=(int) const { return of_.goes_on(); }
        Step operator*() const { return Step(of_.k_); }
        void operator++() { of_.advance(); }

      private:
        StepsOnCourse& of_;
    };

    /// All must outlive this object. `own_last`: the last step per lane, part of its result.
    StepsOnCourse(const Along& course, Position& position, const Heights& heights,
                  const Mask<F>& active, int first, int last, F own_last)
        : course_(course),
          position_(position),
          heights_(heights),
          active_(active),
          previous_(position),
          k_(first),
          last_(last),
          own_last_(select(own_last == own_last, own_last, number<F>(first))),
          has_own_last_(any(own_last_ < number<F>(last))) {
        if (none(active)) return;
        const Scalar<F> highest = heights.highest();
        may_end_ = highest < std::numeric_limits<Scalar<F>>::infinity();
        pass_below(highest, end_of_passing() - k_);
        const HeightMaxima* const maxima = heights.maxima();
        if (maxima != nullptr && starts_slowly() && memory().looks(maxima)) {
            looks_ahead_ = true;
            look_ahead();
        }
        give_step_before(first);
    }
    StepsOnCourse(const StepsOnCourse&) = delete;
    ~StepsOnCourse() {
        if (looks_ahead_) memory().learn(gain_);
    }

    Iterator begin() { return Iterator(*this); }
    int end() const { return 0; }

  private:
    // Measured. In steps: how far looks ahead go, and what one must spare. In cells: what a box
    // must be shorter by to be worth a second look, and at how many a step the surface is met too
    // soon. In samples: after how many it is looked again.
    static constexpr int first_length = 16, longest = 128, worth_a_look = 4;
    static constexpr float cells_worth_a_look = 2, most_cells_a_step = 1;
    static constexpr int shortest_pause = 2, longest_pause = 16;
    /// In parts of a sample, likewise: what the memory is told of a look, and of a step left out.
    static constexpr int told_of_look = 16, step_spares = 8;

    static LookMemory& memory() { return look_memory<StepsOnCourse>(); }

    bool goes_on() const { return k_ <= last_ && (!may_end_ || any(active_)); }

    void advance() {
        ++k_;
        if (!looks_ahead_ || --until_look_ > 0) return;
        const int from = k_;
        look_ahead();
        give_step_before(from);
    }

    /// Back to the last step left out since `from`, where it is needed.
    void give_step_before(int from) {
        if constexpr (before == Before::needed) {
            if (k_ == from) return;
            position_ = previous_;
            --k_;
        }
    }

    /// Where the packet as a whole is slow enough for bounds of parts of the map.
    bool starts_slowly() {
        const vec2<F> now = course_.at(position_), then = course_.at(moved(position_));
        const F motion = max(abs(then.x - now.x), abs(then.y - now.y)) *
                         F(static_cast<Scalar<F>>(heights_.texels()));
        const Scalar<F> cells = greatest(motion, active_);
        if (!(cells <= static_cast<Scalar<F>>(most_cells_a_step))) return false;
        const Scalar<F> steps = static_cast<Scalar<F>>(cells_worth_a_look) / cells;
        shortest_ = steps < longest ? std::max(static_cast<int>(steps), worth_a_look) : longest;
        return true;
    }

    [[gnu::noinline]] void look_ahead() {
        if (none(active_)) return;
        const int from = k_, end = end_of_passing();
        for (;;) {
            const int length = std::min(length_, end - k_);
            if (length < worth_a_look) break;
            const int passed = look_ahead_by(length);
            gain_ += step_spares * passed - told_of_look - length / 2;
            if (passed == length) {
                length_ = std::min(2 * length_, longest);
            } else if (passed >= worth_a_look && length_ > shortest_) {
                length_ = std::max(length_ / 4, shortest_);
            } else {
                break;
            }
        }
        pause_ = k_ >= from + worth_a_look ? shortest_pause : std::min(2 * pause_, longest_pause);
        until_look_ = pause_;
    }

    /// The first step that must be made, whatever the surface is.
    int end_of_passing() const {
        if (!has_own_last_) return last_;
        const Scalar<F> own = least(own_last_, active_);
        if (!(own > static_cast<Scalar<F>>(k_))) return k_;
        return own < static_cast<Scalar<F>>(last_) ? static_cast<int>(own) : last_;
    }

    Position moved(const Position& from) const { return select(active_, course_.next(from), from); }

    /// Moves on while all lanes pass at heights up to `ceiling`, by up to `most` steps.
    int pass_below(Scalar<F> ceiling, int most) {
        if (!(ceiling < std::numeric_limits<Scalar<F>>::infinity())) return 0;
        const F h(ceiling);
        int passed = 0;
        for (; passed < most && none(active_ & !course_.passes(position_, h)); ++passed) {
            if constexpr (before == Before::needed) previous_ = position_;
            position_ = moved(position_);
        }
        k_ += passed;
        return passed;
    }

    /// The same at all that look-ups can give on the next `length` steps.
    int look_ahead_by(int length) {
        Position ahead = position_;
        for (int i = 0; i < length; ++i) ahead = moved(ahead);
        return pass_below(ceiling_between(course_.at(position_), course_.at(ahead), length),
                          length);
    }

    /// The greatest height that look-ups may give from one point to one `steps` steps on.
    Scalar<F> ceiling_between(const vec2<F>& from, const vec2<F>& to, int steps) const {
        const F low[4] = {min(from.x, to.x), -max(from.x, to.x), min(from.y, to.y),
                          -max(from.y, to.y)};
        Scalar<F> bound[4];
        if (!least_of_four(low, bound)) return std::numeric_limits<Scalar<F>>::infinity();
        // What reducing a coordinate and scaling it takes from a texel's is well below the margin.
        const auto at_least = [](Scalar<F> x) { return x - 0x1p-21 * (1 + std::abs(x)); };
        const UvBox box{at_least(bound[0]), -at_least(bound[1]), at_least(bound[2]),
                        -at_least(bound[3])};
        return static_cast<Scalar<F>>(
            height_ceiling(heights_.levels_between(active_, from, to, steps), box));
    }

    /// The least of the active lanes; false where it, or a lane, is beyond what bounds are good
    /// for.
    bool least_of_four(const F (&of)[4], Scalar<F> (&bound)[4]) const {
        const F limit(beam_limit);
        Mask<F> within(true);
        Scalar<F> lane[4][lanes_of<F>];
        for (int i = 0; i < 4; ++i) {
            within = within & (abs(of[i]) <= limit);
            store(lane[i], select(active_, of[i], limit));
        }
        if (any(active_ & !within)) return false;
        for (int half = lanes_of<F> / 2; half > 0; half /= 2)
            for (auto& row : lane)
                for (int i = 0; i < half; ++i)
                    row[i] = row[i] < row[i + half] ? row[i] : row[i + half];
        for (int i = 0; i < 4; ++i) bound[i] = lane[i][0];
        return true;
    }

    const Along& course_;
    Position& position_;
    const Heights& heights_;
    const Mask<F>& active_;
    Position previous_;  ///< at the step before k_, if that was left out
    int k_, last_;
    F own_last_;
    bool has_own_last_;
    bool looks_ahead_ = false;
    bool may_end_ = false;         ///< where no lane is active: nobody counts steps
    int shortest_ = worth_a_look;  ///< fewest steps to look ahead
    int length_ = first_length;    ///< how many next
    int pause_ = 1, until_look_ = 1;
    int gain_ = 0;  ///< of looks so far
};

/// `own_last`: see StepsOnCourse. A lane for which it is no number takes its first step.
template <Number F, Before before = Before::not_needed, class Along, class Position, class Heights>
auto steps_on_course(const Along& course, Position& position, const Heights& heights,
                     const Mask<F>& active, int first, int last,
                     F own_last = F(std::numeric_limits<Scalar<F>>::infinity())) {
    if constexpr (BoundedBetween<Heights, F>) {
        return StepsOnCourse<F, before, Along, Position, Heights>(course, position, heights, active,
                                                                  first, last, own_last);
    } else {
        return steps<F>(first, last);
    }
}

}  // namespace quadrel
