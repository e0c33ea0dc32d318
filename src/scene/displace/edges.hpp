// The edges of the mesh that is displaced, and where the lattice cuts them: once for all triangles
// at an edge, so that these meet in the same vertices.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "scene/displace/lattice.hpp"

namespace quadrel::displacement {

/// Strictly between the ends of an edge, where it meets a border or a diagonal of a cell.
struct Cut {
    Fraction at;
    double height;
};

/// From the end with the smaller position to the other, whichever triangle looks at it.
struct Edge {
    std::uint32_t from, to;  ///< vertices of the mesh
    std::uint32_t first_cut = 0, cuts = 0;
};

/// A side of a triangle.
struct Side {
    std::uint32_t edge = 0;
    bool reversed = false;  ///< the triangle goes from the edge's `to` to its `from`
};

class Edges {
  public:
    /// `places`: of the mesh's vertices.
    Edges(const Mesh& mesh, const std::vector<Place>& places, const Lattice& lattice);

    const std::vector<Edge>& all() const { return edges_; }
    /// Of all edges, one edge after the other, by growing `at`.
    const std::vector<Cut>& cuts() const { return cuts_; }
    /// Side k of triangle t goes from corner k to corner k + 1.
    const Side& side(std::size_t t, std::size_t k) const { return sides_[t][k]; }

    /// The cut of a side at a part of it, as the triangle goes; none at its ends.
    std::uint32_t find(const Side& side, const Fraction& at) const;

  private:
    std::vector<Edge> edges_;
    std::vector<Cut> cuts_;
    std::vector<std::array<Side, 3>> sides_;
};

/// Whether vertex a comes before b in the order by which edges are directed.
bool comes_before(const Mesh& mesh, std::uint32_t a, std::uint32_t b);

}  // namespace quadrel::displacement
