// Plain float and double as number types of one lane: the meaning of every lane operation, written
// once, and the way the scene side calls the functions of this room (quadrel::sin(double)).
#pragma once

#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>

#include "quadrel/num/traits.hpp"

namespace quadrel {

/// float or double.
template <class T>
concept PlainFloat = std::same_as<T, float> || std::same_as<T, double>;
/// What a lane may hold besides a boolean.
template <class T>
concept PlainLane = PlainFloat<T> || std::same_as<T, std::int32_t>;

template <PlainFloat T>
struct NumberTraits<T> {
    using Scalar = T;
    using Int = std::int32_t;
    using Mask = bool;
    static constexpr int lanes = 1;
};

template <PlainFloat T>
struct WideOps<T> {
    using Type = double;
    static double widen(T a) { return a; }
    static double load(const double* from) { return *from; }
    static T narrow(double a) { return static_cast<T>(a); }
};

/// A boolean of one lane, and what & and | make of two of them.
template <class B>
concept PlainMask = std::same_as<B, bool> || std::same_as<B, int>;

template <PlainMask B>
bool any(B m) {
    return m != 0;
}
template <PlainMask B>
bool all(B m) {
    return m != 0;
}
template <PlainMask B>
int count(B m) {
    return m != 0 ? 1 : 0;
}
template <PlainLane T>
T select(bool m, T a, T b) {
    return m ? a : b;
}

// ---- Integers: sums and products wrap around, as they do in SIMD registers ----------------------

template <std::same_as<std::int32_t> I>
I min(I a, I b) {
    return b < a ? b : a;
}
template <std::same_as<std::int32_t> I>
I max(I a, I b) {
    return a < b ? b : a;
}
/// Shifts by a constant in [0, 31]; right shifts are arithmetic.
template <int bits>
std::int32_t shift_left(std::int32_t a) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) << bits);
}
template <int bits>
std::int32_t shift_right(std::int32_t a) {
    return a >> bits;
}

/// By a count of each lane's own, in [0, 31].
template <std::same_as<std::int32_t> I>
I shift_left(I a, I bits) {
    return static_cast<I>(static_cast<std::uint32_t>(a) << bits);
}
template <std::same_as<std::int32_t> I>
I shift_right(I a, I bits) {
    return a >> bits;
}

// ---- Exact operations and rounding to integers --------------------------------------------------

template <PlainFloat T>
T sqrt(T a) {
    return std::sqrt(a);
}
template <PlainFloat T>
T abs(T a) {
    return std::fabs(a);
}
template <PlainFloat T>
T floor(T a) {
    return std::floor(a);
}
template <PlainFloat T>
T ceil(T a) {
    return std::ceil(a);
}
template <PlainFloat T>
T trunc(T a) {
    return std::trunc(a);
}
/// Nearest integer, halves to even.
template <PlainFloat T>
T round_even(T a) {
    return std::nearbyint(a);
}
/// Magnitude of a, sign bit of b.
template <PlainFloat T>
T copysign(T a, T b) {
    return std::copysign(a, b);
}
/// Truncates towards zero; NaN gives 0, out of range saturates. The only float-to-int on lanes.
template <PlainFloat T>
std::int32_t to_int(T x) {
    if (!(x == x)) return 0;
    if (x >= T(2147483648.0)) return std::numeric_limits<std::int32_t>::max();
    if (x < T(-2147483648.0)) return std::numeric_limits<std::int32_t>::min();
    return static_cast<std::int32_t>(x);
}
/// to_int of what is known to be within the range of integers; of anything else, some integer.
/// Lanes need one instruction for it.
template <PlainFloat T>
std::int32_t to_int_in_range(T x) {
    return to_int(x);
}
/// The bits of a float as an integer, and back.
template <std::same_as<float> T>
std::int32_t as_int(T a) {
    return std::bit_cast<std::int32_t>(a);
}
template <std::same_as<std::int32_t> I>
float as_float(I a) {
    return std::bit_cast<float>(a);
}

// ---- The parts of a floating-point number, for the texts of math.hpp ----------------------------

/// The IEEE 754 binary interchange format of T.
template <PlainFloat T>
struct FloatFormat {
    using Bits = std::conditional_t<std::same_as<T, float>, std::uint32_t, std::uint64_t>;
    static constexpr int fraction_bits = std::numeric_limits<T>::digits - 1;
    static constexpr int bias = std::numeric_limits<T>::max_exponent - 1;
    static constexpr Bits fraction_mask = (Bits(1) << fraction_bits) - 1;
    static constexpr Bits exponent_mask = Bits(2 * bias + 1);
};

/// floor(log2 |x|) of a normal number.
template <PlainFloat T>
T exponent(T x) {
    using Format = FloatFormat<T>;
    const auto bits = std::bit_cast<typename Format::Bits>(x) >> Format::fraction_bits;
    return static_cast<T>(static_cast<int>(bits & Format::exponent_mask) - Format::bias);
}
/// |x| / 2^exponent(x), in [1, 2), of a normal number.
template <PlainFloat T>
T significand(T x) {
    using Format = FloatFormat<T>;
    const auto fraction = std::bit_cast<typename Format::Bits>(x) & Format::fraction_mask;
    return std::bit_cast<T>(fraction | std::bit_cast<typename Format::Bits>(T(1)));
}
/// 2^n of an integer n whose power is a normal number; NaN counts as 0.
template <PlainFloat T>
T power_of_two(T n) {
    using Format = FloatFormat<T>;
    const auto biased = static_cast<typename Format::Bits>(to_int(n) + Format::bias);
    return std::bit_cast<T>(biased << Format::fraction_bits);
}

// ---- Memory -------------------------------------------------------------------------------------

template <PlainLane T>
void store(T* to, T a) {
    *to = a;
}
template <std::same_as<bool> B>
void store(std::uint32_t* to, B a) {
    *to = a ? 0xffffffffu : 0u;
}

template <PlainFloat T>
struct PacketOps<T> {
    template <class Element>
    static T load(const Element* from) {
        return static_cast<T>(*from);
    }
    static std::int32_t load_int(const std::int32_t* from) { return *from; }
    static bool load_mask(const std::uint32_t* from) { return *from != 0; }
    static T from_int(std::int32_t a) { return static_cast<T>(a); }
    static T gather(const float* base, std::int32_t index) { return static_cast<T>(base[index]); }
    static std::int32_t gather(const std::int32_t* base, std::int32_t index) { return base[index]; }
    static std::int32_t look_up16(const std::int32_t* table, std::int32_t index) {
        return table[index];
    }
    static void gather2(const float* base, std::int32_t index, T out[2]) {
        for (int c = 0; c < 2; ++c) out[c] = gather(base + c, index);
    }
    static void gather4(const float* base, std::int32_t index, T out[4]) {
        for (int c = 0; c < 4; ++c) out[c] = gather(base + c, index);
    }
};

}  // namespace quadrel
