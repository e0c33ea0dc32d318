// Ranges: a number type whose four lanes are ranges (ranged.hpp), so that a text gives all that an
// implementation with permitted errors may compute. Companions: RangeMask, of which lanes may be
// undecided, and RangeInt (mask.hpp); context.hpp says how undecided lanes are gone
// through.
//
//     any, none, when   whether a lane may be true: then blocks run and loops go on, and masks see
//                       to it that it matters in no other lane
//     all               whether every lane is certain to be
//     select            an undecided lane takes both sides together, unless it is followed
#pragma once

#include "quadrel/num/range/mask.hpp"

namespace quadrel {

struct Ranges {
    Ranged lane[4];

    Ranges() = default;
    Ranges(double every) : Ranges(Ranged(every)) {}
    Ranges(const Ranged& every) : lane{every, every, every, every} {}

    friend Ranges operator+(const Ranges& a, const Ranges& b) {
        return map_lanes<Ranges>(std::plus(), a, b);
    }
    friend Ranges operator-(const Ranges& a, const Ranges& b) {
        return map_lanes<Ranges>(std::minus(), a, b);
    }
    friend Ranges operator*(const Ranges& a, const Ranges& b) {
        return map_lanes<Ranges>(std::multiplies(), a, b);
    }
    friend Ranges operator/(const Ranges& a, const Ranges& b) {
        return map_lanes<Ranges>(std::divides(), a, b);
    }
    friend Ranges operator-(const Ranges& a) { return map_lanes<Ranges>(std::negate(), a); }
    friend Ranges operator+(const Ranges& a) { return a; }
    Ranges& operator+=(const Ranges& b) { return *this = *this + b; }
    Ranges& operator-=(const Ranges& b) { return *this = *this - b; }
    Ranges& operator*=(const Ranges& b) { return *this = *this * b; }
    Ranges& operator/=(const Ranges& b) { return *this = *this / b; }

    friend RangeMask operator<(const Ranges& a, const Ranges& b) {
        return compare(a, b, [](const RealInterval& x, const RealInterval& y) {
            return x.hi < y.lo    ? RangeTruth(true)
                   : x.lo >= y.hi ? RangeTruth(false)
                                  : RangeTruth(RangeTruth::perhaps);
        });
    }
    friend RangeMask operator<=(const Ranges& a, const Ranges& b) {
        return compare(a, b, [](const RealInterval& x, const RealInterval& y) {
            return x.hi <= y.lo  ? RangeTruth(true)
                   : x.lo > y.hi ? RangeTruth(false)
                                 : RangeTruth(RangeTruth::perhaps);
        });
    }
    friend RangeMask operator>(const Ranges& a, const Ranges& b) { return b < a; }
    friend RangeMask operator>=(const Ranges& a, const Ranges& b) { return b <= a; }
    friend RangeMask operator==(const Ranges& a, const Ranges& b) {
        return compare(a, b, [](const RealInterval& x, const RealInterval& y) {
            return x.hi < y.lo || y.hi < x.lo     ? RangeTruth(false)
                   : x.lo == x.hi && y.lo == y.hi ? RangeTruth(true)
                                                  : RangeTruth(RangeTruth::perhaps);
        });
    }
    friend RangeMask operator!=(const Ranges& a, const Ranges& b) { return !(a == b); }

