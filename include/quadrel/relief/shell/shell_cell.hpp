// The tetrahedra of a shell with their neighbours, for rays that go on from one to the next.
//
// They lie behind the faces that are drawn, in the same array of rows, of an object whose shadows
// walk through its shell (shadow-shell*).
#pragma once

#include "quadrel/relief/shell/shell_face.hpp"

namespace quadrel {

/// A tetrahedron, in the place of the PrimitiveVertices of a triangle of the mesh. Eye space and
/// world units.
struct ShellCell {
    /// What lies behind a face.
    static constexpr std::int32_t outside = 0;  ///< the shell's top, or an open border
    static constexpr std::int32_t below = 1;    ///< the shell's bottom
    static constexpr std::int32_t first_link = 4;
    /// A tetrahedron by its row, met by the face opposite of its corner `back`.
    static constexpr std::int32_t link_to(std::int32_t row, std::int32_t back) {
        return first_link + 4 * row + back;
    }

    float origin[3];       ///< of the corner 0
    float gradient[4][3];  ///< of the barycentric coordinates of the corners
    float uv[4][2];        ///< at the corners
    float s[4];            ///< depth below the shell's top there
    float unused[48];
    std::int32_t link[4];  ///< what lies behind the face opposite of each corner
    float unused_too;
};
static_assert(sizeof(ShellCell) == sizeof(PrimitiveVertices), "rows of one array");
// Rows of triangles, taken for tetrahedra, lead nowhere.
static_assert(offsetof(ShellCell, link) >= offsetof(PrimitiveVertices, unused));
static_assert(offsetof(ShellFace, cell) >= offsetof(PrimitiveVertices, unused));

/// One tetrahedron a lane.
template <Number F>
class ShellCells {
  public:
    template <class Io>
    explicit ShellCells(const Io& io)
        : floats_(reinterpret_cast<const float*>(io.call().vertices)),
          integers_(reinterpret_cast<const std::int32_t*>(io.call().vertices)) {
        static_assert(Io::reads_vertices, "the stage does not declare reads_vertices");
        row_ = load_int<F>(io.call().primitive + io.first_lane()) * Int<F>(floats_a_row);
        // Lanes beyond the last quad have the row of some triangle, of whatever material.
        const Int<F> cell = integer(offsetof(ShellFace, cell), 0), zero(0);
        row_ = select(io.active() & (cell >= zero), cell, zero) * Int<F>(floats_a_row);
    }

    /// On to what a link leads to, which is a tetrahedron where `mask`; returns its corner `back`.
    Int<F> follow(Mask<F> mask, Int<F> link) {
        const Int<F> place = select(mask, link - Int<F>(ShellCell::first_link), Int<F>(0));
        const Int<F> row = shift_right<2>(place);
        row_ = select(mask, row * Int<F>(floats_a_row), row_);
        return place - row * Int<F>(4);
    }

    vec3<F> origin() const { return vector(offsetof(ShellCell, origin), 0); }
    vec3<F> gradient(int corner) const { return vector(offsetof(ShellCell, gradient), 3 * corner); }
    vec2<F> uv(int corner) const {
        return {number(offsetof(ShellCell, uv), 2 * corner),
                number(offsetof(ShellCell, uv), 2 * corner + 1)};
    }
    F s(int corner) const { return number(offsetof(ShellCell, s), corner); }
    Int<F> link(int corner) const { return integer(offsetof(ShellCell, link), corner); }

  private:
    static constexpr std::int32_t floats_a_row = sizeof(ShellCell) / sizeof(float);

    static Int<F> place(std::size_t bytes, int offset) {
        return Int<F>(static_cast<std::int32_t>(bytes / sizeof(float)) + offset);
    }
    F number(std::size_t bytes, int offset) const {
        return gather<F>(floats_, row_ + place(bytes, offset));
    }
    Int<F> integer(std::size_t bytes, int offset) const {
        return gather_int<F>(integers_, row_ + place(bytes, offset));
    }
    vec3<F> vector(std::size_t bytes, int offset) const {
        return {number(bytes, offset), number(bytes, offset + 1), number(bytes, offset + 2)};
    }

    const float* floats_;
    const std::int32_t* integers_;
    Int<F> row_;
};

}  // namespace quadrel
