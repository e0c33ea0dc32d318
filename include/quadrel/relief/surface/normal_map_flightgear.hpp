// normal-map-flightgear@published: FlightGear's normal mapping, as listed.
//
// Source: T. Renk, FlightGear wiki, "Howto: Shader programming in FlightGear", normal mapping
// (2016). Its vertex shader takes normal, tangent and binormal to eye space by the normal matrix
// and normalises each; the fragment shader adds them up as interpolated, not normalised again:
//     N = normalize(n.x eyeTangent + n.y eyeBinormal + n.z eyeNormal),  n = 2 texel - 1.
// Kept:
//   * gl_NormalMatrix is the inverse transpose, right for normals; under a scale that is not
//     uniform tangents turn away from the surface by it;
//   * between vertices the three shorten by as much as they diverge, each by its own;
//   * texture2D takes the implicit derivatives of its coordinate: here that of the hit, which is
//     the listing's gl_TexCoord[0] where the trace does not displace it;
//   * back faces keep the normal of the front.
// Tangent and binormal are the mesh's, along growing u and v (vertex_program.hpp). Without a map:
// the sum of the third alone, normalised.
#pragma once

#include "quadrel/relief/vertex_frame.hpp"
#include "quadrel/texture/sampler.hpp"

namespace quadrel {

struct NormalMapFlightGear : NormalFromMap {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"normal-map-flightgear@published", "surface",
                                    "normal map over interpolated unit axes of the vertices",
                                    "Renk, FlightGear wiki, normal mapping, 2016"};
    static constexpr auto inputs = values(Value::hit_uv);
    static constexpr bool reads_vertices = true;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const VertexProgram program(io);
        const auto varying = [&](vec3<F> Vertex<F>::*attribute) {
            return program.varying([&](const Vertex<F>& vertex) {
                return normalize(program.normal_to_eye(vertex.*attribute));
            });
        };
        const vec3<F> eyeNormal = varying(&Vertex<F>::normal);
        const SampledTexture* map = io.template texture<TextureSlot::normal>();
        if (!map) return io.template store<Value::N>(normalize(eyeNormal));
        const vec3<F> eyeTangent = varying(&Vertex<F>::tangent);
        const vec3<F> eyeBinormal = varying(&Vertex<F>::binormal);
        const vec4<F> texel = texture(*map, io.template context<TextureSlot::normal>(),
                                      io.template load<Value::hit_uv>(), io.frame().derivatives);
        const vec3<F> N = vec3<F>(texel.x, texel.y, texel.z) * F(2) - vec3<F>(F(1));
        io.template store<Value::N>(
            normalize(eyeTangent * N.x + eyeBinormal * N.y + eyeNormal * N.z));
    }
};

}  // namespace quadrel
