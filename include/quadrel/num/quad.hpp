// Quad<T>: the four lanes of one 2x2 fragment quad in a plain array. Quad<float> is the declared
// truth for the bits of every other float type; Quad<double> measures rounding.
#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <limits>

#include "quadrel/num/scalar.hpp"

namespace quadrel {

/// Result{op(a, b...)} lane by lane.
template <class Result, class Op, class... Packets>
Result map_lanes(Op op, const Packets&... packets) {
    Result result;
    for (int i = 0; i < 4; ++i) result.lane[i] = op(packets.lane[i]...);
    return result;
}

/// Four booleans.
struct QuadMask {
    bool lane[4];

    QuadMask() = default;
    QuadMask(bool all) : lane{all, all, all, all} {}

    friend QuadMask operator&(QuadMask a, QuadMask b) {
        return map_lanes<QuadMask>(std::logical_and(), a, b);
    }
    friend QuadMask operator|(QuadMask a, QuadMask b) {
        return map_lanes<QuadMask>(std::logical_or(), a, b);
    }
    friend QuadMask operator!(QuadMask a) { return map_lanes<QuadMask>(std::logical_not(), a); }
};

inline bool any(QuadMask m) { return m.lane[0] || m.lane[1] || m.lane[2] || m.lane[3]; }
inline bool all(QuadMask m) { return m.lane[0] && m.lane[1] && m.lane[2] && m.lane[3]; }
inline int count(QuadMask m) { return m.lane[0] + m.lane[1] + m.lane[2] + m.lane[3]; }

/// Four 32-bit integers. Sums and products wrap around, as they do in SIMD registers.
struct QuadInt {
    std::int32_t lane[4];

    QuadInt() = default;
    QuadInt(std::int32_t all) : lane{all, all, all, all} {}

    friend QuadInt operator+(QuadInt a, QuadInt b) { return wrapped(std::plus(), a, b); }
    friend QuadInt operator-(QuadInt a, QuadInt b) { return wrapped(std::minus(), a, b); }
    friend QuadInt operator*(QuadInt a, QuadInt b) { return wrapped(std::multiplies(), a, b); }
    friend QuadInt operator-(QuadInt a) { return QuadInt(0) - a; }
    friend QuadInt operator&(QuadInt a, QuadInt b) { return wrapped(std::bit_and(), a, b); }
    friend QuadInt operator|(QuadInt a, QuadInt b) { return wrapped(std::bit_or(), a, b); }
    friend QuadInt operator^(QuadInt a, QuadInt b) { return wrapped(std::bit_xor(), a, b); }
    QuadInt& operator+=(QuadInt b) { return *this = *this + b; }
    QuadInt& operator-=(QuadInt b) { return *this = *this - b; }

    /// Shifts by a constant in [0, 31]; right shifts are arithmetic.
    template <int bits>
    friend QuadInt shift_left(QuadInt a) {
        return map_lanes<QuadInt>([](std::int32_t x) { return quadrel::shift_left<bits>(x); }, a);
    }
    template <int bits>
    friend QuadInt shift_right(QuadInt a) {
        return map_lanes<QuadInt>([](std::int32_t x) { return quadrel::shift_right<bits>(x); }, a);
    }

    /// By a count of each lane's own.
    friend QuadInt shift_left(QuadInt a, QuadInt bits) {
        return map_lanes<QuadInt>(
            [](std::int32_t x, std::int32_t n) { return quadrel::shift_left(x, n); }, a, bits);
    }
    friend QuadInt shift_right(QuadInt a, QuadInt bits) {
        return map_lanes<QuadInt>(
            [](std::int32_t x, std::int32_t n) { return quadrel::shift_right(x, n); }, a, bits);
    }

    friend QuadMask operator==(QuadInt a, QuadInt b) {
        return map_lanes<QuadMask>(std::equal_to(), a, b);
    }
    friend QuadMask operator<(QuadInt a, QuadInt b) {
        return map_lanes<QuadMask>(std::less(), a, b);
    }
    friend QuadMask operator!=(QuadInt a, QuadInt b) { return !(a == b); }
    friend QuadMask operator>(QuadInt a, QuadInt b) { return b < a; }
    friend QuadMask operator<=(QuadInt a, QuadInt b) { return !(b < a); }
    friend QuadMask operator>=(QuadInt a, QuadInt b) { return !(a < b); }

