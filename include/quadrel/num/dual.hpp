// Dual numbers: a value in double beside its exact derivatives in window x and y, so that a text
// over F = Quad<Dual> gives the derivatives of what it computes. The values are those of
// Quad<double>, bit for bit.
//
// Every operation has the derivative of the function that it stands for, at the value that num/
// computes: of sin the cosine, not what the approximating polynomial would have. Rounding to
// integers has derivative 0, comparisons look at values, select picks; so texels, which come
// through gather, are constants, and a bilinear fetch differentiates its patch. Where a function
// has a corner (abs at 0, equal arguments of min) the derivative is that of the side that the value
// was taken from. What does not vary adds nothing, even where a derivative is infinite: sqrt of a
// constant 0 has derivative 0.
//
//     const Quad<Dual> x = with_derivatives(Quad<Dual>(3.5), 1, 0);  // the window's x
//     exact_dx(x * x)                                               // Quad<double>: 7 in each lane
//
// dFdx of a dual number is the finite difference, of values and of derivatives alike.
#pragma once

#include "quadrel/num/math.hpp"

namespace quadrel {

/// One lane: value, derivatives per pixel.
struct Dual {
    double value, dx, dy;

    Dual() = default;
    Dual(double constant) : value(constant), dx(0), dy(0) {}
    Dual(double at, double along_x, double along_y) : value(at), dx(along_x), dy(along_y) {}

    friend Dual operator+(const Dual& a, const Dual& b) {
        return {a.value + b.value, a.dx + b.dx, a.dy + b.dy};
    }
    friend Dual operator-(const Dual& a, const Dual& b) {
        return {a.value - b.value, a.dx - b.dx, a.dy - b.dy};
    }
    friend Dual operator*(const Dual& a, const Dual& b);
    friend Dual operator/(const Dual& a, const Dual& b);
    friend Dual operator-(const Dual& a) { return {-a.value, -a.dx, -a.dy}; }

    friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
    friend bool operator<=(const Dual& a, const Dual& b) { return a.value <= b.value; }
    friend bool operator>(const Dual& a, const Dual& b) { return a.value > b.value; }
    friend bool operator>=(const Dual& a, const Dual& b) { return a.value >= b.value; }
    friend bool operator==(const Dual& a, const Dual& b) { return a.value == b.value; }
    friend bool operator!=(const Dual& a, const Dual& b) { return a.value != b.value; }
};

namespace detail {
/// d * factor; 0 where nothing varies, whatever the factor.
inline double scaled(double d, double factor) { return d == 0 ? 0 : d * factor; }
inline double divided(double d, double by) { return d == 0 ? 0 : d / by; }

/// f(a), given as its value and its derivative there.
inline Dual chain(const Dual& a, double value, double slope) {
    return {value, scaled(a.dx, slope), scaled(a.dy, slope)};
}
/// f(a, b), given as its value and its partial derivatives there.
inline Dual chain(const Dual& a, const Dual& b, double value, double by_a, double by_b) {
    return {value, scaled(a.dx, by_a) + scaled(b.dx, by_b),
            scaled(a.dy, by_a) + scaled(b.dy, by_b)};
}
}  // namespace detail

inline Dual operator*(const Dual& a, const Dual& b) {
    return detail::chain(a, b, a.value * b.value, b.value, a.value);
}
inline Dual operator/(const Dual& a, const Dual& b) {
    const double q = a.value / b.value;
    return {q, detail::divided(a.dx - detail::scaled(b.dx, q), b.value),
            detail::divided(a.dy - detail::scaled(b.dy, q), b.value)};
}

// ---- The operations of scalar.hpp ---------------------------------------------------------------

inline Dual sqrt(const Dual& a) {
    const double root = sqrt(a.value);
    return {root, detail::divided(a.dx, 2 * root), detail::divided(a.dy, 2 * root)};
}
inline Dual abs(const Dual& a) {
    return a.value < 0 ? -a : Dual(abs(a.value), a.dx, a.dy);  // abs(-0) is 0
}
inline Dual copysign(const Dual& a, const Dual& b) {
    const double value = copysign(a.value, b.value);
    return detail::chain(a, value, std::signbit(value) == std::signbit(a.value) ? 1 : -1);
}
inline Dual floor(const Dual& a) { return floor(a.value); }
inline Dual ceil(const Dual& a) { return ceil(a.value); }
inline Dual trunc(const Dual& a) { return trunc(a.value); }
inline Dual round_even(const Dual& a) { return round_even(a.value); }
inline std::int32_t to_int(const Dual& a) { return to_int(a.value); }
inline Dual exponent(const Dual& a) { return exponent(a.value); }
inline Dual significand(const Dual& a) {
    const double slope = copysign(power_of_two(-exponent(a.value)), a.value);
    return detail::chain(a, significand(a.value), slope);
}
inline Dual power_of_two(const Dual& n) { return power_of_two(n.value); }

// ---- The functions of math.hpp ------------------------------------------------------------------

inline Dual exp2(const Dual& a) {
    const double value = exp2(a.value);
    return detail::chain(a, value, value * constants::ln_2<double>.hi);
}
inline Dual exp(const Dual& a) {
    const double value = exp(a.value);
    return detail::chain(a, value, value);
}
inline Dual log2(const Dual& a) {
    return detail::chain(a, log2(a.value), constants::log2_e<double>.hi / a.value);
}
inline Dual log(const Dual& a) { return detail::chain(a, log(a.value), 1 / a.value); }

/// x^y: y x^(y - 1) and x^y ln x; at x = 0 the limits.
inline Dual pow(const Dual& x, const Dual& y) {
    const double value = pow(x.value, y.value);
    const double by_x = y.value == 0 ? 0 : y.value * pow(x.value, y.value - 1);
    const double by_y = x.value == 0 && y.value > 0 ? 0 : value * log(x.value);
    return detail::chain(x, y, value, by_x, by_y);
}

namespace detail {
/// Beyond the limit sin, cos and tan are those of a constant 0.
inline bool beyond_trig_limit(double x) { return abs(x) > constants::trig_limit<double>; }
}  // namespace detail

inline Dual sin(const Dual& a) {
    const bool constant = detail::beyond_trig_limit(a.value);
    return detail::chain(a, sin(a.value), constant ? 0 : cos(a.value));
}
inline Dual cos(const Dual& a) {
    const bool constant = detail::beyond_trig_limit(a.value);
    return detail::chain(a, cos(a.value), constant ? 0 : -sin(a.value));
}
inline Dual tan(const Dual& a) {
    const double value = tan(a.value);
    return detail::chain(a, value, detail::beyond_trig_limit(a.value) ? 0 : 1 + value * value);
}
/// (x dy - y dx) / (x^2 + y^2), scaled so that nothing overflows.
inline Dual atan2(const Dual& y, const Dual& x) {
    const double scale = max(abs(x.value), abs(y.value));
    const double xs = x.value / scale, ys = y.value / scale;
    const double square = (xs * xs + ys * ys) * scale;
    return detail::chain(y, x, atan2(y.value, x.value), xs / square, -ys / square);
}
inline Dual atan(const Dual& a) {
    return detail::chain(a, atan(a.value), 1 / (1 + a.value * a.value));
}
inline Dual asin(const Dual& a) {
    return detail::chain(a, asin(a.value), 1 / sqrt((1 - a.value) * (1 + a.value)));
}
inline Dual acos(const Dual& a) {
    return detail::chain(a, acos(a.value), -1 / sqrt((1 - a.value) * (1 + a.value)));
}

// ---- Quad<Dual> as a number type ----------------------------------------------------------------

template <>
struct NumberTraits<Quad<Dual>> {
    using Scalar = double;
    using Element = Dual;
    using Int = QuadInt;
    using Mask = QuadMask;
    static constexpr int lanes = 4;
};

template <>
struct WideOps<Quad<Dual>> {
    using Type = Quad<Dual>;
    static Type widen(const Type& a) { return a; }
    static Type load(const double* from) { return PacketOps<Type>::load(from); }
    static Type narrow(const Type& a) { return a; }
};

/// The values alone.
inline Quad<double> values_of(const Quad<Dual>& a) {
    return map_lanes<Quad<double>>([](const Dual& x) { return x.value; }, a);
}
inline void store(double* to, const Quad<Dual>& a) { store(to, values_of(a)); }

namespace detail {
template <class Function>
Quad<Dual> each_lane(const Quad<Dual>& a, Function function) {
    return map_lanes<Quad<Dual>>(function, a);
}
}  // namespace detail

// Better matches than the texts of math.hpp.
inline Quad<Dual> exp2(const Quad<Dual>& a) {
    return detail::each_lane(a, [](const Dual& x) { return exp2(x); });
}
inline Quad<Dual> exp(const Quad<Dual>& a) {
    return detail::each_lane(a, [](const Dual& x) { return exp(x); });
}
inline Quad<Dual> log2(const Quad<Dual>& a) {
    return detail::each_lane(a, [](const Dual& x) { return log2(x); });
}
inline Quad<Dual> log(const Quad<Dual>& a) {
    return detail::each_lane(a, [](const Dual& x) { return log(x); });
}
inline Quad<Dual> sin(const Quad<Dual>& a) {
    return detail::each_lane(a, [](const Dual& x) { return sin(x); });
}
inline Quad<Dual> cos(const Quad<Dual>& a) {
    return detail::each_lane(a, [](const Dual& x) { return cos(x); });
}
inline Quad<Dual> tan(const Quad<Dual>& a) {
    return detail::each_lane(a, [](const Dual& x) { return tan(x); });
}
inline Quad<Dual> asin(const Quad<Dual>& a) {
    return detail::each_lane(a, [](const Dual& x) { return asin(x); });
}
inline Quad<Dual> acos(const Quad<Dual>& a) {
    return detail::each_lane(a, [](const Dual& x) { return acos(x); });
}
inline Quad<Dual> atan(const Quad<Dual>& a) {
    return detail::each_lane(a, [](const Dual& x) { return atan(x); });
}
inline Quad<Dual> pow(const Quad<Dual>& x, const Quad<Dual>& y) {
    return map_lanes<Quad<Dual>>([](const Dual& p, const Dual& q) { return pow(p, q); }, x, y);
}
inline Quad<Dual> atan2(const Quad<Dual>& y, const Quad<Dual>& x) {
    return map_lanes<Quad<Dual>>([](const Dual& p, const Dual& q) { return atan2(p, q); }, y, x);
}

// ---- Derivatives in and out ---------------------------------------------------------------------

/// The same values with these derivatives per pixel, in every lane.
inline Quad<Dual> with_derivatives(const Quad<Dual>& a, double dx, double dy) {
    return map_lanes<Quad<Dual>>([=](const Dual& x) { return Dual(x.value, dx, dy); }, a);
}

/// The exact derivative in window x (y) at each lane's own point, per pixel.
inline Quad<double> exact_dx(const Quad<Dual>& a) {
    return map_lanes<Quad<double>>([](const Dual& x) { return x.dx; }, a);
}
inline Quad<double> exact_dy(const Quad<Dual>& a) {
    return map_lanes<Quad<double>>([](const Dual& x) { return x.dy; }, a);
}
template <int size>
vec<size, Quad<double>> exact_dx(const vec<size, Quad<Dual>>& v) {
    vec<size, Quad<double>> result;
    for (int i = 0; i < size; ++i) result[i] = exact_dx(v[i]);
    return result;
}
template <int size>
vec<size, Quad<double>> exact_dy(const vec<size, Quad<Dual>>& v) {
    vec<size, Quad<double>> result;
    for (int i = 0; i < size; ++i) result[i] = exact_dy(v[i]);
    return result;
}

}  // namespace quadrel

/// GLM refuses types that are not floating-point by this trait.
template <>
struct std::numeric_limits<quadrel::Quad<quadrel::Dual>> : std::numeric_limits<double> {};
