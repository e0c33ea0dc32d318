// parallax-bias@published and offset-limit@published: Welsh's two fragment programs.
//
// Source: T. Welsh, "Parallax Mapping with Offset Limiting: A Per-Pixel Approximation of Uneven
// Surfaces", revision 0.3, 2004, sections 4.2 and 4.3.
//   * Scale and bias are UV lengths (0.04 and -0.02 in the listings); the relief's depth and seat
//     move hit.depth alone.
//   * The eye vector is that of his vertex program (vertex_frame.hpp), interpolated and then
//     normalised a fragment; the frame gives no vector, only whether there is one (its NOFRAME).
//   * MAD is a product and a sum, RCP and RSQ are 1 / x and 1 / sqrt(x).
//   * 4.1 divides by the vector's z, 4.3 does not: its shift is never longer than the scaled and
//     biased height.
// Others that leave the division out: McGuire and McGuire 2005 describe it; FlightGear has neither
// scale nor bias and the height in texture coordinates; Rabbid76's takes another vector, so that
// its shift is longer or shorter (offset-limit-rabbid@published).
#pragma once

#include "quadrel/relief/trace/offset/offset.hpp"
#include "quadrel/relief/vertex_frame.hpp"

namespace quadrel {

struct WelshParams {
    float scale = 0.04f, bias = -0.02f;
};

template <bool limited>
struct WelshOffset : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text =
        limited ? StageText{"offset-limit@published", "trace",
                            "Welsh's limited offset, not divided by the view vector's z",
                            "Welsh 2004, 4.3"}
                : StageText{"parallax-bias@published", "trace",
                            "Welsh's parallax mapping with scale and bias", "Welsh 2004, 4.2"};
    static constexpr auto inputs = search_inputs;
    static constexpr bool reads_vertices = true;
    using Params = WelshParams;
    static constexpr std::array parameters{
        parameter<&Params::scale>("scale", "UV", "UV length of the height range", 0, 16, 0.04),
        parameter<&Params::bias>("bias", "UV", "added to the scaled height", -16, 16, -0.02)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const vec3<F> eye = vertex_eye(io);
        const vec3<F> eyevecs = eye * inversesqrt(dot(eye, eye));
        const F texel = implicit_height_at_start(io, ray);
        F height = texel * F(params.scale) + F(params.bias);
        if constexpr (!limited) height = height * (F(1) / eyevecs.z);
        const vec2<F> newtexcoord = vec2<F>(eyevecs) * height + ray.uv;
        store_search(io, ray, offset_result(ray, texel), newtexcoord);
    }
};

using ParallaxBiasPublished = WelshOffset<false>;
using OffsetLimitPublished = WelshOffset<true>;

}  // namespace quadrel
