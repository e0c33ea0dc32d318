#include "conformance/planted.hpp"

#include <algorithm>

namespace quadrel::conformance {
namespace {

/// Replaces a word everywhere in the fragment shaders; whether there was one.
bool replace(gl::ExportedScene& scene, const std::string& from, const std::string& to) {
    bool found = false;
    for (gl::ExportedMaterial& material : scene.materials)
        for (std::size_t at = 0; (at = material.fragment.find(from, at)) != std::string::npos;
             at += to.size()) {
            material.fragment.replace(at, from.size(), to);
            found = true;
        }
    return found;
}

bool swap_derivatives(gl::ExportedScene& scene) {
    return replace(scene, "dFdx(", "dFd?(") && replace(scene, "dFdy(", "dFdx(") &&
           replace(scene, "dFd?(", "dFdy(");
}

/// Loops look a step further than they count.
bool off_by_one_step(gl::ExportedScene& scene) {
    return replace(scene, "= float(i)", "= 1.0 + float(i)");
}

/// clamp and max leave what they are given.
bool no_clamp(gl::ExportedScene& scene) {
    for (gl::ExportedMaterial& material : scene.materials) {
        const std::size_t end = material.fragment.find('\n') + 1;
        material.fragment.insert(end, "#define clamp(x, low, high) (x)\n#define max(x, y) (y)\n");
    }
    return true;
}

bool clamp_to_edge(gl::ExportedScene& scene) {
    bool found = false;
    for (gl::ExportedMaterial& material : scene.materials)
        for (gl::ExportedSampler& sampler : material.samplers) {
            found |= sampler.state.wrap_u == Wrap::repeat;
            sampler.state.wrap_u = sampler.state.wrap_v = Wrap::clamp_to_edge;
        }
    return found;
}

/// The first light's position is somewhat off.
bool move_light(gl::ExportedScene& scene) {
    for (gl::Uniform& uniform : scene.uniforms)
        if (uniform.name.find("light") != std::string::npos &&
            uniform.name.find("position") != std::string::npos && !uniform.values.empty()) {
            uniform.values[0] += 0.05f;
            return true;
        }
    return false;
}

/// Each level is a texel to the right of where it was.
bool shift_texels(gl::ExportedScene& scene) {
    for (gl::ExportedTexture& texture : scene.textures)
        for (gl::TextureLevel& level : texture.levels) {
            const auto texels =
                static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height);
            std::ranges::rotate(
                level.bytes,
                level.bytes.begin() + static_cast<std::ptrdiff_t>(level.bytes.size() / texels));
        }
    return !scene.textures.empty();
}

}  // namespace

const std::vector<PlantedError>& planted_errors() {
    static const std::vector<PlantedError> all{{"swapped derivatives", swap_derivatives},
                                               {"off by one step", off_by_one_step},
                                               {"no clamp", no_clamp},
                                               {"wrong wrap", clamp_to_edge},
                                               {"light from another point", move_light},
                                               {"texels shifted by one", shift_texels}};
    return all;
}

}  // namespace quadrel::conformance
