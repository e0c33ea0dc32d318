// The words that loops of a stage's text are written with. A number type that computes takes them
// for what they say; one that writes the text down as a shader runs each body once and writes a
// loop. What may be skipped is decided behind such words, so that no text says it.
//
//     for (const auto k : steps<F>(0, n)) {
//         const F s = number<F>(k) / number<F>(n);
//         ...
//         if (none(active)) break;
//     }
#pragma once

#include <cstdint>

#include "quadrel/num/scalar.hpp"  // the masks of plain numbers, whose any() no argument finds

namespace quadrel {

/// The number of a step, the same in all lanes.
class [[maybe_unused]] Step {
  public:
    explicit constexpr Step(int k) : k_(k) {}
    constexpr operator int() const { return k_; }

  private:
    int k_;
};

/// The steps first, first + 1, ..., last, for a range-based loop; none if last < first.
class Steps {
  public:
    class Iterator {
      public:
        explicit constexpr Iterator(std::int64_t k) : k_(k) {}
        constexpr bool operator!=(const Iterator& other) const { return k_ != other.k_; }
        constexpr Step operator*() const { return Step(static_cast<int>(k_)); }
        constexpr void operator++() { ++k_; }

      private:
        std::int64_t k_;  // one past the last int must fit
    };

    constexpr Steps(int first, int last)
        : first_(first), end_(last < first ? first : std::int64_t{last} + 1) {}
    constexpr Iterator begin() const { return Iterator(first_); }
    constexpr Iterator end() const { return Iterator(end_); }

  private:
    std::int64_t first_, end_;
};

/// first, first + 1, ..., last.
template <Number F>
constexpr Steps steps(int first, int last) {
    return {first, last};
}

/// Steps without an end but those of the body's `if (none(...)) break;`.
template <Number F>
constexpr Steps rounds() {
    return {0, 0x7fffffff};
}

/// A step's number, or a parameter, in every lane.
template <Number F>
F number(int k) {
    return F(static_cast<Scalar<F>>(k));
}

/// No lane.
template <class M>
requires requires(M mask) { any(mask); }
bool none(const M& mask) { return !any(mask); }

/// `if (when(mask)) { ... }`: a block that changes nothing in lanes outside of the mask, left out
/// where it has none. In a shader a branch.
template <class M>
requires requires(M mask) { any(mask); }
bool when(const M& mask) { return any(mask); }

}  // namespace quadrel
