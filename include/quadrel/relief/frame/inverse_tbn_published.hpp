// frame-inverse-tbn@published: the inverse of the scale-invariant cotangent frame, as published.
//
// Source: Rabbid76 (G. Beier), "Parallax Mapping", graphics-snippets, main() of the fragment
// shader: tbnMat = (T invmax, B invmax, N u_displacement_scale) with T and B as frame-cot@published
// has them, texDir3D = normalize(inverse(tbnMat) * objPosEs), and in the searches
//     texStep = texDir3D.xy / abs(texDir3D.z),
// which is K. u_displacement_scale is the material's depth, in units of one tile (published.hpp);
// a scale below 0.001 switches the relief off.
//
// T and B are gradients, and the inverse takes directions rightly only from a matrix of tangents.
// For square tiles the two agree; for anisotropic ones the anisotropy is inverted: with |grad v| =
// 4 |grad u| the shift is (0.4, 0.1) where (0.1, 0.4) is right. frame-inverse-tbn corrects that.
// The page's normal, tbnMat[2] times N component by component, is no frame's business.
#pragma once

#include "quadrel/relief/frame/published.hpp"
#include "quadrel/relief/frame/rabbid_direction.hpp"

namespace quadrel {

struct FrameInverseTbnPublished : DerivativeFrame {
    static constexpr StageText text{"frame-inverse-tbn@published", "frame",
                                    "inverse of the matrix of scaled gradients, as listed",
                                    "Rabbid76, graphics-snippets, Parallax Mapping"};

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const ViewedSurface<F> surface = viewed_surface(io);
        const RabbidDirection<F> ray = rabbid_direction(io);
        const vec3<F>& dir = ray.texDir3D;
        const vec2<F> step = vec2<F>(dir.x, dir.y) / abs(dir.z);

        const mat3<F> rows = transpose(ray.inverted);
        const Mask<F> on(rabbid_displaces(io.material())), yes(true);
        const vec3<F> depth_row = select(on, rows[2] * F(io.material().depth), ray.N);
        store_published_frame(io, ray.axes, surface.N,
                              SurfaceJacobian<F>{rows[0], rows[1], yes, !yes},
                              abs(dot(depth_row, surface.V)), select(on, step, vec2<F>(F(0))));
    }
};

}  // namespace quadrel
