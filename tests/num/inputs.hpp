// The same triples of numbers on every machine: every pair of edge values, then numbers from
// several distributions. No call of a mathematical library.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "quadrel/num/scalar.hpp"
#include "random.hpp"

namespace quadrel::num_tests {

using test::Random;

template <PlainFloat T>
std::vector<T> edge_values() {
    using Limits = std::numeric_limits<T>;
    std::vector<T> edges = {T(0),
                            T(1),
                            T(0.5),
                            T(1.5),
                            T(2),
                            T(2.5),
                            T(3),
                            T(10),
                            T(0.1),
                            T(1e-38),
                            T(1e38),
                            T(126.5),
                            T(127),
                            T(128),
                            T(1.5707963267948966),
                            T(3.141592653),
                            T(1e5),
                            T(1e6),
                            T(8388607.5),
                            T(8388608),
                            T(16777216),
                            T(16777218),
                            T(2147483520.0),
                            T(2147483648.0),
                            T(2147483904.0),
                            Limits::min(),
                            Limits::max(),
                            Limits::epsilon(),
                            Limits::denorm_min(),
                            Limits::min() - Limits::denorm_min(),
                            T(1) - Limits::epsilon() / 2,
                            T(1) + Limits::epsilon(),
                            T(0.0031308),
                            T(0.04045),
                            Limits::infinity()};
    const std::size_t positive = edges.size();
    for (std::size_t i = 0; i < positive; ++i) edges.push_back(-edges[i]);
    edges.push_back(Limits::quiet_NaN());
    return edges;
}

/// One number from the distribution numbered `kind`.
template <PlainFloat T>
T draw(Random& random, std::size_t kind) {
    switch (kind % 6) {
        case 0:
            return random.any_bits<T>();
        case 1:
            return static_cast<T>(random.uniform(-10, 10));
        case 2:
            return static_cast<T>(random.integer(-300, 300)) * T(0.5);
        case 3:  // near the zeros of sine and cosine
            return static_cast<T>(random.integer(-100000, 100000)) * T(1.5707963267948966);
        case 4:
            return static_cast<T>(random.uniform(0, 1));
        default:
            return static_cast<T>(random.uniform(-1, 1)) *
                   power_of_two(static_cast<T>(random.integer(-60, 60)));
    }
}

template <PlainFloat T>
struct Inputs {
    std::vector<T> a, b, c;
};

template <PlainFloat T>
Inputs<T> make_inputs(std::size_t count = 16384) {
    const std::vector<T> edges = edge_values<T>();
    Inputs<T> in;
    for (std::size_t i = 0; i < edges.size() * edges.size(); ++i) {
        in.a.push_back(edges[i % edges.size()]);
        in.b.push_back(edges[i / edges.size()]);
        in.c.push_back(edges[(i * 31 + 7) % edges.size()]);
    }
    Random random(1);
    while (in.a.size() < count) {
        const std::size_t kind = in.a.size();
        in.a.push_back(draw<T>(random, kind));
        in.b.push_back(draw<T>(random, kind / 6));
        in.c.push_back(draw<T>(random, kind / 36));
    }
    return in;
}

}  // namespace quadrel::num_tests
