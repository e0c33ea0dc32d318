// The texels around a texel, by blocks: nearest to deciding first, and of blocks in which none can
// decide nothing but the bound.
#pragma once

#include "bake/search/plane_tree.hpp"

namespace quadrel {

/// The texels of a block from where a cone stands, inclusive.
struct Offsets {
    int u_low, u_high, v_low, v_high;

    /// Whole texels to the nearest along each axis.
    int gap_u() const { return std::max({u_low, -u_high, 0}); }
    int gap_v() const { return std::max({v_low, -v_high, 0}); }
};

/// A block that may decide.
struct Candidate {
    Block block;
    Offsets at;
    double bound;      ///< no texel of it gives a lower ratio
    unsigned sectors;  ///< bits: what its texels count for, at most
};

/// The texel that decided, by stored indices counted on beyond the grid.
struct Decider {
    int x, y;
    bool known;
};

/// One search around texel (i, j). A Visitor has
///     bool look(Candidate&, const float* greatest)   sets bound and sectors; false: cannot decide
///     bool matters(const Candidate&)                 asked again once others have been visited
///     bool is_fine(const Candidate&)                 true: its bound will do for all of its texels
///     void take(const Candidate&)                    a texel, or what is fine
template <class Visitor>
class BlockSearch {
  public:
    BlockSearch(const PlaneTree& tree, int i, int j, Visitor& visitor)
        : tree_(tree), i_(i), j_(j), visitor_(visitor) {}

    /// Tries one texel, by stored indices counted on beyond the grid.
    void try_texel(int x, int y) {
        Candidate candidate;
        if (look(tree_.texel(x, y), candidate)) visitor_.take(candidate);
    }

    void try_all() {
        visit([&](int k, Block& root) {
            root = tree_.root(k);
            return true;
        });
    }

  private:
    bool look(const Block& block, Candidate& candidate) {
        candidate.block = block;
        candidate.at = {block.u.low - i_, block.u.high - i_, block.v.low - j_, block.v.high - j_};
        return visitor_.look(candidate, tree_.greatest(block));
    }

    /// Four blocks, by their bounds.
    template <class Part>
    void visit(const Part& part) {
        Candidate sorted[4];
        int count = 0;
        for (int k = 0; k < 4; ++k) {
            Block block;
            Candidate candidate;
            if (!part(k, block) || !look(block, candidate)) continue;
            int at = count++;
            for (; at > 0 && sorted[at - 1].bound > candidate.bound; --at)
                sorted[at] = sorted[at - 1];
            sorted[at] = candidate;
        }
        for (int k = 0; k < count; ++k)
            if (visitor_.matters(sorted[k])) descend(sorted[k]);
    }

    void descend(const Candidate& candidate) {
        if (candidate.block.level == 0 || visitor_.is_fine(candidate))
            return visitor_.take(candidate);
        visit([&](int k, Block& block) { return tree_.quarter(candidate.block, k, block); });
    }

    const PlaneTree& tree_;
    int i_, j_;
    Visitor& visitor_;
};

}  // namespace quadrel
