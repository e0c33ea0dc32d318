// Booleans and integers of ranges (ranges.hpp). A boolean may be undecided; context.hpp says
// what becomes of it. An integer is a range, too: what is counted under an undecided boolean.
#pragma once

#include <functional>

#include "quadrel/num/quad.hpp"
#include "quadrel/num/range/functions.hpp"

namespace quadrel {

/// A boolean of one lane: no, yes, perhaps, or an open comparison of the followed lane. Those that
/// are not decided have numbers (RangeContext), so that "both a and not a" is known to be no: a
/// search that has certainly ended by a step ends there, whichever step it ended at.
struct RangeTruth {
    enum State : std::int8_t { no, yes, perhaps, open };
    State state = no;
    bool negated = false;  ///< of one that has a number
    std::int32_t comparison = -1;

    RangeTruth() = default;
    RangeTruth(bool known) : state(known ? yes : no) {}
    RangeTruth(State s) : state(s) {}

    static RangeTruth undecided(int lane) {
        RangeContext& context = range_context();
        RangeTruth truth(perhaps);
        if (context.followed != lane || context.takes_together()) {
            truth.comparison = context.new_boolean();
            return truth;
        }
        truth.comparison = context.leave_open();
        if (truth.comparison >= 0) truth.state = open;
        return truth;
    }
    /// What a literal says.
    static RangeTruth of_literal(std::int32_t literal) {
        RangeTruth truth(perhaps);
        truth.comparison = literal >> 1;
        truth.negated = (literal & 1) != 0;
        return truth.known();
    }
    bool has_number() const { return comparison >= 0 && (state == perhaps || state == open); }
    std::int32_t literal() const { return 2 * comparison + (negated ? 1 : 0); }
    /// Answered, where an answer has been given.
    RangeTruth known() const {
        if (!has_number()) return *this;
        const std::int8_t answer = range_context().answer[comparison];
        return answer < 0 ? *this : RangeTruth((answer != 0) != negated);
    }
    /// Answered, unless it is a perhaps.
    RangeTruth settled() const {
        return state == open ? RangeTruth(range_context().decide(comparison) != negated) : *this;
    }
    RangeTruth operator!() const {
        RangeTruth truth = *this;
        if (has_number()) truth.negated = !negated;
        if (state == no) truth.state = yes;
        if (state == yes) truth.state = no;
        return truth;
    }
};

/// Of two that may be either and have numbers.
inline RangeTruth both_undecided(const RangeTruth& x, const RangeTruth& y) {
    RangeContext& context = range_context();
    const std::int32_t a = x.literal(), b = y.literal();
    if (a == b || context.is_part(b, a)) return x;
    if (context.is_part(a, b)) return y;
    if (a == (b ^ 1) || context.is_part(b ^ 1, a) || context.is_part(a ^ 1, b)) return false;
    RangeTruth truth(RangeTruth::perhaps);
    truth.comparison = context.conjunction(a, b);
    return truth.known();
}

inline RangeTruth both(const RangeTruth& a, const RangeTruth& b) {
    const RangeTruth x = a.known(), y = b.known();
    if (x.state == RangeTruth::no || y.state == RangeTruth::no) return false;
    if (x.state == RangeTruth::yes) return y;
    if (y.state == RangeTruth::yes) return x;
    if (x.state == RangeTruth::open && y.state == RangeTruth::open) {
        if (x.comparison == y.comparison) return x.negated == y.negated ? x : RangeTruth(false);
        return x.settled().state == RangeTruth::yes ? y.known() : RangeTruth(false);
    }
    if (!x.has_number() || !y.has_number()) return RangeTruth::perhaps;
    return both_undecided(x, y);
}

struct RangeMask {
    RangeTruth lane[4];

    RangeMask() = default;
    RangeMask(bool every) : lane{every, every, every, every} {}

