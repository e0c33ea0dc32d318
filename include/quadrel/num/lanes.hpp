// Lanes: packed float lanes, 4, 8 or 16 wide, for the instruction set that this file is compiled
// for. The only file that knows SIMD. Equal to Quad<float> bit for bit (NaN payloads aside).
//
// Only for sources built as instruction-set modules: all of a module is compiled with the same
// flags, so that templates over Lanes keep one calling convention.
#pragma once

#include <hwy/highway.h>

#include <limits>

#include "quadrel/num/traits.hpp"

#if defined(QUADREL_ISA_AVX512)
static_assert(HWY_TARGET == HWY_AVX3, "compiler flags do not give AVX-512");
#elif defined(QUADREL_ISA_AVX2)
static_assert(HWY_TARGET == HWY_AVX2, "compiler flags do not give AVX2");
#elif defined(QUADREL_ISA_SSE4)
static_assert(HWY_TARGET == HWY_SSE4, "compiler flags do not give SSE4");
#elif defined(QUADREL_ISA_NEON)
static_assert(HWY_TARGET == HWY_NEON, "compiler flags do not give NEON");
#else
#error "lanes.hpp is for sources built by quadrel_add_isa_modules"
#endif

namespace quadrel {

namespace hn = hwy::HWY_NAMESPACE;

class Lanes;
class LanesInt;
Lanes as_float(LanesInt a);  // a friend of its result, so that its argument does not find it

namespace simd {
using FloatTag = hn::ScalableTag<float>;
using IntTag = hn::RebindToSigned<FloatTag>;
using UintTag = hn::RebindToUnsigned<FloatTag>;
using FloatVector = hn::Vec<FloatTag>;
using IntVector = hn::Vec<IntTag>;
using FloatMask = hn::Mask<FloatTag>;
inline constexpr int lanes = static_cast<int>(hn::MaxLanes(FloatTag()));
}  // namespace simd

/// A boolean a lane.
class LanesMask {
  public:
    LanesMask() = default;
    LanesMask(bool all) : m(hn::FirstN(simd::FloatTag(), all ? simd::lanes : 0)) {}
    explicit LanesMask(simd::FloatMask mask) : m(mask) {}

    friend LanesMask operator&(LanesMask a, LanesMask b) { return LanesMask(hn::And(a.m, b.m)); }
    friend LanesMask operator|(LanesMask a, LanesMask b) { return LanesMask(hn::Or(a.m, b.m)); }
    friend LanesMask operator!(LanesMask a) { return LanesMask(hn::Not(a.m)); }
    friend bool any(LanesMask a) { return !hn::AllFalse(simd::FloatTag(), a.m); }
    friend bool all(LanesMask a) { return hn::AllTrue(simd::FloatTag(), a.m); }
    friend int count(LanesMask a) { return static_cast<int>(hn::CountTrue(simd::FloatTag(), a.m)); }

    simd::FloatMask m;
};

/// A 32-bit integer a lane; sums and products wrap around.
class LanesInt {
  public:
    LanesInt() = default;
    LanesInt(std::int32_t all) : v(hn::Set(simd::IntTag(), all)) {}
    explicit LanesInt(simd::IntVector vector) : v(vector) {}

    friend LanesInt operator+(LanesInt a, LanesInt b) { return LanesInt(hn::Add(a.v, b.v)); }
    friend LanesInt operator-(LanesInt a, LanesInt b) { return LanesInt(hn::Sub(a.v, b.v)); }
    friend LanesInt operator*(LanesInt a, LanesInt b) { return LanesInt(hn::Mul(a.v, b.v)); }
    friend LanesInt operator-(LanesInt a) { return LanesInt(0) - a; }
    friend LanesInt operator&(LanesInt a, LanesInt b) { return LanesInt(hn::And(a.v, b.v)); }
    friend LanesInt operator|(LanesInt a, LanesInt b) { return LanesInt(hn::Or(a.v, b.v)); }
    friend LanesInt operator^(LanesInt a, LanesInt b) { return LanesInt(hn::Xor(a.v, b.v)); }
    LanesInt& operator+=(LanesInt b) { return *this = *this + b; }
    LanesInt& operator-=(LanesInt b) { return *this = *this - b; }
    template <int bits>
    friend LanesInt shift_left(LanesInt a) {
        return LanesInt(hn::ShiftLeft<bits>(a.v));
    }
    template <int bits>
    friend LanesInt shift_right(LanesInt a) {
        return LanesInt(hn::ShiftRight<bits>(a.v));
    }

