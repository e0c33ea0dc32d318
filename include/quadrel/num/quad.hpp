// Quad<T>: the four lanes of one 2x2 fragment quad in a plain array. Quad<float> is the declared
// truth for the bits of every other float type; Quad<double> measures rounding.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "quadrel/num/traits.hpp"

namespace quadrel {

/// Four booleans.
struct QuadMask {
    bool lane[4];

    QuadMask() = default;
    QuadMask(bool all) : lane{all, all, all, all} {}

#define QUADREL_LANEWISE(result, expression)              \
    result r;                                             \
    for (int i = 0; i < 4; ++i) r.lane[i] = (expression); \
    return r

    friend QuadMask operator&(QuadMask a, QuadMask b) {
        QUADREL_LANEWISE(QuadMask, a.lane[i] && b.lane[i]);
    }
    friend QuadMask operator|(QuadMask a, QuadMask b) {
        QUADREL_LANEWISE(QuadMask, a.lane[i] || b.lane[i]);
    }
    friend QuadMask operator!(QuadMask a) { QUADREL_LANEWISE(QuadMask, !a.lane[i]); }
};

inline bool any(QuadMask m) { return m.lane[0] || m.lane[1] || m.lane[2] || m.lane[3]; }
inline bool all(QuadMask m) { return m.lane[0] && m.lane[1] && m.lane[2] && m.lane[3]; }

/// Four 32-bit integers. Sums and products wrap around, as they do in SIMD registers.
struct QuadInt {
    std::int32_t lane[4];

    QuadInt() = default;
    QuadInt(std::int32_t all) : lane{all, all, all, all} {}

    static std::int32_t wrap(std::uint32_t bits) { return static_cast<std::int32_t>(bits); }

    friend QuadInt operator+(QuadInt a, QuadInt b) {
        QUADREL_LANEWISE(QuadInt, wrap(std::uint32_t(a.lane[i]) + std::uint32_t(b.lane[i])));
    }
    friend QuadInt operator-(QuadInt a, QuadInt b) {
        QUADREL_LANEWISE(QuadInt, wrap(std::uint32_t(a.lane[i]) - std::uint32_t(b.lane[i])));
    }
    friend QuadInt operator*(QuadInt a, QuadInt b) {
        QUADREL_LANEWISE(QuadInt, wrap(std::uint32_t(a.lane[i]) * std::uint32_t(b.lane[i])));
    }
    friend QuadInt operator-(QuadInt a) { return QuadInt(0) - a; }
    friend QuadInt operator&(QuadInt a, QuadInt b) {
        QUADREL_LANEWISE(QuadInt, a.lane[i] & b.lane[i]);
    }
    friend QuadInt operator|(QuadInt a, QuadInt b) {
        QUADREL_LANEWISE(QuadInt, a.lane[i] | b.lane[i]);
    }
    friend QuadInt operator^(QuadInt a, QuadInt b) {
        QUADREL_LANEWISE(QuadInt, a.lane[i] ^ b.lane[i]);
    }
    /// Shifts by a constant in [0, 31]; right shifts are arithmetic.
    template <int bits>
    friend QuadInt shift_left(QuadInt a) {
        QUADREL_LANEWISE(QuadInt, wrap(std::uint32_t(a.lane[i]) << bits));
    }
    template <int bits>
    friend QuadInt shift_right(QuadInt a) {
        QUADREL_LANEWISE(QuadInt, a.lane[i] >> bits);
    }

    friend QuadMask operator==(QuadInt a, QuadInt b) {
        QUADREL_LANEWISE(QuadMask, a.lane[i] == b.lane[i]);
    }
    friend QuadMask operator!=(QuadInt a, QuadInt b) {
        QUADREL_LANEWISE(QuadMask, a.lane[i] != b.lane[i]);
    }
    friend QuadMask operator<(QuadInt a, QuadInt b) {
        QUADREL_LANEWISE(QuadMask, a.lane[i] < b.lane[i]);
    }
    friend QuadMask operator>(QuadInt a, QuadInt b) { return b < a; }
    friend QuadMask operator<=(QuadInt a, QuadInt b) { return !(b < a); }
    friend QuadMask operator>=(QuadInt a, QuadInt b) { return !(a < b); }
};

inline QuadInt select(QuadMask m, QuadInt a, QuadInt b) {
    QUADREL_LANEWISE(QuadInt, m.lane[i] ? a.lane[i] : b.lane[i]);
}
inline QuadInt min(QuadInt a, QuadInt b) { return select(b < a, b, a); }
inline QuadInt max(QuadInt a, QuadInt b) { return select(a < b, b, a); }

/// Four floating-point lanes; T is float or double.
template <class T>
struct Quad {
    T lane[4];

    Quad() = default;
    Quad(T all) : lane{all, all, all, all} {}
    Quad(T a, T b, T c, T d) : lane{a, b, c, d} {}

    friend Quad operator+(Quad a, Quad b) { QUADREL_LANEWISE(Quad, a.lane[i] + b.lane[i]); }
    friend Quad operator-(Quad a, Quad b) { QUADREL_LANEWISE(Quad, a.lane[i] - b.lane[i]); }
    friend Quad operator*(Quad a, Quad b) { QUADREL_LANEWISE(Quad, a.lane[i] * b.lane[i]); }
    friend Quad operator/(Quad a, Quad b) { QUADREL_LANEWISE(Quad, a.lane[i] / b.lane[i]); }
    friend Quad operator-(Quad a) { QUADREL_LANEWISE(Quad, -a.lane[i]); }
    friend Quad operator+(Quad a) { return a; }
    Quad& operator+=(Quad b) { return *this = *this + b; }
    Quad& operator-=(Quad b) { return *this = *this - b; }
    Quad& operator*=(Quad b) { return *this = *this * b; }
    Quad& operator/=(Quad b) { return *this = *this / b; }

