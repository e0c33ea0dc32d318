// Where walks down a ray in steps of their own length may end, for all rays of a range: searches by
// cones and distances, whose next point depends on what they find at the last one.
//
// A range of positions that is taken through such a step as one number grows with every step. Here
// the positions are parts of s, cut into short pieces: what a step adds is what it adds to a piece.
#pragma once

#include "quadrel/num/range/geometry.hpp"
#include "quadrel/relief/trace/search/range_parts.hpp"
#include "quadrel/relief/trace/search/search.hpp"

namespace quadrel::range_detail {

/// What is computed aside for several values of one number: nothing of it is followed, and no
/// decision in it remains.
class Aside {
  public:
    Aside()
        : context_(range_context()),
          followed_(context_.followed),
          open_(context_.open),
          alternatives_(context_.alternatives),
          joined_(context_.joined) {
        std::copy_n(context_.undecided, 4, undecided_);
        context_.followed = -1;
    }
    ~Aside() {
        context_.followed = followed_;
        context_.open = open_;
        context_.alternatives = alternatives_;
        context_.joined = joined_;
        std::copy_n(undecided_, 4, context_.undecided);
        ++context_.run;  // the numbers of what was decided here are given out again
    }
    Aside(const Aside&) = delete;
    Aside& operator=(const Aside&) = delete;

  private:
    RangeContext& context_;
    std::int32_t followed_, open_, alternatives_;
    std::uint32_t joined_, undecided_[4];
};

/// A number in one lane, and in the others the same.
inline Ranges everywhere(const RealInterval& x) { return Ranges(Ranged(x)); }
inline RangeMask only(int lane) {
    RangeMask mask(false);
    mask.lane[lane] = true;
    return mask;
}

/// What a step may do that begins anywhere in a piece.
struct WalkStep {
    bool ends = false, goes_on = false;  ///< may
    bool at_bottom = false;              ///< may: the step leads to s = 1 and ends there
    RealInterval to{0, 0};               ///< where it goes on
    RealInterval height{0, 0};           ///< what it finds
    bool known = true;
};

/// Positions, where the steps to them began, and what was found there.
struct WalkPart {
    RealInterval s, from, height;
};

/// Disjoint parts in order. Of more than `most` the two that are nearest to each other are one.
template <int most>
class WalkParts {
  public:
    int count() const { return count_; }
    const WalkPart& operator[](int k) const { return part_[k]; }
    void clear() { count_ = 0; }

    void add(const WalkPart& part) {
        int at = count_;
        while (at > 0 && part_[at - 1].s.lo > part.s.lo) --at;
        for (int k = count_; k > at; --k) part_[k] = part_[k - 1];
        part_[at] = part;
        ++count_;
        // Neighbours that meet.
        while (at > 0 && part_[at - 1].s.hi >= part_[at].s.lo) unite(--at);
        while (at + 1 < count_ && part_[at].s.hi >= part_[at + 1].s.lo) unite(at);
        if (count_ > most) unite(nearest());
    }

  private:
    void unite(int k) {
        WalkPart &a = part_[k], &b = part_[k + 1];
        a = {hull(a.s, b.s), hull(a.from, b.from), hull(a.height, b.height)};
        for (int j = k + 1; j + 1 < count_; ++j) part_[j] = part_[j + 1];
        --count_;
    }
    int nearest() const {
        int found = 0;
        for (int k = 1; k + 1 < count_; ++k)
            if (part_[k + 1].s.lo - part_[k].s.hi < part_[found + 1].s.lo - part_[found].s.hi)
                found = k;
        return found;
    }