  private:
    // Signed overflow is undefined in C++; unsigned arithmetic wraps around.
    template <class Op>
    static QuadInt wrapped(Op op, QuadInt a, QuadInt b) {
        const auto lane = [op](std::uint32_t x, std::uint32_t y) {
            return static_cast<std::int32_t>(op(x, y));
        };
        return map_lanes<QuadInt>(lane, a, b);
    }
};

inline QuadInt select(QuadMask m, QuadInt a, QuadInt b) {
    return map_lanes<QuadInt>([](bool c, std::int32_t x, std::int32_t y) { return c ? x : y; }, m,
                              a, b);
}
inline QuadInt min(QuadInt a, QuadInt b) { return select(b < a, b, a); }
inline QuadInt max(QuadInt a, QuadInt b) { return select(a < b, b, a); }

/// Four floating-point lanes; T is float, double or Dual (dual.hpp).
template <class T>
struct Quad {
    T lane[4];

    Quad() = default;
    Quad(T all) : lane{all, all, all, all} {}
    /// A constant, where a lane is more than its value.
    Quad(Scalar<Quad> all) requires(!std::same_as<Scalar<Quad>, T>) : Quad(T(all)) {}
    Quad(T a, T b, T c, T d) : lane{a, b, c, d} {}

    friend Quad operator+(Quad a, Quad b) { return map_lanes<Quad>(std::plus(), a, b); }
    friend Quad operator-(Quad a, Quad b) { return map_lanes<Quad>(std::minus(), a, b); }
    friend Quad operator*(Quad a, Quad b) { return map_lanes<Quad>(std::multiplies(), a, b); }
    friend Quad operator/(Quad a, Quad b) { return map_lanes<Quad>(std::divides(), a, b); }
    friend Quad operator-(Quad a) { return map_lanes<Quad>(std::negate(), a); }
    friend Quad operator+(Quad a) { return a; }
    Quad& operator+=(Quad b) { return *this = *this + b; }
    Quad& operator-=(Quad b) { return *this = *this - b; }
    Quad& operator*=(Quad b) { return *this = *this * b; }
    Quad& operator/=(Quad b) { return *this = *this / b; }