    friend QuadMask operator<(Quad a, Quad b) { QUADREL_LANEWISE(QuadMask, a.lane[i] < b.lane[i]); }
    friend QuadMask operator<=(Quad a, Quad b) {
        QUADREL_LANEWISE(QuadMask, a.lane[i] <= b.lane[i]);
    }
    friend QuadMask operator>(Quad a, Quad b) { QUADREL_LANEWISE(QuadMask, a.lane[i] > b.lane[i]); }
    friend QuadMask operator>=(Quad a, Quad b) {
        QUADREL_LANEWISE(QuadMask, a.lane[i] >= b.lane[i]);
    }
    friend QuadMask operator==(Quad a, Quad b) {
        QUADREL_LANEWISE(QuadMask, a.lane[i] == b.lane[i]);
    }
    friend QuadMask operator!=(Quad a, Quad b) {
        QUADREL_LANEWISE(QuadMask, a.lane[i] != b.lane[i]);
    }
};

template <class T>
struct NumberTraits<Quad<T>> {
    using Scalar = T;
    using Int = QuadInt;
    using Mask = QuadMask;
    static constexpr int lanes = 4;
};

template <class T>
Quad<T> select(QuadMask m, Quad<T> a, Quad<T> b) {
    QUADREL_LANEWISE(Quad<T>, m.lane[i] ? a.lane[i] : b.lane[i]);
}
template <class T>
Quad<T> sqrt(Quad<T> a) {
    QUADREL_LANEWISE(Quad<T>, std::sqrt(a.lane[i]));
}
template <class T>
Quad<T> abs(Quad<T> a) {
    QUADREL_LANEWISE(Quad<T>, std::fabs(a.lane[i]));
}
template <class T>
Quad<T> floor(Quad<T> a) {
    QUADREL_LANEWISE(Quad<T>, std::floor(a.lane[i]));
}
template <class T>
Quad<T> ceil(Quad<T> a) {
    QUADREL_LANEWISE(Quad<T>, std::ceil(a.lane[i]));
}
template <class T>
Quad<T> trunc(Quad<T> a) {
    QUADREL_LANEWISE(Quad<T>, std::trunc(a.lane[i]));
}
/// Nearest integer, halves to even.
template <class T>
Quad<T> round_even(Quad<T> a) {
    QUADREL_LANEWISE(Quad<T>, std::nearbyint(a.lane[i]));
}
/// Magnitude of a, sign bit of b.
template <class T>
Quad<T> copysign(Quad<T> a, Quad<T> b) {
    QUADREL_LANEWISE(Quad<T>, std::copysign(a.lane[i], b.lane[i]));
}

/// One lane to int: truncates, NaN gives 0, out of range saturates.
template <class T>
std::int32_t saturating_int(T x) {
    if (!(x == x)) return 0;
    if (x >= T(2147483648.0)) return std::numeric_limits<std::int32_t>::max();
    if (x < T(-2147483648.0)) return std::numeric_limits<std::int32_t>::min();
    return static_cast<std::int32_t>(x);
}

/// Truncates towards zero; NaN gives 0, out of range saturates. The only float-to-int on lanes.
template <class T>
QuadInt to_int(Quad<T> a) {
    QUADREL_LANEWISE(QuadInt, saturating_int(a.lane[i]));
}
/// The bits of float lanes as integers, and back.
inline QuadInt as_int(Quad<float> a) {
    QUADREL_LANEWISE(QuadInt, std::bit_cast<std::int32_t>(a.lane[i]));
}
inline Quad<float> as_float(QuadInt a) {
    QUADREL_LANEWISE(Quad<float>, std::bit_cast<float>(a.lane[i]));
}

template <class T>
void store(T* to, Quad<T> a) {
    for (int i = 0; i < 4; ++i) to[i] = a.lane[i];
}
inline void store(std::int32_t* to, QuadInt a) {
    for (int i = 0; i < 4; ++i) to[i] = a.lane[i];
}
/// One uint32 a lane: 0 or all ones.
inline void store(std::uint32_t* to, QuadMask a) {
    for (int i = 0; i < 4; ++i) to[i] = a.lane[i] ? 0xffffffffu : 0u;
}

template <class T>
struct PacketOps<Quad<T>> {
    template <class Element>
    static Quad<T> load(const Element* from) {
        QUADREL_LANEWISE(Quad<T>, static_cast<T>(from[i]));
    }
    static QuadInt load_int(const std::int32_t* from) { QUADREL_LANEWISE(QuadInt, from[i]); }
    static QuadMask load_mask(const std::uint32_t* from) {
        QUADREL_LANEWISE(QuadMask, from[i] != 0);
    }
    static Quad<T> from_int(QuadInt a) { QUADREL_LANEWISE(Quad<T>, static_cast<T>(a.lane[i])); }
    static Quad<T> gather(const float* base, QuadInt index) {
        QUADREL_LANEWISE(Quad<T>, static_cast<T>(base[index.lane[i]]));
    }
    static QuadInt gather(const std::int32_t* base, QuadInt index) {
        QUADREL_LANEWISE(QuadInt, base[index.lane[i]]);
    }
    template <int a, int b, int c, int d>
    static Quad<T> swizzle(Quad<T> v) {
        return {v.lane[a], v.lane[b], v.lane[c], v.lane[d]};
    }
};

#undef QUADREL_LANEWISE

}  // namespace quadrel

/// GLM refuses types that are not floating-point by this trait.
template <class T>
struct std::numeric_limits<quadrel::Quad<T>> : std::numeric_limits<T> {};