    /// By a count of each lane's own.
    friend LanesInt shift_left(LanesInt a, LanesInt bits) { return LanesInt(hn::Shl(a.v, bits.v)); }
    friend LanesInt shift_right(LanesInt a, LanesInt bits) {
        return LanesInt(hn::Shr(a.v, bits.v));
    }

    friend LanesMask operator==(LanesInt a, LanesInt b) { return as_mask(hn::Eq(a.v, b.v)); }
    friend LanesMask operator!=(LanesInt a, LanesInt b) { return !(a == b); }
    friend LanesMask operator<(LanesInt a, LanesInt b) { return as_mask(hn::Lt(a.v, b.v)); }
    friend LanesMask operator>(LanesInt a, LanesInt b) { return b < a; }
    friend LanesMask operator<=(LanesInt a, LanesInt b) { return !(b < a); }
    friend LanesMask operator>=(LanesInt a, LanesInt b) { return !(a < b); }

    friend LanesInt select(LanesMask m, LanesInt a, LanesInt b) {
        return LanesInt(hn::IfThenElse(hn::RebindMask(simd::IntTag(), m.m), a.v, b.v));
    }
    friend LanesInt min(LanesInt a, LanesInt b) { return LanesInt(hn::Min(a.v, b.v)); }
    friend LanesInt max(LanesInt a, LanesInt b) { return LanesInt(hn::Max(a.v, b.v)); }
    friend void store(std::int32_t* to, LanesInt a) { hn::StoreU(a.v, simd::IntTag(), to); }

    simd::IntVector v;

  private:
    static LanesMask as_mask(hn::Mask<simd::IntTag> m) {
        return LanesMask(hn::RebindMask(simd::FloatTag(), m));
    }
};

/// A float a lane.
class Lanes {
  public:
    Lanes() = default;
    Lanes(float all) : v(hn::Set(simd::FloatTag(), all)) {}
    explicit Lanes(simd::FloatVector vector) : v(vector) {}

    friend Lanes operator+(Lanes a, Lanes b) { return Lanes(hn::Add(a.v, b.v)); }
    friend Lanes operator-(Lanes a, Lanes b) { return Lanes(hn::Sub(a.v, b.v)); }
    friend Lanes operator*(Lanes a, Lanes b) { return Lanes(hn::Mul(a.v, b.v)); }
    friend Lanes operator/(Lanes a, Lanes b) { return Lanes(hn::Div(a.v, b.v)); }
    friend Lanes operator-(Lanes a) { return Lanes(hn::Neg(a.v)); }
    friend Lanes operator+(Lanes a) { return a; }
    Lanes& operator+=(Lanes b) { return *this = *this + b; }
    Lanes& operator-=(Lanes b) { return *this = *this - b; }
    Lanes& operator*=(Lanes b) { return *this = *this * b; }
    Lanes& operator/=(Lanes b) { return *this = *this / b; }

    friend LanesMask operator<(Lanes a, Lanes b) { return LanesMask(hn::Lt(a.v, b.v)); }
    friend LanesMask operator<=(Lanes a, Lanes b) { return LanesMask(hn::Le(a.v, b.v)); }
    friend LanesMask operator>(Lanes a, Lanes b) { return LanesMask(hn::Gt(a.v, b.v)); }
    friend LanesMask operator>=(Lanes a, Lanes b) { return LanesMask(hn::Ge(a.v, b.v)); }
    friend LanesMask operator==(Lanes a, Lanes b) { return LanesMask(hn::Eq(a.v, b.v)); }
    // Highway's Ne is an ordered comparison on AVX2 and AVX-512: NaN != NaN would be false.
    friend LanesMask operator!=(Lanes a, Lanes b) { return !(a == b); }

    friend Lanes select(LanesMask m, Lanes a, Lanes b) {
        return Lanes(hn::IfThenElse(m.m, a.v, b.v));
    }
    friend Lanes sqrt(Lanes a) { return Lanes(hn::Sqrt(a.v)); }
    friend Lanes abs(Lanes a) { return Lanes(hn::Abs(a.v)); }
    friend Lanes floor(Lanes a) { return Lanes(hn::Floor(a.v)); }
    friend Lanes ceil(Lanes a) { return Lanes(hn::Ceil(a.v)); }
    friend Lanes trunc(Lanes a) { return Lanes(hn::Trunc(a.v)); }
    friend Lanes round_even(Lanes a) { return Lanes(hn::Round(a.v)); }
    friend Lanes copysign(Lanes a, Lanes b) { return Lanes(hn::CopySign(a.v, b.v)); }