  private:
    /// Of ranges that are all numbers; of anything else nothing is known.
    template <class Compare>
    static RangeMask compare(const Ranges& a, const Ranges& b, Compare op) {
        RangeMask result;
        for (int i = 0; i < 4; ++i) {
            const bool free = is_free(a.lane[i]) || is_free(b.lane[i]);
            result.lane[i] =
                free ? RangeTruth(RangeTruth::perhaps) : op(a.lane[i].range(), b.lane[i].range());
            if (result.lane[i].state == RangeTruth::perhaps)
                result.lane[i] = RangeTruth::undecided(i);
        }
        return result;
    }
    /// Anything, NaN too. (A point at infinity is a bound of the text's own.)
    static bool is_free(const Ranged& a) { return !a.is_bounded() && a.lo != a.hi; }
};

template <>
struct NumberTraits<Ranges> {
    using Scalar = double;
    using Element = Ranged;
    using Int = RangeInt;
    using Mask = RangeMask;
    static constexpr int lanes = 4;
};

template <>
struct PacketOps<Ranges> {
    template <class Element>
    static Ranges load(const Element* from) {
        Ranges result;
        for (int i = 0; i < 4; ++i) result.lane[i] = Ranged(from[i]);
        return result;
    }
    /// Of a batch's integers, which are pairs (store of mask.hpp).
    static RangeInt load_int(const std::int32_t* from) {
        RangeInt result;
        for (int i = 0; i < 4; ++i) result.lane[i] = {from[2 * i], from[2 * i + 1]};
        return result;
    }
    static RangeMask load_mask(const std::uint32_t* from) {
        RangeMask result;
        for (int i = 0; i < 4; ++i) result.lane[i] = from[i] != 0;
        return result;
    }
    static Ranges from_int(const RangeInt& a) {
        return map_lanes<Ranges>(
            [](RangeInt::Lane x) {
                const Ranged low(static_cast<double>(x.lo)), high(static_cast<double>(x.hi));
                return join(low, high);
            },
            a);
    }
    static Ranges gather(const float* base, const RangeInt& index) {
        return map_lanes<Ranges>(
            [base](RangeInt::Lane i) {
                return i.is_point() ? Ranged(static_cast<double>(base[i.lo])) : Ranged::anything();
            },
            index);
    }
    static RangeInt gather(const std::int32_t* base, const RangeInt& index) {
        return map_lanes<RangeInt>(
            [base](RangeInt::Lane i) {
                if (!i.is_point()) return RangeInt::anything;
                return RangeInt::Lane{base[i.lo], base[i.lo]};
            },
            index);
    }
    static RangeInt look_up16(const std::int32_t* table, const RangeInt& index) {
        return gather(table, index);
    }
    static void gather2(const float* base, const RangeInt& index, Ranges out[2]) {
        for (int c = 0; c < 2; ++c) out[c] = gather(base + c, index);
    }
    static void gather4(const float* base, const RangeInt& index, Ranges out[4]) {
        for (int c = 0; c < 4; ++c) out[c] = gather(base + c, index);
    }
    template <int a, int b, int c, int d>
    static Ranges swizzle(const Ranges& v) {
        Ranges result;
        result.lane[0] = v.lane[a];
        result.lane[1] = v.lane[b];
        result.lane[2] = v.lane[c];
        result.lane[3] = v.lane[d];
        return result;
    }
};

template <>
struct WideOps<Ranges> {
    using Type = Ranges;
    static Ranges widen(const Ranges& a) { return a; }
    static Ranges load(const double* from) { return PacketOps<Ranges>::load(from); }
    static Ranges narrow(const Ranges& a) { return a; }
};

/// Without alternatives, which are a run's.
inline void store(Ranged* to, const Ranges& a) {
    for (int i = 0; i < 4; ++i) {
        to[i] = a.lane[i];
        to[i].alternative = 0;
    }
}

namespace range_detail {

/// One of two constants depends on the decision, beyond a search.
inline bool are_apart(const Ranged& a, const Ranged& b) {
    return a.lo == a.hi && b.lo == b.hi && a.named == 0 && b.named == 0 &&
           range_context().kind != Undecided::hit;
}

/// A number's range under an assumption, as far as it is known.
inline RealInterval under(const Ranged& x, const RangeTruth& assumed) {
    if (x.alternative == 0) return x.range();
    const RangeAlternative& known = range_context().alternative[x.alternative];
    if (known.literal == assumed.literal()) return known.rest;
    return known.literal == (assumed.literal() ^ 1) ? known.taken : x.range();
}

/// m ? a : b, of an undecided m. What of it is still b's rest, if b has an alternative, or else b
/// itself, is kept apart.
inline Ranged chosen(const RangeTruth& m, const Ranged& a, const Ranged& b) {
    if (!m.has_number() || !a.is_bounded() || !b.is_bounded()) return join(a, b);
    RangeContext& context = range_context();
    RealInterval taken = under(a, m), rest = under(b, !m);
    RangeTruth open = !m;
    if (b.alternative != 0) {
        const RangeAlternative known = context.alternative[b.alternative];
        open = both(RangeTruth::of_literal(known.literal), !m);
        taken = hull(taken, known.taken);
        rest = known.rest;
        if (open.state == RangeTruth::no) return Ranged(taken);
    }
    Ranged result(hull(taken, rest));
    if (open.has_number()) result.alternative = context.keep({open.literal(), taken, rest});
    return result;
}

}  // namespace range_detail

inline Ranges select(const RangeMask& m, const Ranges& a, const Ranges& b) {
    return choose_lanes<Ranges>(
        m, a, b, [](const Ranged& x, const Ranged& y) { return same(x, y); },
        range_detail::are_apart,
        [](const RangeTruth& truth, const Ranged& x, const Ranged& y) {
            return range_detail::chosen(truth, x, y);
        });
}

// ---- Rounding to integers -----------------------------------------------------------------------

namespace range_detail {

/// One of the integers from `low` to `high`, in a lane: the followed one takes one after another.
/// Others, and those of more than a few, have them all.
inline RealInterval one_of(double low, double high, int lane) {
    if (low == high) return low;
    RangeContext& context = range_context();
    constexpr double most = 16;
    if (context.followed == lane && high - low <= most) {
        for (double k = low; k < high; ++k) {
            const std::int32_t comparison = context.leave_open();
            if (comparison < 0) break;
            if (context.decide(comparison)) return k;
        }
        return high;
    }
    context.join(lane);
    return {low, high};
}

template <class Round>
Ranges to_integers(const Ranges& a, Round round) {
    Ranges result;
    for (int i = 0; i < 4; ++i) {
        if (!a.lane[i].is_bounded()) {
            result.lane[i] = Ranged::anything();
            continue;
        }
        const RealInterval x = a.lane[i].range();
        result.lane[i] = Ranged(one_of(round(x.lo), round(x.hi), i));
    }
    return result;
}

}  // namespace range_detail

inline Ranges floor(const Ranges& a) {
    return range_detail::to_integers(a, [](double x) { return std::floor(x); });
}
inline Ranges ceil(const Ranges& a) {
    return range_detail::to_integers(a, [](double x) { return std::ceil(x); });
}
inline Ranges trunc(const Ranges& a) {
    return range_detail::to_integers(a, [](double x) { return std::trunc(x); });
}
inline Ranges round_even(const Ranges& a) {
    return range_detail::to_integers(a, [](double x) { return std::nearbyint(x); });
}
inline RangeInt to_int(const Ranges& a) {
    RangeInt result;
    for (int i = 0; i < 4; ++i) {
        result.lane[i] = RangeInt::anything;
        if (!a.lane[i].is_bounded()) continue;
        const RealInterval x = a.lane[i].range();
        const RealInterval n = range_detail::one_of(to_int(x.lo), to_int(x.hi), i);
        result.lane[i] = {static_cast<std::int32_t>(n.lo), static_cast<std::int32_t>(n.hi)};
    }
    return result;
}
inline RangeInt to_int_in_range(const Ranges& a) { return to_int(a); }

// ---- Functions: better matches than the texts of num/ -------------------------------------------

/// a (1 - t) + b t, or a + t (b - a), which compilers make of it: the same but for rounding, three
/// times, of numbers as large as both together.
inline Ranges mix(const Ranges& a, const Ranges& b, const Ranges& t) {
    Ranges result = a * (Ranges(1) - t) + b * t;
    const double unit = range_detail::budget().unit;
    for (int i = 0; unit > 0 && i < 4; ++i) {
        const RealInterval usual = result.lane[i].range();
        const double size = a.lane[i].range().magnitude() + b.lane[i].range().magnitude();
        const double off = 3 * unit * size * std::max(1.0, t.lane[i].range().magnitude());
        if (result.lane[i].is_bounded()) result.lane[i] = range_detail::widened(usual, off);
    }
    return result;
}
inline Ranges min(const Ranges& a, const Ranges& b) {
    return map_lanes<Ranges>([](const Ranged& x, const Ranged& y) { return min(x, y); }, a, b);
}
inline Ranges max(const Ranges& a, const Ranges& b) {
    return map_lanes<Ranges>([](const Ranged& x, const Ranged& y) { return max(x, y); }, a, b);
}
inline Ranges clamp(const Ranges& x, const Ranges& low, const Ranges& high) {
    return min(max(x, low), high);
}
inline Ranges saturate(const Ranges& x) { return clamp(x, Ranges(0), Ranges(1)); }
inline Ranges copysign(const Ranges& a, const Ranges& b) {
    return map_lanes<Ranges>([](const Ranged& x, const Ranged& y) { return copysign(x, y); }, a, b);
}
inline Ranges pow(const Ranges& a, const Ranges& b) {
    return map_lanes<Ranges>([](const Ranged& x, const Ranged& y) { return pow(x, y); }, a, b);
}
inline Ranges atan2(const Ranges& a, const Ranges& b) {
    return map_lanes<Ranges>([](const Ranged& y, const Ranged& x) { return atan2(y, x); }, a, b);
}
inline Ranges abs(const Ranges& a) {
    return map_lanes<Ranges>([](const Ranged& x) { return abs(x); }, a);
}
inline Ranges sqrt(const Ranges& a) {
    return map_lanes<Ranges>([](const Ranged& x) { return sqrt(x); }, a);
}
inline Ranges inversesqrt(const Ranges& a) {
    return map_lanes<Ranges>([](const Ranged& x) { return inversesqrt(x); }, a);
}
inline Ranges exp2(const Ranges& a) {
    return map_lanes<Ranges>([](const Ranged& x) { return exp2(x); }, a);
}
inline Ranges exp(const Ranges& a) {
    return map_lanes<Ranges>([](const Ranged& x) { return exp(x); }, a);
}
inline Ranges log2(const Ranges& a) {
    return map_lanes<Ranges>([](const Ranged& x) { return log2(x); }, a);
}
inline Ranges log(const Ranges& a) {
    return map_lanes<Ranges>([](const Ranged& x) { return log(x); }, a);
}
inline Ranges sin(const Ranges& a) {
    return map_lanes<Ranges>([](const Ranged& x) { return sin(x); }, a);
}
inline Ranges cos(const Ranges& a) {
    return map_lanes<Ranges>([](const Ranged& x) { return cos(x); }, a);
}
inline Ranges tan(const Ranges& a) {
    return map_lanes<Ranges>([](const Ranged& x) { return tan(x); }, a);
}
inline Ranges asin(const Ranges& a) {
    return map_lanes<Ranges>([](const Ranged& x) { return asin(x); }, a);
}
inline Ranges acos(const Ranges& a) {
    return map_lanes<Ranges>([](const Ranged& x) { return acos(x); }, a);
}
inline Ranges atan(const Ranges& a) {
    return map_lanes<Ranges>([](const Ranged& x) { return atan(x); }, a);
}

/// Undecided where nothing is known of a lane.
inline RangeMask is_nan(const Ranges& a) {
    RangeMask result(false);
    for (int i = 0; i < 4; ++i)
        if (!a.lane[i].is_bounded() && a.lane[i].lo != a.lane[i].hi)
            result.lane[i] = RangeTruth::undecided(i);
    return result;
}
inline RangeMask is_finite(const Ranges& a) { return !is_nan(a); }

}  // namespace quadrel

/// GLM refuses types that are not floating-point by this trait.
template <>
struct std::numeric_limits<quadrel::Ranges> : std::numeric_limits<double> {};
