// cone-rabbid: the cone stepping of Rabbid76's page, as listed; cone-rabbid-float: the same over a
// map of floats.
//
// Source: Rabbid76, "Parallax Mapping" (github.com/Rabbid76/graphics-snippets), function ConeStep
// over the map of its compute shader, which packs the height and the square root of the cone in 8
// bits (BakeKind::cone_rabbid). texDir3D is the unit view ray in texture space, (K, -1) normalised,
// (K, +1) seen from behind. t is a length along it. Kept:
//   * what is interpolated is the root, squared behind the look-up;
//   * at least one texel a step, 30 steps, no refinement: one-texel features are stepped over, and
//     a ray that has not arrived is returned where it is (status CAP);
//   * straight down, normalize(0, 0) and the division by R.x are not numbers;
//   * seen from behind, rays climb away from the surface;
//   * heights and roots are clamped to [0, 1], as the repository's GetHeightAndCone does;
//   * look-ups take implicit derivatives, and lanes that left keep their last coordinate; the map
//     has one level, so that these decide between its magnifying and minifying filter alone.
// The float row reads the kind `cone`, bilinearly, by the roots of its ratios: what differs is the
// 8 bits, and how the page's shader measures distances. The filters of cone-rabbid are those that
// the scene has for the height map: the page does not say which; the repository's examples read
// cone maps with nearest filtering, clamped to the edge. The listing returns the height of the
// undisplaced point; hit.h is that of the last sample. Its main, which leaves texture coordinates
// alone at scales below 0.001, is not part of the row.
#pragma once

#include "quadrel/relief/trace/cone/cone_map.hpp"
#include "quadrel/relief/trace/march/rabbid_march.hpp"

namespace quadrel {

template <bool packed>
struct RabbidConeStep : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{packed ? "cone-rabbid" : "cone-rabbid-float", "trace",
                                    packed
                                        ? "cone steps of a texel or more, 30, over a map of 8 bits"
                                        : "cone steps of a texel or more, 30, over a map of floats",
                                    "Rabbid76, graphics-snippets, Cone Step Mapping"};
    static constexpr TextureSlot slot = packed ? TextureSlot::cone_rabbid : TextureSlot::cone;
    static constexpr auto inputs = values_and(level_0_search_inputs, Value::P, Value::Ng);
    static constexpr auto outputs = trace_outputs;
    static constexpr const char* not_reproduced =
        "the listing's main, which leaves texture coordinates alone at scales below 0.001; "
        "the height that it returns; the coarser filter that implementations have for 8-bit "
        "textures";
    static constexpr auto textures = slots(slot);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const vec3<F> texDir3D = normalize(vec3<F>(ray.K, -front_face(io)));
        Variables<F> listing(ray, texDir3D, *io.template texture<slot>());
        for (const auto k : steps<F>(1, 30)) {
            listing.look_up(io, height_and_cone(io, listing.active, listing.move()));
            if (none(listing.active)) break;
            listing.advance();
        }
        SearchResult<F> result = listing.result;
        result.s = -texDir3D.z * listing.t;
        result.status = search_status<F>(listing.found, listing.met_nan, Status::cap);
        result.fetches = result.steps;
        store_search(io, ray, result, ray.uv + listing.direction * listing.t);
    }

  private:
    /// The height, not yet clamped, and the ratio of the cone: its interpolated root squared.
    template <class Io, class F>
    static Cone<F> height_and_cone(const Io& io, Mask<F> active, const vec2<F>& texCoords) {
        if constexpr (packed) {
            const vec4<F> texel =
                texture(*io.template texture<slot>(), io.template context<slot>(active), texCoords,
                        io.frame().derivatives);
            const F root = clamp(texel.y, F(0), F(1));
            return {texel.x, root * root};
        } else {
            const Texel<2, F> texel =
                BakedLookUp<slot, 2, Io, Interpolated::roots>(io)(active, texCoords);
            return {texel.channel[0], clamp(texel.channel[1], F(0), F(1))};
        }
    }

    /// The variables of the listing, named as there.
    template <Number F>
    struct Variables {
        vec2<F> texCoord, direction, R, P, at, C = vec2<F>(F(0));
        F texDir_z, min_step, t = F(0), h = F(0), c = F(0);
        Mask<F> active, found = Mask<F>(false), met_nan = Mask<F>(false);
        SearchResult<F> result{};

        Variables(const SearchRay<F>& ray, const vec3<F>& texDir3D, const SampledTexture& map)
            : texCoord(ray.uv),
              direction(texDir3D),
              R(normalize(vec2<F>(length(direction), texDir3D.z))),
              P(R / texDir3D.z),
              at(ray.uv),
              texDir_z(texDir3D.z),
              min_step(length(normalize(direction) / TexelSize<F>(map).texels) * F(1) / R.x),
              active(ray.active) {}

        /// The sample's coordinate; where a lane has left, its last.
        const vec2<F>& move() {
            at = select(active, texCoord + direction * t, at);
            return at;
        }

        template <class Io>
        void look_up(const Io& io, const Cone<F>& sample) {
            io.march_step(active, -texDir_z * t, at, F(1) + texDir_z * t, sample.height);
            count_in<F>(result.steps, active);
            met_nan = met_nan | (active & is_nan(sample.height));
            h = clamp(sample.height, F(0), F(1));
            c = sample.ratio;
            result.h = select(active, h, result.h);
            C = P + R * t;
            const Mask<F> hit = active & (C.y <= h);
            found = found | hit;
            active = active & !hit;
        }

        void advance() {
            const vec2<F> Q(C.x, h);
            const vec2<F> S = normalize(vec2<F>(c, F(1)));
            const vec2<F> across(S.y, -S.x);
            const F new_t = dot(Q - P, across) / dot(R, across);
            t = select(active, max(t + min_step, new_t), t);
        }
    };
};

using ConeRabbid = RabbidConeStep<true>;
using ConeRabbidFloat = RabbidConeStep<false>;

}  // namespace quadrel
