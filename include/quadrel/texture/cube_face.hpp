// Directions and cube faces, and which texel lies beyond a face's edge. Source: Vulkan
// specification, "Cube Map Face Selection", "Cube Map Coordinate Transformation", "Cube Map
// Derivative Transformation" and "Cube Map Edge Handling".
#pragma once

#include "quadrel/num/functions.hpp"

namespace quadrel {

/// Where a direction meets the cube. Faces count +X -X +Y -Y +Z -Z.
template <Number F>
struct CubePoint {
    Int<F> face;
    F s_major, t_major, major;  ///< s and t components and the (signed) major one of the direction
    vec2<F> st;                 ///< in [0, 1]
};

/// The components of `v` that play s, t and major axis on each lane's face.
template <Number F>
vec3<F> face_components(Int<F> face, const vec3<F>& v) {
    const Mask<F> on_x = face < Int<F>(2), on_y = (face < Int<F>(4)) & !on_x;
    const Mask<F> negative = (face & Int<F>(1)) != Int<F>(0);
    const F s =
        select(on_x, select(negative, v.z, -v.z), select(on_y, v.x, select(negative, -v.x, v.x)));
    const F t = select(on_y, select(negative, -v.z, v.z), -v.y);
    return {s, t, select(on_x, v.x, select(on_y, v.y, v.z))};
}

/// The face of the largest component; Z wins over Y over X.
template <Number F>
Int<F> select_face(const vec3<F>& direction) {
    const F x = abs(direction.x), y = abs(direction.y), z = abs(direction.z);
    const Mask<F> on_z = (z >= x) & (z >= y), on_y = (!on_z) & (y >= x);
    const Int<F> zero(0), one(1);
    const Int<F> face_x = select(direction.x < F(0), one, zero);
    const Int<F> face_y = select(direction.y < F(0), Int<F>(3), Int<F>(2));
    const Int<F> face_z = select(direction.z < F(0), Int<F>(5), Int<F>(4));
    return select(on_z, face_z, select(on_y, face_y, face_x));
}

/// A null or NaN direction gives NaN coordinates, which address texel 0.
template <Number F>
CubePoint<F> project_to_cube(const vec3<F>& direction) {
    const Int<F> face = select_face(direction);
    const vec3<F> c = face_components<F>(face, direction);
    const F size = abs(c.z);
    const F half(0.5f);
    return {face, c.x, c.y, c.z, {half * c.x / size + half, half * c.y / size + half}};
}

/// Derivative of the face coordinates along a derivative of the direction:
/// 0.5 * (|r| ds - s d|r|) / r^2.
template <Number F>
vec2<F> cube_derivative(const CubePoint<F>& at, const vec3<F>& direction_derivative) {
    const vec3<F> d = face_components<F>(at.face, direction_derivative);
    const F size = abs(at.major);
    const F d_size = select(at.major < F(0), -d.z, d.z);
    const F half(0.5f), square = size * size;
    return {half * (size * d.x - at.s_major * d_size) / square,
            half * (size * d.y - at.t_major * d_size) / square};
}

/// Beyond edge e (left, right, top, bottom) of a face of N texels, at position k along the edge:
/// texel (x_step * k + x_end * (N - 1), y_step * k + y_end * (N - 1)) of `face`.
struct CubeEdge {
    std::int32_t face, x_step, x_end, y_step, y_end;
};

inline constexpr CubeEdge cube_edges[6][4] = {
    {{4, 0, 1, 1, 0}, {5, 0, 0, 1, 0}, {2, 0, 1, -1, 1}, {3, 0, 1, 1, 0}},   // +X
    {{5, 0, 1, 1, 0}, {4, 0, 0, 1, 0}, {2, 0, 0, 1, 0}, {3, 0, 0, -1, 1}},   // -X
    {{1, 1, 0, 0, 0}, {0, -1, 1, 0, 0}, {5, -1, 1, 0, 0}, {4, 1, 0, 0, 0}},  // +Y
    {{1, -1, 1, 0, 1}, {0, 1, 0, 0, 1}, {4, 1, 0, 0, 1}, {5, -1, 1, 0, 1}},  // -Y
    {{1, 0, 1, 1, 0}, {0, 0, 0, 1, 0}, {2, 1, 0, 0, 1}, {3, 1, 0, 0, 0}},    // +Z
    {{0, 0, 1, 1, 0}, {1, 0, 0, 1, 0}, {2, -1, 1, 0, 0}, {3, -1, 1, 0, 1}},  // -Z
};

/// A texel of a cube map level.
template <Number F>
struct CubeTexel {
    Int<F> face, x, y;
};

/// Moves a texel that is outside of its face by one in x or in y (not both) to where it is on the
/// neighbour face; texels inside stay.
template <Number F>
CubeTexel<F> cross_edge(const CubeTexel<F>& texel, Int<F> size) {
    const Int<F> zero(0), last = size - Int<F>(1);
    const Mask<F> left = texel.x<zero, right = texel.x> last;
    const Mask<F> top = texel.y<zero, bottom = texel.y> last;
    const Int<F> edge =
        select(left, zero, select(right, Int<F>(1), select(top, Int<F>(2), Int<F>(3))));
    const Int<F> k = select(left | right, texel.y, texel.x);
    const std::int32_t* table = &cube_edges[0][0].face;
    const Int<F> row = (texel.face * Int<F>(4) + edge) * Int<F>(5);
    const auto entry = [&](int field) { return gather_int<F>(table + field, row); };
    const Mask<F> outside = left | right | top | bottom;
    return {select(outside, entry(0), texel.face),
            select(outside, entry(1) * k + entry(2) * last, texel.x),
            select(outside, entry(3) * k + entry(4) * last, texel.y)};
}

}  // namespace quadrel
