// A stage on Shader: what it loads becomes inputs of a function, what it stores outputs, the
// frame's vectors uniforms. Numbers of the material and of the stage's parameters are written as
// such.
#pragma once

#include <algorithm>
#include <array>
#include <set>
#include <string>

#include "quadrel/quad/shared_scales.hpp"
#include "quadrel/quad/stage.hpp"
#include "quadrel/quad/vertex_program.hpp"
#include "quadrel/texture/shader/look_ups.hpp"

namespace quadrel {

/// A uniform number. Texts may ask whether it is 0, which is then part of the shader.
struct ShaderNumber {
    std::string name;
    float value = 0;

    operator Shader() const {
        return Shader(
            recorded::Recorder::current().uniform(recorded::Type::real, {name, "float", 0}));
    }
    friend bool operator==(const ShaderNumber& a, float b) { return a.value == b; }
};
/// A uniform vector of three.
struct ShaderVector {
    std::string name;
};
template <Number F>
vec3<F> uniform3(const ShaderVector& v) {
    return recorded::unpack<3>(
        recorded::Recorder::current().uniform(recorded::Type::vec3, {v.name, "vec3", 0}));
}
/// A uniform array of numbers.
struct ShaderArray {
    std::string name;
    int count = 0;

    Shader operator[](int i) const {
        return Shader(recorded::Recorder::current().uniform(
            recorded::Type::real, {name, "float", count}, name + "[" + std::to_string(i) + "]"));
    }
};

struct ShaderLight {
    ShaderVector position, ambient, diffuse, specular;
    std::int32_t directional = 0;
    ShaderNumber intensity;
    ShaderNumber attenuation[3];
};

/// FrameUniforms as shaders have them.
struct ShaderFrame {
    ShaderVector eye{"eye"};
    std::int32_t orthographic = 0;
    ShaderArray eye_to_world{"eye_to_world", 9}, projection{"projection", 16};
    ShaderNumber depth_scale{"depth_scale"}, depth_offset{"depth_offset"};
    DerivativeMode derivatives = DerivativeMode::fine;
    std::int32_t light_count = 0;
    ShaderLight lights[max_lights];

    explicit ShaderFrame(const FrameUniforms& frame)
        : orthographic(frame.orthographic), light_count(frame.light_count) {
        for (int i = 0; i < light_count; ++i) {
            const LightUniforms& of = frame.lights[i];
            const std::string light = "light" + std::to_string(i) + "_";
            lights[i] = {{light + "position"},
                         {light + "ambient"},
                         {light + "diffuse"},
                         {light + "specular"},
                         of.directional,
                         {light + "intensity", of.intensity},
                         {{light + "constant", of.attenuation[0]},
                          {light + "linear", of.attenuation[1]},
                          {light + "quadratic", of.attenuation[2]}}};
        }
    }
};

/// What a recording is of.
struct ShaderScene {
    static_assert(texture_slot_count <= ShaderTextures::most, "textures are known by their slots");
    ShaderTextures textures;
    MaterialUniforms material{};
    ShaderFrame frame;
    std::int32_t light = 0;  ///< which light a stage a light serves

    explicit ShaderScene(const FrameUniforms& of) : frame(of) {}
};

/// The name of a value in shaders; `part`: u or v of those of six components.
inline std::string shader_name(Value value, int light = 0, const char* part = "") {
    std::string name(info(value).name);
    std::replace(name.begin(), name.end(), '.', '_');
    if (info(value).per_light) name += std::to_string(light);
    return name + part;
}

/// A bit of hit.flags under its name. Texts that are annotated (src/tools/annotate) have it where
/// they say Int<F>(HitFlag::...).
template <Number F>
Int<F> hit_flag(std::int32_t bit) {
    static_assert(std::same_as<F, Shader>);
    std::string name = "FLAG_";
    for (const HitFlagName& of : hit_flag_names)
        if (of.bit == bit)
            for (const char c : of.name)
                name +=
                    c == '-' ? '_' : static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
    return Int<F>(recorded::Recorder::current().symbol(recorded::Type::integer, name));
}

/// Names of a vertex' attributes in the functions of vertex programs (Vertex).
namespace vertex_attribute {
inline constexpr const char *position = "position", *normal = "normal", *tangent = "tangent",
                            *binormal = "binormal", *uv = "mapped_uv";
}

template <class Stage>
class StageIo<Stage, Shader> {
  public:
    using Number = Shader;
    static constexpr bool reads_vertices = Stage::reads_vertices;

    explicit StageIo(const ShaderScene& scene) : scene_(scene) {}

    template <Value v>
    auto load(int light = 0) const {
        static_assert(contains(Stage::inputs, v), "not among the stage's inputs");
        using namespace recorded;
        constexpr int n = info(v).components;
        Recorder& recorder = Recorder::current();
        if constexpr (info(v).kind == ValueKind::integer) {
            return ShaderInt(recorder.input(Type::integer, shader_name(v, light)));
        } else if constexpr (n == 1) {
            return Shader(recorder.input(Type::real, shader_name(v, light)));
        } else if constexpr (n == 6) {
            return std::array<vec3<Shader>, 2>{
                unpack<3>(recorder.input(Type::vec3, shader_name(v, light, "_u"))),
                unpack<3>(recorder.input(Type::vec3, shader_name(v, light, "_v")))};
        } else {
            return unpack<n>(recorder.input(vector_of(n), shader_name(v, light)));
        }
    }