    /// Truncates towards zero; NaN gives 0, out of range saturates.
    friend LanesInt to_int(Lanes a) {
        // The conversion itself gives 0x80000000 for whatever does not fit.
        const LanesInt converted(hn::ConvertTo(simd::IntTag(), a.v));
        const LanesInt high = select(a >= Lanes(2147483648.0f), LanesInt(0x7fffffff), converted);
        const LanesInt low = select(a < Lanes(-2147483648.0f), LanesInt(-0x7fffffff - 1), high);
        return select(a == a, low, LanesInt(0));
    }
    friend LanesInt to_int_in_range(Lanes a) {
        return LanesInt(hn::ConvertTo(simd::IntTag(), a.v));
    }
    // The parts of a floating-point number: see scalar.hpp.
    friend Lanes exponent(Lanes a) {
        const LanesInt biased = shift_right<23>(as_int(a)) & LanesInt(0xff);
        return Lanes(hn::ConvertTo(simd::FloatTag(), (biased - LanesInt(127)).v));
    }
    friend Lanes significand(Lanes a) {
        return as_float((as_int(a) & LanesInt(0x007fffff)) | LanesInt(0x3f800000));
    }
    friend Lanes power_of_two(Lanes n) {
        return as_float(shift_left<23>(to_int(n) + LanesInt(127)));
    }
    friend LanesInt as_int(Lanes a) { return LanesInt(hn::BitCast(simd::IntTag(), a.v)); }
    friend Lanes as_float(LanesInt a) { return Lanes(hn::BitCast(simd::FloatTag(), a.v)); }
    friend void store(float* to, Lanes a) { hn::StoreU(a.v, simd::FloatTag(), to); }

