// Lanes: packed float lanes, 4, 8 or 16 wide, for the instruction set that this file is compiled
// for. The only file that knows SIMD, with lane_fetches.hpp behind it. Equal to Quad<float> bit for
// bit (NaN payloads aside).
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

/// A boolean per lane.
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

/// A 32-bit integer per lane; sums and products wrap around.
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

/// A float per lane.
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
    /// With upper halves of registers in use, plain instructions wait for one another. Compilers
    /// see to it where a function of wide registers returns, but not at every one (g++ 12).
    static void leave() {
#ifdef __AVX__
        _mm256_zeroupper();
#endif
    }
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
#if HWY_NATIVE_FMA
    /// a * b - product, rounded once: exact where `product` is a * b rounded and nothing
    /// underflows.
    static Lanes product_error(Lanes a, Lanes b, Lanes product) {
        return Lanes(hn::MulSub(a.v, b.v, product.v));
    }
#endif
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
    // Of neighbouring elements: lane_fetches.hpp.
    static void gather2(const float* base, LanesInt index, Lanes out[2]);
    static void gather4(const float* base, LanesInt index, Lanes out[4]);
    static void bilinear4(const float* base, const LanesInt index[4], Lanes weight_x,
                          Lanes weight_y, Lanes out[4]);
    static void trilinear4(const float* base, const LanesInt fine[4], Lanes fine_x, Lanes fine_y,
                           const LanesInt coarse[4], Lanes coarse_x, Lanes coarse_y, Lanes weight,
                           Lanes out[4]);
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
    /// Of a table of one register.
    static LanesInt look_up(const std::int32_t* table, LanesInt index) {
        const simd::IntTag tag;
        return LanesInt(
            hn::TableLookupLanes(hn::LoadU(tag, table), hn::IndicesFromVec(tag, index.v)));
    }
};

/// A double per lane, in two registers: the lower and the upper half of the lanes.
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

#include "quadrel/num/lane_fetches.hpp"
