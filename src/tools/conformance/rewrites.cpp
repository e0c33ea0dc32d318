#include "conformance/rewrites.hpp"

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>

namespace quadrel::conformance {
namespace {

/// Compilers turn a comparison and a choice into min again, unless it is to be precise.
constexpr const char* first_lines = R"(#extension GL_ARB_gpu_shader5 : enable
#ifdef GL_ARB_gpu_shader5
#define EXACTLY precise
#else
#define EXACTLY
#endif
)";

constexpr const char* of_numbers = R"(
float lesser(float x, float y) { EXACTLY float z = y < x ? y : x; return z; }
float greater(float x, float y) { EXACTLY float z = x < y ? y : x; return z; }
int lesser(int x, int y) { return y < x ? y : x; }
int greater(int x, int y) { return x < y ? y : x; }
)";

constexpr const char* macros = R"(
#define min(x, y) lesser(x, y)
#define max(x, y) greater(x, y)
#define clamp(x, low, high) lesser(greater(x, low), high)
)";

/// vec3 lesser(vec3 x, vec3 y) { return vec3(lesser(x.x, y.x), ...); }, and of a vec3 and a float.
std::string of_vectors(const std::string& function, int components) {
    const std::string type = "vec" + std::to_string(components);
    std::string all;
    for (int c = 0; c < components; ++c) {
        const std::string part = std::string(".") + "xyzw"[c];
        all += (c == 0 ? "" : ", ") + function + "(x" + part + ", y" + part + ")";
    }
    return type + " " + function + "(" + type + " x, " + type + " y) { return " + type + "(" + all +
           "); }\n" + type + " " + function + "(" + type + " x, float y) { return " + function +
           "(x, " + type + "(y)); }\n";
}

std::string comparisons() {
    std::string all = first_lines + std::string(of_numbers);
    for (const char* const function : {"lesser", "greater"})
        for (int components = 2; components <= 4; ++components)
            all += of_vectors(function, components);
    return all + macros;
}

/// type blend(type x, type y, part a)
std::string blend_of(const std::string& type, const std::string& part) {
    return type + " blend(" + type + " x, " + type + " y, " + part + " a) { EXACTLY " + type +
           " z = x * (1.0 - a) + y * a; return z; }\n";
}

std::string blends() {
    std::string all = first_lines + blend_of("float", "float");
    for (const char* const type : {"vec2", "vec3", "vec4"})
        all += blend_of(type, "float") + blend_of(type, type);
    return all + "#define mix(x, y, a) blend(x, y, a)\n";
}

constexpr const char* sizes_of_levels = R"(
ivec2 size_of_level(ivec2 size, int level) { return max(size >> level, ivec2(1)); }
ivec3 size_of_level(ivec3 size, int level) { return ivec3(size_of_level(size.xy, level), size.z); }
#define textureSize(map, level) size_of_level(textureSize(map, 0), level)
)";

gl::ExportedScene with(gl::ExportedScene scene, const std::string& definitions) {
    for (gl::ExportedMaterial& material : scene.materials) {
        // Behind the version and what else has to come first.
        const std::size_t at = material.fragment.find("#ifndef PASS");
        if (at != std::string::npos) material.fragment.insert(at, definitions);
    }
    return scene;
}

}  // namespace

bool has_mixes(const gl::ExportedScene& scene) {
    return std::ranges::any_of(scene.materials, [](const gl::ExportedMaterial& of) {
        return of.fragment.find("mix(") != std::string::npos;
    });
}

bool has_implicit_look_ups_in_loops(const gl::ExportedScene& scene) {
    for (const gl::ExportedMaterial& material : scene.materials) {
        std::istringstream lines(material.fragment);
        int depth = 0, loop = -1;  // of braces; where the outermost loop began
        for (std::string line; std::getline(lines, line);) {
            if (loop < 0 && line.find("for (") != std::string::npos) loop = depth;
            if (loop >= 0 && (line.find(" texture(") != std::string::npos ||
                              line.find("(texture(") != std::string::npos))
                return true;
            depth += static_cast<int>(std::ranges::count(line, '{')) -
                     static_cast<int>(std::ranges::count(line, '}'));
            if (loop >= 0 && depth <= loop) loop = -1;
        }
    }
    return false;
}

gl::ExportedScene with_comparisons(gl::ExportedScene scene) {
    return with(std::move(scene), comparisons());
}

gl::ExportedScene with_blends(gl::ExportedScene scene) { return with(std::move(scene), blends()); }

gl::ExportedScene with_sizes_of_level_0(gl::ExportedScene scene) {
    return with(std::move(scene), sizes_of_levels);
}

gl::ExportedScene with_whole_levels(gl::ExportedScene scene) {
    for (gl::ExportedMaterial& material : scene.materials)
        for (gl::ExportedSampler& sampler : material.samplers)
            if (sampler.state.min == Filter::nearest && sampler.state.mip == MipFilter::linear)
                sampler.state.mip = MipFilter::nearest;
    return scene;
}

}  // namespace quadrel::conformance
