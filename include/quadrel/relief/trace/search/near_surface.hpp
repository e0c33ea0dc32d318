// The word for loops over a ray's samples that may leave out those above the surface.
//
//     for (const auto k : steps_near_surface<F>(height, ray, active, n, last)) { ... }
//
// gives 0, 1, ... last in order, and leaves out steps at which a lane of `active` is known to be
// above the surface: k is a lane's own. A text may rely on nothing of a step that was left out but
// that; where it reads the sample before, `Before::needed` has the last step of each gap given as
// well. While other lanes go on, one that is through gets steps beyond `last`: texts take it out of
// `active`.
//
// Two bounds leave out steps. The packet as a beam is led through the pyramid of maxima. Where it
// is near the surface, each lane goes by the gap that its last look-up has left between the ray and
// the surface: the two approach each other by no more a step than the ray comes down and the
// steepest slope around rises. Where neither spares what it takes, packets stop asking
// (look_memory.hpp).
#pragma once

#include "quadrel/relief/cells.hpp"
#include "quadrel/relief/trace/search/beam.hpp"
#include "quadrel/relief/trace/search/look_memory.hpp"

namespace quadrel {

/// Marches of fewer steps make them all: there is less to gain than looking ahead takes. Measured.
inline constexpr int fewest_steps_to_leave_out = 96;

/// The numbers of a step, per lane.
template <Packet F>
struct LaneSteps {
    F k;
};

template <Number F>
F number(const LaneSteps<F>& step) {
    return step.k;
}

/// How many steps a lane's ray stays above the surface after a look-up.
template <Packet F>
class GapLeaps {
  public:
    GapLeaps() = default;
    GapLeaps(const CeilingLevels& levels, const LatticeRays<F>& rays, Mask<F> active) {
        const HeightMaxima& maxima = *levels.maxima;
        const int count = levels.coarsest - levels.finest + 1;
        if (maxima.continuous == 0 || !levels.continuous || count > most_levels) return;
        coming_down_ = -rays.height_step;
        rounding_ = F(2 * maxima.rounding + 0x1p-21f);
        farthest_ = F(std::numeric_limits<Scalar<F>>::infinity());
        for (int i = 0; i < count; ++i) add_level(i, maxima.level[levels.finest + i], rays);
        // A leap of a step or two is not worth asking for.
        if (any(active & (farthest_ >= F(3)))) count_ = count;
    }

    /// Steps that may be left out after the one that `last` is the look-up of.
    F operator()(const LastLook<F>& last) const {
        if (count_ == 0) return F(0);
        F gap = last.gap, closing(1e-30f);
        for (int i = 0; i < count_; ++i) {
            const OfLevel& of = levels_[i];
            const F slope = slope_at(*of.level, last.uv);
            gap = min(gap, last.gap - slope * of.displaced);
            closing = max(closing, coming_down_ + slope * of.cells_a_step);
        }
        gap = gap - rounding_;
        return select(gap > F(0), floor(min(gap / closing, farthest_)), F(0));
    }

  private:
    /// Where the slopes around coordinate u are stored. A cell beside the right one will do.
    static Int<F> texel(F u, std::int32_t texels, std::int32_t first, std::int32_t count,
                        bool repeat) {
        F cell;
        if (repeat) {
            const F turns = u * F(static_cast<float>(texels) / static_cast<float>(count));
            cell = (turns - floor(turns)) * number<F>(count) - F(0.5f);
            cell = select(cell < F(0), cell + number<F>(count), cell);
        } else {
            cell = u * number<F>(texels) - F(0.5f) - number<F>(first);
            cell = min(max(cell, F(0)), number<F>(count - 1));
        }
        return to_int(cell * F(0.25f));
    }

    static F slope_at(const LevelMaxima& of, const vec2<F>& uv) {
        const Int<F> x = texel(uv.x, of.width, of.first_x, of.count_x, of.repeat_x != 0);
        const Int<F> y = texel(uv.y, of.height, of.first_y, of.count_y, of.repeat_y != 0);
        return gather<F>(of.slopes.texels, y * Int<F>(of.slopes.width[0]) + x);
    }

    void add_level(int i, const LevelMaxima& level, const LatticeRays<F>& rays) {
        const F width = number<F>(level.width), height = number<F>(level.height);
        const F x = abs(rays.uv_step.x) * width, y = abs(rays.uv_step.y) * height;
        // A look-up is off by less than this, in cells, and so are those after it.
        const F largest = abs(rays.uv.x) + abs(rays.uv.y) + abs(rays.reach.x) + abs(rays.reach.y);
        const F off = F(0x1p-20f) * max(width, height) * (F(1) + largest);
        levels_[i] = {&level, x + y, off + off};
        farthest_ = min(farthest_, select(off < F(0.125f), F(1.75f) / max(x, y), F(0)));
    }

