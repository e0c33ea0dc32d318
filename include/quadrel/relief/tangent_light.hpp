// Light in tangent space, as listings with a vertex program have it.
//
// Their vertex program takes the vector from the vertex to the light along the vertex' tangent,
// binormal and normal; their fragment program normalises what is interpolated and compares it with
// the numbers of a normal map. So the light is seen from the surface itself, not from the displaced
// point, and over a curved or sheared mesh it is not the vector that a fragment would make of its
// own frame. Here the normal comes in eye space, whatever stage has made it, as N = x T + y B + z F
// with the frame's T, B and normal F: x, y and z are taken back from it. Where T, B and F do not
// span space (no frame, a degenerate UV map) both vectors stay in eye space.
#pragma once

#include "quadrel/relief/vertex_frame.hpp"

namespace quadrel {

/// What TangentLight loads. The stage declares reads_vertices.
inline constexpr auto tangent_light_inputs =
    values(Value::P, Value::T, Value::B, Value::frame_normal, Value::N);

/// A colour made in tangent space.
struct TangentShade : StageDefaults {
    static constexpr auto outputs = values(Value::color, Value::opacity);
    static constexpr auto textures = slots(TextureSlot::color);
    static constexpr bool reads_vertices = true;
};

template <class Io>
class TangentLight {
  public:
    using F = typename Io::Number;

    explicit TangentLight(const Io& io) : io_(io), program_(io) {
        const vec3<F> T = io.template load<Value::T>(), B = io.template load<Value::B>();
        const vec3<F> normal = io.template load<Value::frame_normal>();
        const vec3<F> N = io.template load<Value::N>();
        const vec3<F> x = cross(B, normal), y = cross(normal, T), z = cross(T, B);
        const F volume = dot(T, x);
        framed_ = abs(volume) > F(0);
        normal_ = select(framed_, vec3<F>(dot(N, x), dot(N, y), dot(N, z)) / volume, N);
    }

    /// The shading normal, as long as the surface stage left it.
    const vec3<F>& normal() const { return normal_; }
    /// Where both vectors are in tangent space.
    Mask<F> framed() const { return framed_; }
    const VertexProgram<Io>& program() const { return program_; }

    /// The interpolated vector to the light, not normalised; directional lights have no position
    /// that a vertex could be subtracted from.
    vec3<F> to(const auto& light) const {
        const vec3<F> position = uniform3<F>(light.position);
        if (!light.directional) return to_point(light);
        return varying(
            [&](const Vertex<F>& v) {
                return v.in_tangent_space(program_.vector_to_object(position));
            },
            position);
    }

    /// The same by programs that subtract the vertex whatever the light is.
    vec3<F> to_point(const auto& light) const {
        const vec3<F> position = uniform3<F>(light.position);
        const vec3<F> target = light.directional ? program_.vector_to_object(position)
                                                 : program_.point_to_object(position);
        return varying([&](const Vertex<F>& v) { return v.in_tangent_space(target - v.position); },
                       position - io_.template load<Value::P>());
    }

    /// What `text` gives for the vertices, interpolated; `in_eye_space` where there is no tangent
    /// space.
    template <class Text>
    vec3<F> varying(const Text& text, const vec3<F>& in_eye_space) const {
        return select(framed_, program_.varying(text), in_eye_space);
    }

  private:
    const Io& io_;
    VertexProgram<Io> program_;
    vec3<F> normal_;
    Mask<F> framed_;
};

template <class Io>
TangentLight(const Io&) -> TangentLight<Io>;

}  // namespace quadrel
