// true-impostor: a march through up to six solids, twelve depths of three maps, along the view ray
// behind a card that faces the camera.
//
// Source: E. Risser, "True Impostors", 2006, and GPU Gems 3, 2007, chapter 21. Read of it were the
// abstract and the introduction of both, and the program on the book's disc: steps of one length
// from where the ray begins; a sample is outside where the product of its distances to the four
// depths of a texture is above 0, which is an even number of them passed; seven halvings of the
// last step. Of the chapter's text where the ray begins and ends was not read: here it is the part
// of it in the cube of the layers, in front of the eye. Differs: steps are indexed and as many for
// each ray; where front and back are equal there is nothing (a product of 0 is a collision there);
// what is inside is so of one map or another (parity over all of them); the halvings keep a
// bracket. Not there: refraction, reflection, distances through the volume, animation.
//
// Misses what is thinner along the ray than a step; at most 2^-binary_steps of a step late, never
// early. hit.depth is the way along the ray from the card, negative in front of it.
#pragma once

#include "quadrel/relief/impostor.hpp"
#include "quadrel/relief/trace/layer/march_layers.hpp"

namespace quadrel {

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

/// The part of a ray, in world units from the fragment, that is in the cube of (u, v, s).
template <Number F>
struct RayPart {
    F from, to;

    RayPart(F first, F last) : from(first), to(last) {}
    /// Leaves what is in [0, 1] of a coordinate that is `at` on the card and changes by `rate`.
    void clip(F at, F rate) {
        const F never(std::numeric_limits<Scalar<F>>::infinity());
        const Mask<F> along = rate == F(0), outside = (at < F(0)) | (at > F(1));
        const F low = -at / rate, high = (F(1) - at) / rate;
        from = max(from, select(along, select(outside, never, -never), min(low, high)));
        to = min(to, select(along, select(outside, -never, never), max(low, high)));
    }
};

struct TrueImpostor : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr bool may_miss = true;
    static constexpr StageText text{"true-impostor", "trace",
                                    "march through up to twelve depths behind a card",
                                    "Risser 2006, True Impostors; GPU Gems 3, chapter 21"};
    static constexpr auto inputs =
        values_and(impostor_inputs, Value::frame_status, Value::frame_flags);
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures =
        slots(TextureSlot::layers, TextureSlot::layers_2, TextureSlot::layers_3);
    struct Params {
        std::int32_t steps = 64, binary_steps = 7;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps over the ray's part in the cube", 1,
                                  most_steps, 64),
        parameter<&Params::binary_steps>("binary_steps", "1", "halvings of the last step", 0, 60,
                                         7)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const ImpostorLayers<Io> layers(io);
        const ImpostorVolume<F> volume = impostor_volume(io);
        const Int<F> frame_status = io.template load<Value::frame_status>();
        const Mask<F> framed = frame_status == status_packet<F>(Status::hit);
        const vec3<F> P = io.template load<Value::P>();
        const vec3<F> card = volume.point(), rate = volume.along(-to_viewer(P, io.frame()));
        RayPart<F> part(-to_eye(P, io.frame()), F(std::numeric_limits<Scalar<F>>::infinity()));
        for (int axis = 0; axis < 3; ++axis) part.clip(card[axis], rate[axis]);
        const Mask<F> searches =
            io.active() & framed & (volume.grad_s > F(0)) & (part.from < part.to);
        const F first = select(searches, part.from, F(0));
        const F length = select(searches, part.to - part.from, F(0));
        const auto place = [&](F t) { return card + rate * t; };
        F outside = first, inside = first;
        F depth(1);
        Mask<F> found(false), met_nan(false), active = searches;
        Int<F> points(0);
        for (const auto k : steps<F>(0, params.steps)) {
            const F t = first + length * (number<F>(k) / number<F>(params.steps));
            const auto sample = layers(active, place(t));
            const Mask<F> enters = active & sample.inside;
            count_in<F>(points, active);
            met_nan = met_nan | (active & sample.met_nan);
            inside = select(enters, t, inside);
            depth = select(enters, sample.depth, depth);
            found = found | enters;
            active = active & !enters;
            outside = select(active, t, outside);
            if (none(active)) break;
        }
        for (const auto k : steps<F>(1, params.binary_steps)) {
            const F middle = (outside + inside) * F(0.5f);
            const auto sample = layers(found, place(middle));
            const Mask<F> enters = found & sample.inside;
            count_in<F>(points, found);
            met_nan = met_nan | (found & sample.met_nan);
            inside = select(enters, middle, inside);
            depth = select(enters, sample.depth, depth);
            outside = select(found & !enters, middle, outside);
        }
        // A miss is at the card.
        const F t = select(found, inside, F(0));
        const vec3<F> hit = place(t);
        const vec2<F> uv(hit.x, hit.y);
        const Int<F> status = search_status<F>(found, met_nan, Status::clip);
        io.template store<Value::hit_uv>(uv);
        io.template store<Value::hit_s>(clamp(hit.z, F(0), F(1)));
        io.template store<Value::hit_h>(F(1) - depth);
        io.template store<Value::hit_depth>(t);
        io.template store<Value::hit_status>(select(framed, status, frame_status));
        io.template store<Value::hit_flags>(io.template load<Value::frame_flags>() |
                                            nan_look_up_flag(uv));
        io.template store<Value::hit_steps>(points);
        io.template store<Value::hit_fetches>(points * Int<F>(layers.maps()));
    }

  private:
    /// How far it is to the eye; infinite where a projection is parallel.
    template <class F>
    static F to_eye(const vec3<F>& P, const auto& frame) {
        if (frame.orthographic) return F(std::numeric_limits<Scalar<F>>::infinity());
        return length_at_any_scale(uniform3<F>(frame.eye) - P);
    }
};

}  // namespace quadrel