    friend RangeMask operator&(const RangeMask& a, const RangeMask& b) {
        return map_lanes<RangeMask>(both, a, b);
    }
    friend RangeMask operator|(const RangeMask& a, const RangeMask& b) { return !((!a) & (!b)); }
    friend RangeMask operator!(const RangeMask& a) {
        return map_lanes<RangeMask>([](const RangeTruth& x) { return !x; }, a);
    }
};

inline bool any(const RangeMask& m) {
    if (!range_context().may_go_on()) return false;
    bool open = false, perhaps = false;
    for (const RangeTruth& truth : m.lane) {
        const RangeTruth known = truth.known();
        if (known.state == RangeTruth::yes) return true;
        perhaps |= known.state == RangeTruth::perhaps;
        open |= known.state == RangeTruth::open;
    }
    if (perhaps) {
        // Such a lane's ranges grow from step to step: it is not waited for as long.
        range_context().questions += 3;
        return true;
    }
    if (!open) return false;
    for (const RangeTruth& truth : m.lane)
        if (truth.settled().state == RangeTruth::yes) return true;
    return false;
}
inline bool all(const RangeMask& m) {
    for (const RangeTruth& truth : m.lane)
        if (truth.known().state != RangeTruth::yes) return false;
    return true;
}
/// Lanes that may be.
inline int count(const RangeMask& m) {
    int n = 0;
    for (const RangeTruth& truth : m.lane) n += truth.known().state != RangeTruth::no;
    return n;
}
inline void store(std::uint32_t* to, const RangeMask& m) {
    for (int i = 0; i < 4; ++i)
        to[i] = m.lane[i].known().state != RangeTruth::no ? 0xffffffffu : 0u;
}

/// result.lane[i] of a mask's lane: `yes` or `no`, or what `together` makes of them. `apart`:
/// whether the two are worth a way of their own in a lane that takes both sides together.
template <class Result, class Packet, class Same, class Apart, class Join>
Result choose_lanes(const RangeMask& m, const Packet& a, const Packet& b, const Same& same_lane,
                    const Apart& apart, const Join& together) {
    Result result;
    RangeContext& context = range_context();
    for (int i = 0; i < 4; ++i) {
        RangeTruth truth = m.lane[i].known();
        const bool matters = truth.state == RangeTruth::perhaps || truth.state == RangeTruth::open;
        if (matters && same_lane(a.lane[i], b.lane[i])) truth = true;
        if (context.takes_together() && context.followed == i && truth.has_number() &&
            apart(a.lane[i], b.lane[i]))
            truth = context.decide(truth.comparison) != truth.negated;
        truth = truth.settled();
        if (truth.state == RangeTruth::perhaps) {
            context.join(i);
            result.lane[i] = together(truth, a.lane[i], b.lane[i]);
        } else {
            result.lane[i] = truth.state == RangeTruth::yes ? a.lane[i] : b.lane[i];
        }
    }
    return result;
}

// ---- Integers -----------------------------------------------------------------------------------

struct RangeInt {
    struct Lane {
        std::int32_t lo, hi;
        bool is_point() const { return lo == hi; }
    };
    Lane lane[4];

    static constexpr Lane anything{std::numeric_limits<std::int32_t>::min(),
                                   std::numeric_limits<std::int32_t>::max()};

    RangeInt() = default;
    RangeInt(std::int32_t every)
        : lane{{every, every}, {every, every}, {every, every}, {every, every}} {}

    friend RangeInt operator+(const RangeInt& a, const RangeInt& b) {
        return map_lanes<RangeInt>(
            [](Lane x, Lane y) {
                return bounded(std::int64_t{x.lo} + y.lo, std::int64_t{x.hi} + y.hi);
            },
            a, b);
    }
    friend RangeInt operator-(const RangeInt& a) {
        return map_lanes<RangeInt>(
            [](Lane x) { return bounded(-std::int64_t{x.hi}, -std::int64_t{x.lo}); }, a);
    }
    friend RangeInt operator-(const RangeInt& a, const RangeInt& b) { return a + -b; }
    friend RangeInt operator*(const RangeInt& a, const RangeInt& b) {
        return map_lanes<RangeInt>(
            [](Lane x, Lane y) {
                const std::int64_t p[4] = {std::int64_t{x.lo} * y.lo, std::int64_t{x.lo} * y.hi,
                                           std::int64_t{x.hi} * y.lo, std::int64_t{x.hi} * y.hi};
                return bounded(*std::min_element(p, p + 4), *std::max_element(p, p + 4));
            },
            a, b);
    }
    friend RangeInt operator&(const RangeInt& a, const RangeInt& b) {
        return of_points(a, b, std::bit_and());
    }
    friend RangeInt operator|(const RangeInt& a, const RangeInt& b) {
        return of_points(a, b, std::bit_or());
    }
    friend RangeInt operator^(const RangeInt& a, const RangeInt& b) {
        return of_points(a, b, std::bit_xor());
    }
    template <int bits>
    friend RangeInt shift_left(const RangeInt& a) {
        return of_points(a, a,
                         [](std::int32_t x, std::int32_t) { return quadrel::shift_left<bits>(x); });
    }
    template <int bits>
    friend RangeInt shift_right(const RangeInt& a) {
        return of_points(
            a, a, [](std::int32_t x, std::int32_t) { return quadrel::shift_right<bits>(x); });
    }
    RangeInt& operator+=(const RangeInt& b) { return *this = *this + b; }
    RangeInt& operator-=(const RangeInt& b) { return *this = *this - b; }

