// prism-gs@published: generalized displacement in prisms that a geometry shader makes, as listed.
//
// Source: prism_strip.hpp, main and Parallax of displacement_map.frag. Kept, with its numbers:
//   * fragments of the base, of either side, are searched from height 1 to 0 along the ray through
//     them, whether or not it is within the prism there; from behind, heights are turned round and
//     the ray runs from its far end;
//   * fragments of a side that faces the eye are searched ahead, of one that faces away back
//     towards the eye, each over as much height as there is: 1.05 times that, upwards. A flat ray's
//     shift is cut off by max(|z|, 0.5 length(xy)), and with it the ray's direction;
//   * a side's fragment is discarded where the search ended above 1.000001 or below 0, or on the
//     wrong side of it; and where a ray rises through a side that faces away. Nothing ends a ray at
//     the prism's other sides: neighbours draw over each other, and the depth test chooses;
//   * the number of steps is int() of 50 times a quality of the angle, that of halvings of 10
//     times; the last height is moved by at most one of the last steps;
//   * look-ups take implicit derivatives, in the loops too: lanes that left keep their coordinate.
// Texture space is as wrong as frame-prism@published says: bumps are too long or too short but on
// triangles that are half of the texture. displace-prism@published is where a hit lies, since that
// is not on the view ray where its direction was cut off. The application's clipping plane
// (DEBUG_CLIP), which cuts the model open, is not part of the row.
#pragma once

#include "quadrel/relief/shell/frame_prism_published.hpp"
#include "quadrel/relief/trace/search/implicit_height.hpp"

namespace quadrel {

struct PrismGsPublished : StageDefaults {
    static constexpr StageText text{"prism-gs@published", "trace",
                                    "linear and binary search in prisms, as listed",
                                    "Rabbid76, graphics-snippets, parallax_010"};
    static constexpr auto inputs =
        values_and(prism_strip_inputs, Value::frame_status, Value::frame_flags);
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::height);
    static constexpr bool may_miss = true;
    static constexpr bool reads_vertices = true;
    static constexpr const char* not_reproduced =
        "the application's clipping plane (DEBUG_CLIP); the normal, which is a surface's, and on "
        "back "
        "faces, where the listing turns relief and normal round, that of the relief as it is";

    /// u_parallax_quality.
    struct Params {
        float quality_normal = 0.5f, quality_grazing = 1;
    };
    static constexpr std::array parameters{
        parameter<&Params::quality_normal>("quality_normal", "1", "quality seen from above", 0, 2,
                                           0.5),
        parameter<&Params::quality_grazing>("quality_grazing", "1", "quality along the surface", 0,
                                            2, 1)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const PrismStripVaryings<F> in(io);
        const F zero(0), one(1);
        const Mask<F> is_silhouette = is_prism_silhouette(in.texCoords);
        const Mask<F> silhouette_front = in.d_z > zero;
        const Mask<F> is_up_isect = is_silhouette & (in.tbnDir.z > zero);
        const F base_height = in.texCoords.z;
        const F delta_height0 = select(is_up_isect, F(1.05f) * (one - base_height), base_height);
        const F delta_height1 = select(is_up_isect, zero, base_height - one);
        const vec3<F> tbnStep = prism_strip_step(in.tbnDir, is_silhouette), null(zero);
        const vec3<F> tbnP0 =
            select(is_silhouette & !silhouette_front, null, tbnStep * delta_height0);
        const vec3<F> tbnP1 =
            select(is_silhouette & silhouette_front, null, tbnStep * delta_height1);
        Parallax<Io> found(io, in, params, tbnP0, tbnP1, tbnStep);
        found.march();
        found.refine();
        const vec3<F> at = found.result();

        const vec3<F> tex_offst = at - in.texCoords;
        const Mask<F> clipped = (at.z > F(1.000001f)) | (at.z < zero) |
                                (dot(tex_offst, in.tbnDir) * in.d_z < zero) |
                                (is_up_isect & !silhouette_front);
        store(io, in, found, at, in.displ_vec(tex_offst), is_silhouette & clipped);
    }

  private:
    template <class Io>
    struct Parallax {
        using F = typename Io::Number;

        const Io& io;
        vec3<F> texCoord, texC0, texC1;
        F frontFace, back_face, numSteps, numBinarySteps, bumpHeightStep, bestBumpHeight;
        F mapHeight = F(1);
        vec2<F> look_up;
        Mask<F> active, displaces, met = Mask<F>(false), met_nan = Mask<F>(false);
        Int<F> fetches = Int<F>(0);

