// The same numbers on every machine.
#pragma once

#include <bit>
#include <cstdint>

#include "quadrel/num/scalar.hpp"

namespace quadrel::test {

/// Steele, Lea and Flood's SplitMix64 (OOPSLA 2014).
class Random {
  public:
    explicit Random(std::uint64_t seed = 1) : state_(seed) {}
    std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    /// In [low, high).
    double uniform(double low, double high) {
        return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53);
    }
    /// In [0, n).
    int below(int n) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n)); }
    /// In [low, high].
    int integer(int low, int high) { return low + below(high - low + 1); }
    bool chance(double probability) { return uniform(0, 1) < probability; }
    /// Any bit pattern: denormals, infinities and NaN included.
    template <PlainFloat T>
    T any_bits() {
        return std::bit_cast<T>(static_cast<typename FloatFormat<T>::Bits>(bits()));
    }

  private:
    std::uint64_t state_;
};

}  // namespace quadrel::test