    friend RangeMask operator==(const RangeInt& a, const RangeInt& b) {
        return compare(a, b, [](Lane x, Lane y) {
            return x.hi < y.lo || y.hi < x.lo     ? RangeTruth(false)
                   : x.is_point() && y.is_point() ? RangeTruth(true)
                                                  : RangeTruth(RangeTruth::perhaps);
        });
    }
    friend RangeMask operator<(const RangeInt& a, const RangeInt& b) {
        return compare(a, b, [](Lane x, Lane y) {
            return x.hi < y.lo    ? RangeTruth(true)
                   : x.lo >= y.hi ? RangeTruth(false)
                                  : RangeTruth(RangeTruth::perhaps);
        });
    }
    friend RangeMask operator!=(const RangeInt& a, const RangeInt& b) { return !(a == b); }
    friend RangeMask operator>(const RangeInt& a, const RangeInt& b) { return b < a; }
    friend RangeMask operator<=(const RangeInt& a, const RangeInt& b) { return !(b < a); }
    friend RangeMask operator>=(const RangeInt& a, const RangeInt& b) { return !(a < b); }

  private:
    static Lane bounded(std::int64_t low, std::int64_t high) {
        if (low < anything.lo || high > anything.hi) return anything;
        return {static_cast<std::int32_t>(low), static_cast<std::int32_t>(high)};
    }
    template <class Op>
    static RangeInt of_points(const RangeInt& a, const RangeInt& b, Op op) {
        return map_lanes<RangeInt>(
            [op](Lane x, Lane y) {
                if (!x.is_point() || !y.is_point()) return anything;
                const std::int32_t value = op(x.lo, y.lo);
                return Lane{value, value};
            },
            a, b);
    }
    template <class Compare>
    static RangeMask compare(const RangeInt& a, const RangeInt& b, Compare op) {
        RangeMask result;
        for (int i = 0; i < 4; ++i) {
            result.lane[i] = op(a.lane[i], b.lane[i]);
            if (result.lane[i].state == RangeTruth::perhaps)
                result.lane[i] = RangeTruth::undecided(i);
        }
        return result;
    }
};

inline RangeInt select(const RangeMask& m, const RangeInt& a, const RangeInt& b) {
    using Lane = RangeInt::Lane;
    return choose_lanes<RangeInt>(
        m, a, b, [](Lane x, Lane y) { return x.lo == y.lo && x.hi == y.hi; },
        [](Lane, Lane) { return false; },
        [](const RangeTruth&, Lane x, Lane y) {
            return Lane{std::min(x.lo, y.lo), std::max(x.hi, y.hi)};
        });
}
inline RangeInt min(const RangeInt& a, const RangeInt& b) {
    return map_lanes<RangeInt>(
        [](RangeInt::Lane x, RangeInt::Lane y) {
            return RangeInt::Lane{std::min(x.lo, y.lo), std::min(x.hi, y.hi)};
        },
        a, b);
}
inline RangeInt max(const RangeInt& a, const RangeInt& b) {
    return map_lanes<RangeInt>(
        [](RangeInt::Lane x, RangeInt::Lane y) {
            return RangeInt::Lane{std::max(x.lo, y.lo), std::max(x.hi, y.hi)};
        },
        a, b);
}
/// Elements of a batch's integers: each lane's ends.
inline void store(std::int32_t* to, const RangeInt& a) {
    for (int i = 0; i < 4; ++i) {
        to[2 * i] = a.lane[i].lo;
        to[2 * i + 1] = a.lane[i].hi;
    }
}

}  // namespace quadrel