    template <Value v, class X>
    void store(const X& x, int light = 0) const {
        static_assert(contains(Stage::outputs, v), "not among the stage's outputs");
        using namespace recorded;
        constexpr int n = info(v).components;
        Recorder& recorder = Recorder::current();
        if constexpr (n == 1) {
            recorder.output(x.node(), shader_name(v, light));
        } else if constexpr (n == 6) {
            recorder.output(pack<3>(x[0]), shader_name(v, light, "_u"));
            recorder.output(pack<3>(x[1]), shader_name(v, light, "_v"));
        } else {
            recorder.output(pack<n>(x), shader_name(v, light));
        }
    }

    /// All outputs are; those that nobody reads are left out as the shader is printed.
    template <Value v>
    bool wanted() const {
        static_assert(contains(Stage::outputs, v), "not among the stage's outputs");
        return true;
    }

    /// A shader runs for fragments alone.
    ShaderMask active() const { return ShaderMask(true); }
    template <TextureSlot slot>
    SampleContext<Shader> context(const ShaderMask& mask) const {
        return {mask, nullptr, nullptr};
    }
    template <TextureSlot slot>
    SampleContext<Shader> context() const {
        return context<slot>(active());
    }
    template <TextureSlot slot>
    const SampledTexture* texture() const {
        return scene_.textures.texture(static_cast<int>(slot));
    }
    template <class... Step>
    void march_step(const Step&...) const {}

    const MaterialUniforms& material() const { return scene_.material; }
    const ShaderFrame& frame() const { return scene_.frame; }
    int light() const { return scene_.light; }

    /// Nothing watches a shader, and every value is asked for.
    struct Call {
        struct Values {
            const void* operator[](int) const { return this; }
        };
        Values values;
        StageLog* log = nullptr;
        FetchCounters* counters = nullptr;
        SharedScales* scales = nullptr;
    };
    Call call() const { return {}; }
    int first_lane() const { return 0; }

  private:
    const ShaderScene& scene_;
};

/// The level of detail of the undisplaced UV, by its gradients.
template <class Stage>
LodRecord<Shader> undisplaced_lod(const StageIo<Stage, Shader>& io, const SampledTexture& map,
                                  LodUse) {
    return compute_lod(map, io.template load<Value::dUVdx>(), io.template load<Value::dUVdy>());
}
template <class Stage>
LodRecord<Shader> undisplaced_lod(const StageIo<Stage, Shader>& io, const SampledTexture& map) {
    return undisplaced_lod(io, map, LodUse::look_up);
}

/// What a listing's vertex shader computes becomes a function of attributes of vertices, in object
/// space, and of the object's matrices; what it hands on an input of the stage's function.
template <class Stage>
class VertexProgram<StageIo<Stage, Shader>> {
  public:
    using F = Shader;
    explicit VertexProgram(const StageIo<Stage, Shader>&) {}

    vec3<F> point_to_eye(const vec3<F>& p) const { return call("point_to_eye", p); }
    vec3<F> vector_to_eye(const vec3<F>& v) const { return call("vector_to_eye", v); }
    vec3<F> point_to_object(const vec3<F>& p) const { return call("point_to_object", p); }
    vec3<F> vector_to_object(const vec3<F>& v) const { return call("vector_to_object", v); }
    vec3<F> normal_to_eye(const vec3<F>& n) const { return call("normal_to_eye", n); }

    template <class Text>
    auto varying(const Text& text) const {
        using namespace recorded;
        const auto at_vertex = text(vertex());
        if constexpr (std::same_as<std::decay_t<decltype(at_vertex)>, Shader>) {
            return Shader(Recorder::current().interpolated(at_vertex.node()));
        } else {
            constexpr int n = std::decay_t<decltype(at_vertex)>::length();
            return unpack<n>(Recorder::current().interpolated(pack<n>(at_vertex)));
        }
    }

  private:
    /// By functions that the shader brings with it, which know the object's matrices.
    static vec3<F> call(const char* transform, const vec3<F>& v) {
        return recorded::vector<3>(transform, {recorded::pack<3>(v)});
    }
    static Vertex<F> vertex() {
        using namespace recorded;
        const auto attribute = [](const char* name) {
            return unpack<3>(Recorder::current().symbol(Type::vec3, name));
        };
        return {attribute(vertex_attribute::position), attribute(vertex_attribute::normal),
                attribute(vertex_attribute::tangent), attribute(vertex_attribute::binormal),
                unpack<2>(Recorder::current().symbol(Type::vec2, vertex_attribute::uv))};
    }
};

}  // namespace quadrel
