#include "quadrel/texture/srgb.hpp"

#include <cmath>

namespace quadrel {

namespace {

double integer_power(double x, int n) {
    double result = 1;
    for (int i = 0; i < n; ++i) result *= x;
    return result;
}

/// The n-th root of x in (0, 2], by Newton's method from above, where it falls monotonically; it
/// stops when it no longer does.
double root(double x, int n) {
    double r = x < 1 ? 1 : x;
    for (int i = 0; i < 200; ++i) {
        const double next = ((n - 1) * r + x / integer_power(r, n - 1)) / n;
        if (!(next < r)) break;
        r = next;
    }
    return r;
}

}  // namespace

double srgb_to_linear(double encoded) {
    if (encoded <= 0.04045) return encoded / 12.92;
    const double base = (encoded + 0.055) / 1.055;
    return base * base * root(base * base, 5);  // base^2.4
}

double linear_to_srgb(double linear) {
    if (linear <= 0.0031308) return linear * 12.92;
    const double twelfth_of_fifth = root(std::sqrt(std::sqrt(integer_power(linear, 5))), 3);
    return 1.055 * twelfth_of_fifth - 0.055;  // linear^(5/12)
}

}  // namespace quadrel