    /// Levels that lanes may read; a packet of more is left to the beam.
    static constexpr int most_levels = 3;
    struct OfLevel {
        const LevelMaxima* level = nullptr;
        F cells_a_step = F(0), displaced = F(0);
    };
    OfLevel levels_[most_levels];
    int count_ = 0;  ///< 0: nothing is known
    F rounding_ = F(0), coming_down_ = F(0), farthest_ = F(0);
};

/// Steps 0 to `last` of the lanes of `active`, those left out at which their rays are above the
/// surface.
template <Packet F, class Height>
class StepsNearSurface {
  public:
    class Iterator {
      public:
        explicit Iterator(StepsNearSurface& of) : of_(of) {}
        bool operator!=(int) const { return of_.any_left(); }
        LaneSteps<F> operator*() const { return {of_.next_}; }
        void operator++() { of_.advance(); }

      private:
        StepsNearSurface& of_;
    };

    /// `active` may lose lanes while the loop runs; it and `height` must outlive this object.
    StepsNearSurface(const Height& height, const LatticeRays<F>& rays, const Mask<F>& active,
                     int first, int last, Before before)
        : height_(height),
          rays_(rays),
          active_(active),
          next_(number<F>(first)),
          end_(F(static_cast<Scalar<F>>(last))),
          last_(last),
          before_(before) {
        if (last < fewest_steps_to_leave_out) return;
        levels_ = height.ceiling(active);
        if (levels_.maxima == nullptr) return;
        memory_ = &look_memory<StepsNearSurface>();
        if (!memory_->looks(levels_.maxima)) {
            levels_.maxima = nullptr;
            return;
        }
        must_take_ = rays.last;
        gap_leaps_ = GapLeaps<F>(levels_, rays, active);
        start_beam();
    }
    StepsNearSurface(const StepsNearSurface&) = delete;
    ~StepsNearSurface() {
        if (levels_.maxima != nullptr) memory_->learn(gain());
    }

    Iterator begin() { return Iterator(*this); }
    int end() const { return 0; }

  private:
    /// In cells: over less, a second look at the same nodes would gain nothing.
    static constexpr double cells_worth_a_look = 2;
    /// In samples, between looks of the beam. Measured.
    static constexpr int shortest_pause = 4, longest_pause = 16;

    /// Looks are paid for by steps left out, and by a part of those made: where the surface is near
    /// all along, they end. Measured, in parts of a sample.
    static constexpr int look_costs = 24, step_spares = 8, first_credit = 72;
    /// In the same parts, what the memory is told of starting, of asking for a leap by gaps, and of
    /// a look. Measured: at four fifths of it white noise loses a twentieth, at more of it bricks.
    static constexpr int told_of_start = 40, told_of_gap_look = 5, told_of_look = 20;

    /// Of the whole packet, beside every step made until the lanes that were left at the end were
    /// through.
    int gain() const {
        const Scalar<F> last = greatest(next_, last_left_) - Scalar<F>(1);
        if (!(last >= 0 && last <= static_cast<Scalar<F>>(last_))) return 0;
        return step_spares * (static_cast<int>(last) + 1 - samples_) - spent_;
    }

    bool any_left() {
        const Mask<F> left = active_ & (next_ <= end_);
        if (none(left)) return false;
        last_left_ = left;
        return true;
    }

    void advance() {
        if (levels_.maxima == nullptr) {
            next_ = next_ + F(1);
            return;
        }
        must_take_ =
            select(next_ < rays_.last, rays_.last, F(std::numeric_limits<Scalar<F>>::infinity()));
        const F leap = leap_by_gaps();
        const F ahead = before_ == Before::needed ? max(leap, F(1)) : leap + F(1);
        move_to(next_ + ahead);
        ++credit_;
        if (--looks_ahead_ <= 0) advance_beam();
        ++samples_;
    }

    /// Asked for more and more seldom while it gets few lanes on.
    F leap_by_gaps() {
        if (--samples_to_gaps_ > 0) return F(0);
        spent_ += told_of_gap_look;
        const F leap = gap_leaps_(height_.last_look());
        const bool pays = 2 * count_lanes<F>(active_ & (leap >= F(1))) >= count_lanes<F>(active_);
        gap_pause_ = pays ? 1 : std::min(2 * gap_pause_, longest_pause);
        samples_to_gaps_ = gap_pause_;
        return leap;
    }

    /// Not beyond a lane's last sample before that was taken.
    void move_to(F k) { next_ = min(k, must_take_); }

    void start_beam() {
        make_beam();
        length_ = limit_ / 8 + 1;
        advance_beam();
    }