    WalkPart part_[most + 1];
    int count_ = 0;
};

/// Where a walk of at most `most` points may have ended, or be after all of them.
struct WalkEnds {
    WalkParts<most_parts> ends, going;
    bool at_bottom = false, known = true;
};

/// `step(piece)` is a WalkStep. `finest`: pieces of s are no longer, unless there are too many.
template <class Step>
WalkEnds walk_parts(int most, double finest, const Step& step) {
    constexpr int least_pieces = 4, most_pieces = 48, most_looks = 1 << 15;
    WalkEnds result;
    WalkParts<most_parts> now, next;
    now.add({0, 0, 0});
    int looks = 0;
    for (int k = 0; k < most && now.count() > 0; ++k) {
        next.clear();
        for (int p = 0; p < now.count(); ++p) {
            const WalkPart part = now[p];
            const double width = part.s.width();
            const double pieces_of = std::ceil(width / finest);
            const int pieces = width == 0
                                   ? 1
                                   : static_cast<int>(std::clamp(pieces_of, double(least_pieces),
                                                                 double(most_pieces)));
            for (int i = 0; i < pieces; ++i) {
                const RealInterval piece(
                    i == 0 ? part.s.lo : part.s.lo + width * i / pieces,
                    i + 1 == pieces ? part.s.hi : part.s.lo + width * (i + 1) / pieces);
                const WalkStep one = step(piece);
                if (!one.known || ++looks > most_looks) {
                    result.known = false;
                    return result;
                }
                if (one.ends) result.ends.add({piece, part.from, one.height});
                result.at_bottom |= one.at_bottom;
                if (one.goes_on) next.add({one.to, piece, one.height});
            }
        }
        // A walk that stays where it is will be there after all steps.
        bool stays = next.count() == now.count();
        for (int p = 0; stays && p < now.count(); ++p)
            stays = next[p].s.lo == now[p].s.lo && next[p].s.hi == now[p].s.hi;
        now = next;
        if (stays) break;
    }
    result.going = now;
    return result;
}

/// What has been decided in a run so far, of a lane: nothing, if it is not followed.
struct DecidedSoFar {
    std::int32_t answers = -1;
    std::uint32_t together = 0;
    std::int8_t way[RangeContext::most_answers] = {};

    explicit DecidedSoFar(int lane) {
        const RangeContext& context = range_context();
        if (context.followed != lane) return;
        answers = context.answers;
        together = context.together;
        std::copy_n(context.way, answers, way);
    }
    bool operator==(const DecidedSoFar&) const = default;
};

/// Walks of a quad's lanes, so that what is decided behind them does not make them again: one kind
/// of walk's, and this thread's.
class KnownWalks {
  public:
    template <class Walk>
    const WalkEnds& of(const SearchRay<Ranges>& ray, int lane, const Walk& walk) {
        Known& known = known_[lane];
        const DecidedSoFar decided(lane);
        const Ranged numbers[4] = {ray.uv.x.lane[lane], ray.uv.y.lane[lane], ray.K.x.lane[lane],
                                   ray.K.y.lane[lane]};
        bool same = known.quad == range_context().quad && known.decided == decided;
        for (int k = 0; k < 4; ++k) {
            const RealInterval x = numbers[k].range();
            same = same && x.lo == known.numbers[k].lo && x.hi == known.numbers[k].hi;
            known.numbers[k] = x;
        }
        known.quad = range_context().quad;
        known.decided = decided;
        if (!same) known.walk = walk();
        return known.walk;
    }

  private:
    struct Known {
        std::uint64_t quad = 0;
        DecidedSoFar decided{-2};  // of no lane
        RealInterval numbers[4];
        WalkEnds walk;
    };
    Known known_[4];
};

/// How long pieces of a lane's ray are: a part of a texel for maps of some hundred texels.
inline double finest_piece(const SearchRay<Ranges>& ray, int lane) {
    const double shift =
        std::max(ray.K.x.lane[lane].range().magnitude(), ray.K.y.lane[lane].range().magnitude());
    return 0x1p-12 / std::clamp(shift, 1.0, 256.0);
}

/// What a walk may have given: one of its ends, the bottom, or no hit (CAP) after all points; or
/// all of these together.
struct WalkOutcome {
    RealInterval s{0, 1}, from{0, 1}, height{0, 0};
    Status first = Status::none, last = Status::none;  ///< may be anything from one to the other
    bool known = false;
};
inline WalkOutcome outcome_of(const WalkEnds& walk, int lane) {
    static_assert(Status::hit < Status::floor && Status::floor < Status::cap);
    WalkOutcome outcome;
    if (!walk.known) return outcome;
    const int hits = walk.ends.count(), caps = walk.going.count();
    const int bottom = walk.at_bottom ? 1 : 0, all = hits + bottom + caps;
    if (all == 0) return outcome;
    const int which = one_of_parts(all, lane);
    bool first = true;
    const auto take = [&](const WalkPart& part, Status status) {
        outcome.s = first ? part.s : hull(outcome.s, part.s);
        outcome.from = first ? part.from : hull(outcome.from, part.from);
        outcome.height = first ? part.height : hull(outcome.height, part.height);
        outcome.first = first ? status : std::min(outcome.first, status);
        outcome.last = first ? status : std::max(outcome.last, status);
        first = false;
    };
    for (int k = 0; k < all; ++k) {
        if (which >= 0 && which != k) continue;
        if (k < hits)
            take(walk.ends[k], Status::hit);
        else if (k < hits + bottom)
            take({1, 1, 0}, Status::floor);
        else
            take(walk.going[k - hits - bottom], Status::cap);
    }
    outcome.known = true;
    return outcome;
}

}  // namespace quadrel::range_detail