    simd::FloatVector v;
};

inline void store(std::uint32_t* to, LanesMask a) {
    const simd::UintTag tag;
    hn::StoreU(hn::VecFromMask(tag, hn::RebindMask(tag, a.m)), tag, to);
}

template <>
struct NumberTraits<Lanes> {
    using Scalar = float;
    using Int = LanesInt;
    using Mask = LanesMask;
    static constexpr int lanes = simd::lanes;
};

template <>
struct PacketOps<Lanes> {
    static Lanes load(const float* from) { return Lanes(hn::LoadU(simd::FloatTag(), from)); }
    static LanesInt load_int(const std::int32_t* from) {
        return LanesInt(hn::LoadU(simd::IntTag(), from));
    }
    static LanesMask load_mask(const std::uint32_t* from) {
        return load_int(reinterpret_cast<const std::int32_t*>(from)) != LanesInt(0);
    }
    static Lanes from_int(LanesInt a) { return Lanes(hn::ConvertTo(simd::FloatTag(), a.v)); }
    static Lanes gather(const float* base, LanesInt index) {
        return Lanes(hn::GatherIndex(simd::FloatTag(), base, index.v));
    }
    static LanesInt gather(const std::int32_t* base, LanesInt index) {
        return LanesInt(hn::GatherIndex(simd::IntTag(), base, index.v));
    }
    /// The table in registers, where two hold it.
    static LanesInt look_up16(const std::int32_t* table, LanesInt index) {
        if constexpr (simd::lanes == 16) {
            return look_up(table, index);
        } else if constexpr (simd::lanes == 8) {
            const LanesInt low = index & LanesInt(7);
            return select(index == low, look_up(table, low), look_up(table + 8, low));
        } else {
            return gather(table, index);
        }
    }
    /// Pairs by 64-bit gathers where a register holds 16 lanes; else by 64-bit loads, then a
    /// transpose within each quad: either is cheaper than two gathers.
    static void gather2(const float* base, LanesInt index, Lanes out[2]) {
        const simd::FloatTag tag;
        if constexpr (simd::lanes == 16) {
            const hn::Half<simd::IntTag> half;
            const auto low = gather_pairs(base, hn::LowerHalf(half, index.v));
            const auto high = gather_pairs(base, hn::UpperHalf(half, index.v));
            out[0] = Lanes(hn::ConcatEven(tag, high, low));
            out[1] = Lanes(hn::ConcatOdd(tag, high, low));
        } else {
            alignas(64) std::int32_t at[simd::lanes];
            hn::Store(index.v, simd::IntTag(), at);
            const auto pair01 = hn::BitCast(tag, load_pairs(base, at));
            const auto pair23 = hn::BitCast(tag, load_pairs(base, at + 2));
            const auto even = hn::InterleaveLower(tag, pair01, pair23);
            const auto odd = hn::InterleaveUpper(tag, pair01, pair23);
            out[0] = Lanes(hn::InterleaveLower(tag, even, odd));
            out[1] = Lanes(hn::InterleaveUpper(tag, even, odd));
        }
    }
    /// Row k: the four elements of lane k of every quad; then a 4x4 transpose within each quad.
    static void gather4(const float* base, LanesInt index, Lanes out[4]) {
        alignas(64) std::int32_t at[simd::lanes];
        hn::Store(index.v, simd::IntTag(), at);
        simd::FloatVector rows[4];
        for (int k = 0; k < 4; ++k) rows[k] = load_quads(base, at + k);
        transpose(rows, out);
    }
    /// Blended as they are stored, so that one transpose does for the four texels.
    static void bilinear4(const float* base, const LanesInt index[4], Lanes weight_x,
                          Lanes weight_y, Lanes out[4]) {
        alignas(64) std::int32_t at[4][simd::lanes];
        for (int i = 0; i < 4; ++i) hn::Store(index[i].v, simd::IntTag(), at[i]);
        const auto mix = [](auto a, auto b, auto t) {
            return hn::Add(a, hn::Mul(t, hn::Sub(b, a)));
        };
        const auto row = [&](int k, simd::FloatVector x, simd::FloatVector y) {
            const auto top = mix(load_quads(base, at[0] + k), load_quads(base, at[1] + k), x);
            const auto bottom = mix(load_quads(base, at[2] + k), load_quads(base, at[3] + k), x);
            return mix(top, bottom, y);
        };
        const simd::FloatVector rows[4] = {
            row(0, hn::Broadcast<0>(weight_x.v), hn::Broadcast<0>(weight_y.v)),
            row(1, hn::Broadcast<1>(weight_x.v), hn::Broadcast<1>(weight_y.v)),
            row(2, hn::Broadcast<2>(weight_x.v), hn::Broadcast<2>(weight_y.v)),
            row(3, hn::Broadcast<3>(weight_x.v), hn::Broadcast<3>(weight_y.v))};
        transpose(rows, out);
    }
    template <int a, int b, int c, int d>
    static Lanes swizzle(Lanes x) {
        if constexpr (a == 1 && b == 0 && c == 3 && d == 2) {
            return Lanes(hn::Shuffle2301(x.v));
        } else if constexpr (a == 2 && b == 3 && c == 0 && d == 1) {
            return Lanes(hn::Shuffle1032(x.v));
        } else if constexpr (a == 3 && b == 2 && c == 1 && d == 0) {
            return Lanes(hn::Shuffle0123(x.v));
        } else {
            static_assert(a == b && b == c && c == d, "no such quad swap");
            return Lanes(hn::Broadcast<a>(x.v));
        }
    }

