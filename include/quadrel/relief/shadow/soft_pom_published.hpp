// shadow-soft-pom@published: the soft self-shadow of the DirectX SDK's parallax occlusion mapping.
//
// Source: N. Tatarchuk, "Practical Parallax Occlusion Mapping", 2006; DirectX SDK (2006 to 2010),
// ParallaxOcclusionMapping.fx: seven samples towards the light at fixed fractions of an offset that
// is L.xy times the height scale, each excess of height weighted by how near the occluder is. The
// light vector is that of the vertices, interpolated and normalised; the height scale, a length in
// UV, is the number of the material's depth, given as {"thickness", "tile"}. Kept:
//   * vLightTS = mul(vLightWS, mWorldToTangent): the vector stands on the wrong side of the matrix,
//     which turns tangent space into the world's, not the world's into tangent space;
//   * the offset is not divided by L.z; a light behind the surface shades as any other;
//   * nothing is clamped, so that where every sample is lower than the ray the light is more than
//     full before it is mapped to 0.4 to 1.
// The sample's light has a direction alone; a light at a point is seen from the vertices. Without a
// frame or depth every light arrives.
// Not reproduced: the sample shadows nothing beyond its mip level threshold, and starts from the
// coordinate before that level's fading.
#pragma once

#include "quadrel/quad/vertex_program.hpp"
#include "quadrel/relief/shadow/light_ray.hpp"

namespace quadrel {

/// Fractions of the offset, and the weights of what is found there.
inline constexpr float soft_pom_at[7] = {0.88f, 0.77f, 0.66f, 0.55f, 0.44f, 0.33f, 0.22f};
inline constexpr float soft_pom_weight[7] = {1, 2, 4, 6, 8, 10, 12};

/// The largest weighted excess of height over a ray that rises by 1 over `offset`.
template <class Io, class Heights, class F = typename Io::Number>
F soft_pom_excess(const Io& io, const Heights& height, Mask<F> active, const vec2<F>& uv,
                  const vec2<F>& offset, F softening) {
    const F start = height(active, uv);
    F most(0);
    for (int k = 0; k < 7; ++k) {
        const F at(soft_pom_at[k]);
        const vec2<F> there = uv + offset * at;
        const F h = height(active, there);
        io.march_step(active, F(1) - (start + at), there, start + at, h);
        const F excess = (h - start - at) * F(soft_pom_weight[k]) * softening;
        most = k == 0 ? excess : max(most, excess);
    }
    return most;
}

struct ShadowSoftPomPublished : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shadow-soft-pom@published", "shadow",
                                    "seven samples towards the light, softened, as listed",
                                    "Tatarchuk 2006; DirectX SDK, ParallaxOcclusionMapping.fx"};
    static constexpr const char* not_reproduced =
        "no shadow beyond the mip level threshold; the start before that level's fading";
    static constexpr auto inputs =
        values(Value::relief_depth, Value::frame_status, Value::hit_uv, Value::dUVdx, Value::dUVdy);
    static constexpr auto outputs = shadow_outputs;
    static constexpr auto textures = slots(TextureSlot::height);
    static constexpr bool reads_vertices = true;
    struct Params {
        float softening = 0.58f;
    };
    static constexpr std::array parameters{parameter<&Params::softening>(
        "softening", "1", "factor of every sample's excess", 0, 10, 0.58)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const Mask<F> active =
            io.active() & (io.template load<Value::relief_depth>() != F(0)) &
            (io.template load<Value::frame_status>() == status_packet<F>(Status::hit));
        const vec3<F> vLightTS = normalize(light_vector(io));
        const vec2<F> vLightRayTS = vec2<F>(vLightTS.x, vLightTS.y) * F(io.material().depth);
        const auto height = march_heights(io);
        const F most = soft_pom_excess(io, height, active, io.template load<Value::hit_uv>(),
                                       vLightRayTS, F(params.softening));
        const F visibility = (F(1) - most) * F(0.6f) + F(0.4f);
        io.template store<Value::shadow_visibility>(select(active, visibility, F(1)), io.light());
        io.template store<Value::shadow_steps>(select(active, Int<F>(8), Int<F>(0)), io.light());
    }

  private:
    /// Out.vLightTS of RenderSceneVS, interpolated.
    template <class Io, class F = typename Io::Number>
    static vec3<F> light_vector(const Io& io) {
        const auto& light = io.frame().lights[io.light()];
        const VertexProgram program(io);
        const auto to_world = [&](const vec3<F>& v) {
            const auto& rows = io.frame().eye_to_world;
            const auto row = [&](int i) {
                return dot(vec3<F>(F(rows[i]), F(rows[i + 1]), F(rows[i + 2])), v);
            };
            return vec3<F>(row(0), row(3), row(6));
        };
        const auto axis = [&](const vec3<F>& v) {
            return normalize(to_world(program.vector_to_eye(v)));
        };
        return program.varying([&](const Vertex<F>& v) {
            const vec3<F> position = uniform3<F>(light.position);
            const vec3<F> vLightWS = to_world(
                light.directional ? position : position - program.point_to_eye(v.position));
            // mul( vLightWS, mWorldToTangent ), whose rows are tangent, binormal and normal.
            return axis(v.tangent) * vLightWS.x + axis(v.binormal) * vLightWS.y +
                   axis(v.normal) * vLightWS.z;
        });
    }
};

}  // namespace quadrel
