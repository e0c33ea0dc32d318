// What one conforming implementation may be off by in a quad, as numbers that a search can turn:
// each a share of what the budget permits, in [-1, 1].
#pragma once

#include <array>
#include <cstddef>

#include "quadrel/num/derivative.hpp"

namespace quadrel {

/// Errors of an implementation's own. A varying is a component of what `interpolate` makes of the
/// vertices' values.
class PermittedErrors {
  public:
    static constexpr int varyings = 17, most_stages = 24, differences = 4;
    static constexpr int count = varyings * (4 + 3) + 3 * 2 + most_stages * 2 + differences * 4;

    /// ErrorBudget::evaluation, of a varying in a lane of the quad.
    float lane(int varying, int lane) const { return share_[index(7 * varying + lane)]; }
    /// ErrorBudget::plane, of its value at a vertex.
    float vertex(int varying, int vertex) const { return share_[index(7 * varying + 4 + vertex)]; }
    /// ErrorBudget::snapping, of a vertex along an axis of the window.
    float snapping(int vertex, int axis) const {
        return share_[index(7 * varyings + 2 * vertex + axis)];
    }
    /// ErrorBudget::address, of all coordinates that a stage of the plan looks maps up at.
    float address(std::size_t stage, int axis) const {
        const int of = static_cast<int>(stage) % most_stages;
        return share_[index(7 * varyings + 6 + 2 * of + axis)];
    }

    /// DerivativeFreedom::each: whether a lane takes a difference (of P in x, y, of uv in x, y)
    /// along the quad's other row or column.
    bool takes_other(int difference, int lane) const {
        return share_[index(7 * varyings + 6 + 2 * most_stages + 4 * difference + lane)] < 0;
    }
    /// DerivativeFreedom::quad: whether all lanes take all differences along the same row and
    /// column, and which these are.
    bool is_coarse() const { return takes_other(0, 0); }
    bool along_second(bool column) const { return takes_other(0, column ? 2 : 1); }

    std::array<float, count>& shares() { return share_; }
    const std::array<float, count>& shares() const { return share_; }

  private:
    static constexpr std::size_t index(int i) { return static_cast<std::size_t>(i); }

    std::array<float, count> share_{};
};

/// What implementations that run together have in common.
struct SharedChoices {
    /// The level of detail, from 0, the lowest that is permitted, to 1, the highest.
    double level = 0.5;
    /// ErrorBudget::filtered, of heights, a share of it.
    double filtered = 0;
    /// ErrorBudget::srgb, a share of it.
    double srgb = 0;
    DerivativeMode derivatives = DerivativeMode::fine;
};

}  // namespace quadrel