    /// The beam of the lanes that are active now.
    void make_beam() {
        beam_lanes_ = active_;
        limit_ = -1;
        const double far = std::min(static_cast<double>(greatest(rays_.last, active_)),
                                    static_cast<double>(last_));
        if (!(far >= 1)) return;
        const F k(static_cast<Scalar<F>>(far));
        const vec2<F> end = rays_.uv + rays_.uv_step * k;
        const bool bounded = bound_coordinate<F>({rays_.uv.x, end.x}, rays_.reach.x, active_, 0,
                                                 far, beam_.u_low, beam_.u_high) &&
                             bound_coordinate<F>({rays_.uv.y, end.y}, rays_.reach.y, active_, 0,
                                                 far, beam_.v_low, beam_.v_high);
        const F height_end = rays_.height + rays_.height_step * k;
        beam_.height_low = line_through(0, least(rays_.height, active_) - 0x1p-20, far,
                                        least(height_end, active_) - 0x1p-20);
        if (bounded) limit_ = static_cast<int>(far);
        const LevelMaxima& level = levels_.maxima->level[levels_.finest];
        const double motion = std::max(std::abs(beam_.u_low.slope) * level.width,
                                       std::abs(beam_.v_low.slope) * level.height);
        shortest_ = static_cast<int>(std::clamp(cells_worth_a_look / motion, 1.0, 4096.0));
    }

    /// Leads the beam on from the step where the first of its lanes is.
    [[gnu::noinline]] void advance_beam() {
        const Scalar<F> first = least(next_, active_);
        if (!(first <= static_cast<Scalar<F>>(last_))) return;
        const int from = static_cast<int>(first);
        int k = from;
        for (;;) {
            if (credit_ < look_costs) break;
            credit_ -= look_costs;
            spent_ += told_of_look;
            const int high = std::min(k + length_ - 1, limit_);
            const int above =
                high < k ? k - 1
                         : beam_.last_above(k, high, height_ceiling(levels_, beam_.box(k, high)));
            if (above >= k) {
                length_ =
                    above == high ? std::min(2 * length_, last_) : std::max(length_ / 2, shortest_);
                credit_ += step_spares * (above + 1 - k);
                k = above + 1;
            } else if (high - k >= shortest_) {
                length_ = std::max((high - k + 1) / 4, shortest_);
            } else if (any(beam_lanes_ & !active_)) {
                make_beam();
            } else {
                break;
            }
        }
        length_ = shortest_;
        if (k == from) {
            pause_ = std::min(2 * pause_, longest_pause);
        } else {
            pause_ = shortest_pause;
            const int to = before_ == Before::needed ? k - 1 : k;
            move_to(max(next_, F(static_cast<Scalar<F>>(to))));
        }
        looks_ahead_ = pause_;
    }

    const Height& height_;
    LatticeRays<F> rays_;
    const Mask<F>& active_;
    F next_, end_;
    F must_take_;  ///< the last sample of a lane that has not come to it
    int last_;
    Before before_;
    CeilingLevels levels_;
    GapLeaps<F> gap_leaps_;
    Beam beam_;
    Mask<F> beam_lanes_ = Mask<F>(false);
    int shortest_ = 1;                         ///< fewest steps that it looks at
    int samples_to_gaps_ = 1, gap_pause_ = 1;  ///< likewise for leaps by gaps
    int limit_ = -1;                           ///< the last step that the beam may leave out
    int length_ = 1;                           ///< how many steps it looks at next
    int looks_ahead_ = 1;                      ///< how many samples until it is asked again
    int credit_ = first_credit;
    LookMemory* memory_ = nullptr;
    Mask<F> last_left_ = Mask<F>(false);  ///< the lanes of the last sample
    int samples_ = 0, spent_ = told_of_start;
    int pause_ = shortest_pause;  ///< how many after the next time that it finds the surface near
};

/// What bounds the heights of a march in the lanes of `active`; nothing where every step is to be
/// made or shown.
template <class Io, class F = typename Io::Number>
CeilingLevels ceiling_levels(const Io& io, const LodRecord<F>& lod, Mask<F> active) {
    const HeightMaxima* const maxima = io.material().maxima;
    if (maxima == nullptr || io.call().log != nullptr) return {};
    const auto level = [&](Scalar<F> x) { return std::clamp(to_int(x), 0, maxima->levels - 1); };
    return {maxima, level(floor(least(lod.level, active))),
            level(ceil(greatest(lod.level, active)))};
}

/// Heights that say what bounds them: `ceiling(active)`, and `last_look()`.
template <class Height, class M>
concept BoundedHeights = requires(const Height& height, M active) {
    height.ceiling(active);
};

/// Steps `first` to `last` of rays of any kind.
template <Number F, class Height>
auto steps_near_surface(const Height& height, const LatticeRays<F>& rays, const Mask<F>& active,
                        int first, int last, Before before = Before::not_needed) {
    if constexpr (BoundedHeights<Height, Mask<F>>) {
        return StepsNearSurface<F, Height>(height, rays, active, first, last, before);
    } else {
        return steps<F>(first, last);
    }
}

/// Steps 0 to `last` of rays whose samples are at s = k / n; n is a lane's own.
template <Number F, class Height>
auto steps_near_surface(const Height& height, const SearchRay<F>& ray, const Mask<F>& active, F n,
                        int last, Before before = Before::not_needed) {
    return steps_near_surface<F>(height, even_steps_down(ray, n, last), active, 0, last, before);
}

}  // namespace quadrel