        Parallax(const Io& stage, const PrismStripVaryings<F>& in, const Params& params,
                 const vec3<F>& tbnP0, const vec3<F>& tbnP1, const vec3<F>& tbnStep)
            : io(stage), texCoord(in.texCoords), frontFace(in.frontFace) {
            back_face = step(F(0), -frontFace);
            const vec3<F> shift = vec3<F>(tbnStep.x, tbnStep.y, F(0)) * back_face;
            texC0 = texCoord + tbnP0 + shift;
            texC1 = texCoord + tbnP1 + shift;
            const F quality = mix(F(params.quality_normal), F(params.quality_grazing),
                                  F(1) - abs(normalize(tbnStep).z));
            numSteps = clamp(quality * F(50), F(1), F(50));
            numBinarySteps = trunc(clamp(quality * F(10), F(1), F(10)));
            bumpHeightStep = (texC0.z - texC1.z) / (numSteps - F(1));
            bestBumpHeight = texC1.z;
            look_up = vec2<F>(texCoord.x, texCoord.y);
            displaces = Mask<F>(rabbid_displaces(io.material()));
            active = io.active() & displaces;
        }

        vec2<F> at(F height) const {
            const vec2<F> from(texC0.x, texC0.y), to(texC1.x, texC1.y);
            return mix(from, to, (height - texC0.z) / (texC1.z - texC0.z));
        }
        void fetch(Mask<F> mask) {
            look_up = select(mask, at(bestBumpHeight), look_up);
            const F h = implicit_height(io, mask, look_up);
            met_nan = met_nan | (mask & is_nan(h));
            mapHeight = select(mask, back_face + frontFace * clamp(h, F(0), F(1)), mapHeight);
            io.march_step(mask, F(1) - bestBumpHeight, look_up, bestBumpHeight, mapHeight);
            count_in<F>(fetches, mask);
        }
        void march() {
            Mask<F> marches = active;
            for (const auto i : steps<F>(0, 49)) {
                marches = marches & (number<F>(i) < trunc(numSteps));
                if (none(marches)) break;
                fetch(marches);
                const Mask<F> met_here = marches & (mapHeight >= bestBumpHeight);
                met = met | met_here;
                marches = marches & !met_here & !(bestBumpHeight > F(1));
                bestBumpHeight = select(marches, bestBumpHeight + bumpHeightStep, bestBumpHeight);
            }
        }
        void refine() {
            const Mask<F> refined = active & ((texCoord.z < F(0.0001f)) | (bestBumpHeight >= F(0)));
            bestBumpHeight = select(refined, bestBumpHeight - bumpHeightStep, bestBumpHeight);
            for (const auto i : steps<F>(0, 9)) {
                const Mask<F> halves = refined & (number<F>(i) < numBinarySteps);
                if (none(halves)) break;
                bumpHeightStep = select(halves, bumpHeightStep * F(0.5f), bumpHeightStep);
                bestBumpHeight = select(halves, bestBumpHeight + bumpHeightStep, bestBumpHeight);
                fetch(halves);
                const F back = select(bestBumpHeight < mapHeight, bumpHeightStep, F(0));
                bestBumpHeight = select(halves, bestBumpHeight - back, bestBumpHeight);
            }
            const F part = clamp((bestBumpHeight - mapHeight) / abs(bumpHeightStep), F(0), F(1));
            bestBumpHeight =
                select(refined, bestBumpHeight + bumpHeightStep * part, bestBumpHeight);
        }
        vec3<F> result() const {
            const vec3<F> still(texCoord.x, texCoord.y, F(0));
            return select(displaces, vec3<F>(at(bestBumpHeight), bestBumpHeight), still);
        }
    };

    /// hit_h is the height that the search ended at, which the listing goes on with; hit_depth is
    /// measured along the view ray, where a hit need not lie.
    template <class Io, class F = typename Io::Number>
    static void store(const Io& io, const PrismStripVaryings<F>& in, const Parallax<Io>& found,
                      const vec3<F>& at, const vec3<F>& displ_vec, Mask<F> clipped) {
        const vec2<F> uv(at.x, at.y);
        const Int<F> searched = search_status<F>(found.met | !found.displaces, found.met_nan);
        const vec3<F> d = -to_viewer(in.objPosEs, io.frame());
        io.template store<Value::hit_uv>(uv);
        io.template store<Value::hit_s>(F(1) - at.z);
        io.template store<Value::hit_h>(at.z);
        io.template store<Value::hit_depth>(dot(displ_vec, d));
        io.template store<Value::hit_status>(
            select(clipped, status_packet<F>(Status::clip), searched));
        io.template store<Value::hit_flags>(io.template load<Value::frame_flags>() |
                                            nan_look_up_flag(uv));
        io.template store<Value::hit_steps>(found.fetches);
        io.template store<Value::hit_fetches>(found.fetches);
    }
};

}  // namespace quadrel