  private:
    /// A 4x4 transpose within each quad.
    static void transpose(const simd::FloatVector rows[4], Lanes out[4]) {
        const simd::FloatTag tag;
        const hn::RepartitionToWide<simd::FloatTag> wide;
        const auto low01 = hn::BitCast(wide, hn::InterleaveLower(tag, rows[0], rows[1]));
        const auto low23 = hn::BitCast(wide, hn::InterleaveLower(tag, rows[2], rows[3]));
        const auto high01 = hn::BitCast(wide, hn::InterleaveUpper(tag, rows[0], rows[1]));
        const auto high23 = hn::BitCast(wide, hn::InterleaveUpper(tag, rows[2], rows[3]));
        out[0] = Lanes(hn::BitCast(tag, hn::InterleaveLower(wide, low01, low23)));
        out[1] = Lanes(hn::BitCast(tag, hn::InterleaveUpper(wide, low01, low23)));
        out[2] = Lanes(hn::BitCast(tag, hn::InterleaveLower(wide, high01, high23)));
        out[3] = Lanes(hn::BitCast(tag, hn::InterleaveUpper(wide, high01, high23)));
    }
    /// base[index] and base[index + 1] of half of the lanes, side by side.
    template <class Half>
    static simd::FloatVector gather_pairs(const float* base, Half index) {
        const hn::RepartitionToWide<simd::IntTag> wide;
        const auto bytes = hn::ShiftLeft<2>(hn::PromoteTo(wide, index));
        return hn::BitCast(
            simd::FloatTag(),
            hn::GatherOffset(wide, reinterpret_cast<const std::int64_t*>(base), bytes));
    }
    /// Of a table of one register.
    static LanesInt look_up(const std::int32_t* table, LanesInt index) {
        const simd::IntTag tag;
        return LanesInt(
            hn::TableLookupLanes(hn::LoadU(tag, table), hn::IndicesFromVec(tag, index.v)));
    }
    /// Two elements from base[at[0]], base[at[1]], base[at[4]], base[at[5]], ... side by side.
    template <int lanes = simd::lanes>
    static hn::Vec<hn::FixedTag<double, lanes / 2>> load_pairs(const float* base,
                                                               const std::int32_t* at) {
        if constexpr (lanes == 4) {
            alignas(16) double pair[2];
            __builtin_memcpy(&pair[0], base + at[0], sizeof(double));
            __builtin_memcpy(&pair[1], base + at[1], sizeof(double));
            return hn::Load(hn::FixedTag<double, 2>(), pair);
        } else {
            return hn::Combine(hn::FixedTag<double, lanes / 2>(),
                               load_pairs<lanes / 2>(base, at + lanes / 2),
                               load_pairs<lanes / 2>(base, at));
        }
    }
    /// Four elements from base[at[0]], base[at[4]], ... side by side.
    template <int lanes = simd::lanes>
    static hn::Vec<hn::FixedTag<float, lanes>> load_quads(const float* base,
                                                          const std::int32_t* at) {
        if constexpr (lanes == 4) {
            return hn::LoadU(hn::FixedTag<float, 4>(), base + at[0]);
        } else {
            return hn::Combine(hn::FixedTag<float, lanes>(),
                               load_quads<lanes / 2>(base, at + lanes / 2),
                               load_quads<lanes / 2>(base, at));
        }
    }
};

/// A double a lane, in two registers: the lower and the upper half of the lanes.
class LanesWide {
    using Tag = hn::ScalableTag<double>;
    using HalfTag = hn::Half<simd::FloatTag>;
    using Vector = hn::Vec<Tag>;

  public:
    LanesWide() = default;
    LanesWide(double all) : low(hn::Set(Tag(), all)), high(low) {}

    friend LanesWide operator+(LanesWide a, LanesWide b) {
        return {hn::Add(a.low, b.low), hn::Add(a.high, b.high)};
    }
    friend LanesWide operator-(LanesWide a, LanesWide b) {
        return {hn::Sub(a.low, b.low), hn::Sub(a.high, b.high)};
    }
    friend LanesWide operator*(LanesWide a, LanesWide b) {
        return {hn::Mul(a.low, b.low), hn::Mul(a.high, b.high)};
    }
    friend LanesWide operator/(LanesWide a, LanesWide b) {
        return {hn::Div(a.low, b.low), hn::Div(a.high, b.high)};
    }

  private:
    friend struct WideOps<Lanes>;
    LanesWide(Vector lower, Vector upper) : low(lower), high(upper) {}

    Vector low, high;
};

template <>
struct WideOps<Lanes> {
    using Type = LanesWide;
    static LanesWide widen(Lanes a) {
        const LanesWide::HalfTag half;
        return {hn::PromoteTo(LanesWide::Tag(), hn::LowerHalf(half, a.v)),
                hn::PromoteTo(LanesWide::Tag(), hn::UpperHalf(half, a.v))};
    }
    static LanesWide load(const double* from) {
        return {hn::LoadU(LanesWide::Tag(), from),
                hn::LoadU(LanesWide::Tag(), from + simd::lanes / 2)};
    }
    static Lanes narrow(LanesWide a) {
        const LanesWide::HalfTag half;
        return Lanes(
            hn::Combine(simd::FloatTag(), hn::DemoteTo(half, a.high), hn::DemoteTo(half, a.low)));
    }
};

}  // namespace quadrel

/// GLM refuses types that are not floating-point by this trait.
template <>
struct std::numeric_limits<quadrel::Lanes> : std::numeric_limits<float> {};
