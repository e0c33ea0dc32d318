// What rays through the volume of an impostor share: which part of them is in the cube of (u, v,
// s), and up to three maps of four depths.
#pragma once

#include "quadrel/relief/impostor.hpp"
#include "quadrel/relief/trace/layer/layers.hpp"

namespace quadrel {

inline constexpr auto impostor_maps =
    slots(TextureSlot::layers, TextureSlot::layers_2, TextureSlot::layers_3);

/// Depths of up to three maps of four.
template <class Io>
class ImpostorLayers {
  public:
    using F = typename Io::Number;

    /// `io` must outlive this object.
    explicit ImpostorLayers(const Io& io) : io_(io) {}

    /// Whether (u, v, s) is inside of a solid, and which depth is next to s.
    struct Sample {
        Mask<F> inside, met_nan;
        F depth;
    };
    Sample operator()(Mask<F> active, const vec3<F>& at) const {
        const vec2<F> uv(at.x, at.y);
        Sample sample{Mask<F>(false), Mask<F>(false), F(4)};
        look<TextureSlot::layers>(active, uv, at.z, sample);
        look<TextureSlot::layers_2>(active, uv, at.z, sample);
        look<TextureSlot::layers_3>(active, uv, at.z, sample);
        io_.march_step(active, at.z, uv, F(1) - at.z, F(1) - sample.depth);
        return sample;
    }
    int maps() const {
        return 1 + (io_.template texture<TextureSlot::layers_2>() != nullptr ? 1 : 0) +
               (io_.template texture<TextureSlot::layers_3>() != nullptr ? 1 : 0);
    }

  private:
    template <TextureSlot slot>
    void look(Mask<F> active, const vec2<F>& uv, F s, Sample& sample) const {
        const SampledTexture* const map = io_.template texture<slot>();
        if (map == nullptr) return;
        const auto context = io_.template context<slot>(active);
        const vec4<F> depths = layer_depths(*map, texture_lod(*map, context, uv, F(0)));
        const Mask<F> inside = is_inside<4>(depths, s);
        sample.inside = (sample.inside & !inside) | (inside & !sample.inside);
        sample.met_nan = sample.met_nan | has_nan<4>(depths);
        const F next = nearest_layer<4>(depths, s);
        sample.depth = select(abs(next - s) < abs(sample.depth - s), next, sample.depth);
    }

    const Io& io_;
};

/// The part of a ray, in world units from its start, that is in the cube of (u, v, s).
template <Number F>
struct RayPart {
    F from, to;

    RayPart(F first, F last) : from(first), to(last) {}
    /// Leaves what is in [0, 1] of a coordinate that is `at` at the start and changes by `rate`.
    void clip(F at, F rate) {
        const F never(std::numeric_limits<Scalar<F>>::infinity());
        const Mask<F> along = rate == F(0), outside = (at < F(0)) | (at > F(1));
        const F low = -at / rate, high = (F(1) - at) / rate;
        from = max(from, select(along, select(outside, never, -never), min(low, high)));
        to = min(to, select(along, select(outside, -never, never), max(low, high)));
    }
};

inline constexpr auto impostor_ray_inputs =
    values_and(impostor_inputs, Value::frame_status, Value::frame_flags);

/// A view ray from the card on, its parameter in world units: what of it is in the cube, in front
/// of the eye.
template <Number F>
struct ImpostorRay {
    ImpostorVolume<F> volume;
    vec3<F> to_viewer;   ///< unit
    vec3<F> card, rate;  ///< (u, v, s) on the card, and how they change a world unit
    RayPart<F> part{F(0), F(0)};
    Mask<F> framed, active;  ///< `active`: there is a part to be searched
    Int<F> frame_status;

    vec3<F> place(F t) const { return card + rate * t; }
};

/// How far it is to the eye; infinite where a projection is parallel.
template <Number F>
F distance_to_eye(const vec3<F>& P, const auto& frame) {
    if (frame.orthographic) return F(std::numeric_limits<Scalar<F>>::infinity());
    return length_at_any_scale(uniform3<F>(frame.eye) - P);
}

template <class Io, class F = typename Io::Number>
ImpostorRay<F> impostor_ray(const Io& io) {
    ImpostorRay<F> ray;
    ray.volume = impostor_volume(io);
    ray.frame_status = io.template load<Value::frame_status>();
    ray.framed = ray.frame_status == status_packet<F>(Status::hit);
    const vec3<F> P = io.template load<Value::P>();
    ray.to_viewer = to_viewer(P, io.frame());
    ray.card = ray.volume.point();
    ray.rate = ray.volume.along(-ray.to_viewer);
    ray.part =
        RayPart<F>(-distance_to_eye(P, io.frame()), F(std::numeric_limits<Scalar<F>>::infinity()));
    for (int axis = 0; axis < 3; ++axis) ray.part.clip(ray.card[axis], ray.rate[axis]);
    ray.active =
        io.active() & ray.framed & (ray.volume.grad_s > F(0)) & (ray.part.from < ray.part.to);
    return ray;
}

/// Where a search of an impostor has ended.
template <Number F>
struct ImpostorHit {
    F t;  ///< on the ray; on the card where it is a miss
    F h;
    Mask<F> found, met_nan;
    Int<F> points;
};

/// A ray that meets nothing is a miss. `maps` are looked up at every point.
template <class Io, class F = typename Io::Number>
void store_impostor(const Io& io, const ImpostorRay<F>& ray, const ImpostorHit<F>& hit, int maps) {
    // The depth may change without bound along the ray of a miss.
    const vec3<F> place = select(hit.found, ray.place(hit.t), ray.card);
    const vec2<F> uv(place.x, place.y);
    const Int<F> status = search_status<F>(hit.found, hit.met_nan, Status::clip);
    io.template store<Value::hit_uv>(uv);
    io.template store<Value::hit_s>(clamp(place.z, F(0), F(1)));
    io.template store<Value::hit_h>(hit.h);
    io.template store<Value::hit_depth>(hit.t);
    io.template store<Value::hit_status>(select(ray.framed, status, ray.frame_status));
    io.template store<Value::hit_flags>(io.template load<Value::frame_flags>() |
                                        nan_look_up_flag(uv));
    io.template store<Value::hit_steps>(hit.points);
    io.template store<Value::hit_fetches>(hit.points * Int<F>(maps));
}

}  // namespace quadrel