    friend QuadMask operator<(Quad a, Quad b) { return map_lanes<QuadMask>(std::less(), a, b); }
    friend QuadMask operator<=(Quad a, Quad b) {
        return map_lanes<QuadMask>(std::less_equal(), a, b);
    }
    friend QuadMask operator>(Quad a, Quad b) { return map_lanes<QuadMask>(std::greater(), a, b); }
    friend QuadMask operator>=(Quad a, Quad b) {
        return map_lanes<QuadMask>(std::greater_equal(), a, b);
    }
    friend QuadMask operator==(Quad a, Quad b) {
        return map_lanes<QuadMask>(std::equal_to(), a, b);
    }
    friend QuadMask operator!=(Quad a, Quad b) {
        return map_lanes<QuadMask>(std::not_equal_to(), a, b);
    }
};

template <class T>
struct NumberTraits<Quad<T>> {
    using Scalar = T;
    using Int = QuadInt;
    using Mask = QuadMask;
    static constexpr int lanes = 4;
};

// Each of these is the operation of scalar.hpp in every lane.

template <class T>
Quad<T> select(QuadMask m, Quad<T> a, Quad<T> b) {
    return map_lanes<Quad<T>>([](bool c, T x, T y) { return c ? x : y; }, m, a, b);
}
template <class T>
Quad<T> sqrt(Quad<T> a) {
    return map_lanes<Quad<T>>([](T x) { return sqrt(x); }, a);
}
template <class T>
Quad<T> abs(Quad<T> a) {
    return map_lanes<Quad<T>>([](T x) { return abs(x); }, a);
}
template <class T>
Quad<T> floor(Quad<T> a) {
    return map_lanes<Quad<T>>([](T x) { return floor(x); }, a);
}
template <class T>
Quad<T> ceil(Quad<T> a) {
    return map_lanes<Quad<T>>([](T x) { return ceil(x); }, a);
}
template <class T>
Quad<T> trunc(Quad<T> a) {
    return map_lanes<Quad<T>>([](T x) { return trunc(x); }, a);
}
template <class T>
Quad<T> round_even(Quad<T> a) {
    return map_lanes<Quad<T>>([](T x) { return round_even(x); }, a);
}
template <class T>
Quad<T> copysign(Quad<T> a, Quad<T> b) {
    return map_lanes<Quad<T>>([](T x, T y) { return copysign(x, y); }, a, b);
}
template <class T>
QuadInt to_int(Quad<T> a) {
    return map_lanes<QuadInt>([](T x) { return to_int(x); }, a);
}
template <class T>
QuadInt to_int_in_range(Quad<T> a) {
    return to_int(a);
}
inline QuadInt as_int(Quad<float> a) {
    return map_lanes<QuadInt>([](float x) { return as_int(x); }, a);
}
inline Quad<float> as_float(QuadInt a) {
    return map_lanes<Quad<float>>([](std::int32_t x) { return as_float(x); }, a);
}
template <class T>
Quad<T> exponent(Quad<T> a) {
    return map_lanes<Quad<T>>([](T x) { return exponent(x); }, a);
}
template <class T>
Quad<T> significand(Quad<T> a) {
    return map_lanes<Quad<T>>([](T x) { return significand(x); }, a);
}
template <class T>
Quad<T> power_of_two(Quad<T> n) {
    return map_lanes<Quad<T>>([](T x) { return power_of_two(x); }, n);
}

template <class T>
void store(T* to, Quad<T> a) {
    for (int i = 0; i < 4; ++i) to[i] = a.lane[i];
}
inline void store(std::int32_t* to, QuadInt a) {
    for (int i = 0; i < 4; ++i) to[i] = a.lane[i];
}
/// One uint32 per lane: 0 or all ones.
inline void store(std::uint32_t* to, QuadMask a) {
    for (int i = 0; i < 4; ++i) to[i] = a.lane[i] ? 0xffffffffu : 0u;
}

template <class T>
struct PacketOps<Quad<T>> {
    template <class Element>
    static Quad<T> load(const Element* from) {
        return {static_cast<T>(from[0]), static_cast<T>(from[1]), static_cast<T>(from[2]),
                static_cast<T>(from[3])};
    }
    static QuadInt load_int(const std::int32_t* from) {
        QuadInt result;
        for (int i = 0; i < 4; ++i) result.lane[i] = from[i];
        return result;
    }
    static QuadMask load_mask(const std::uint32_t* from) {
        QuadMask result;
        for (int i = 0; i < 4; ++i) result.lane[i] = from[i] != 0;
        return result;
    }
    static Quad<T> from_int(QuadInt a) {
        return map_lanes<Quad<T>>([](std::int32_t x) { return static_cast<T>(x); }, a);
    }
    static Quad<T> gather(const float* base, QuadInt index) {
        return map_lanes<Quad<T>>([base](std::int32_t i) { return static_cast<T>(base[i]); },
                                  index);
    }
    static QuadInt gather(const std::int32_t* base, QuadInt index) {
        return map_lanes<QuadInt>([base](std::int32_t i) { return base[i]; }, index);
    }
    static QuadInt look_up16(const std::int32_t* table, QuadInt index) {
        return gather(table, index);
    }
    static void gather2(const float* base, QuadInt index, Quad<T> out[2]) {
        for (int c = 0; c < 2; ++c) out[c] = gather(base + c, index);
    }
    static void gather4(const float* base, QuadInt index, Quad<T> out[4]) {
        for (int c = 0; c < 4; ++c) out[c] = gather(base + c, index);
    }
    template <int a, int b, int c, int d>
    static Quad<T> swizzle(Quad<T> v) {
        return {v.lane[a], v.lane[b], v.lane[c], v.lane[d]};
    }
};

template <class T>
struct WideOps<Quad<T>> {
    using Type = Quad<double>;
    static Quad<double> widen(Quad<T> a) {
        return map_lanes<Quad<double>>([](T x) { return static_cast<double>(x); }, a);
    }
    static Quad<double> load(const double* from) { return PacketOps<Quad<double>>::load(from); }
    static Quad<T> narrow(Quad<double> a) {
        return map_lanes<Quad<T>>([](double x) { return static_cast<T>(x); }, a);
    }
};

}  // namespace quadrel

/// GLM refuses types that are not floating-point by this trait.
template <class T>
struct std::numeric_limits<quadrel::Quad<T>> : std::numeric_limits<T> {};
