#include "export/scene/webgpu.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "quadrel/error.hpp"
#include "render/plan/names.hpp"

namespace quadrel {
namespace {

struct Layout {
    std::size_t align, size;
};

/// WGSL, 14.4: of structs in the address space uniform, where an array has vectors of four.
Layout layout_of(const ProgramName& uniform) {
    if (uniform.number > 0) return {16, 16 * ((static_cast<std::size_t>(uniform.number) + 3) / 4)};
    if (uniform.type == "vec2") return {8, 8};
    if (uniform.type == "vec3") return {16, 12};
    return uniform.type == "vec4" ? Layout{16, 16} : Layout{4, 4};
}

std::size_t aligned(std::size_t offset, std::size_t align) {
    return (offset + align - 1) / align * align;
}

}  // namespace

void check_webgpu_scene(const Scene& scene) {
    if (scene.conventions != Conventions::d3d)
        throw UsageError(fmt::format(
            "--language wgsl: found a scene of conventions \"{}\", expected \"d3d\", whose clip "
            "space WebGPU has (-D conventions=d3d)",
            name_of(scene.conventions)));
    if (scene.samples != 1 && scene.samples != 4)
        throw UsageError(fmt::format(
            "--language wgsl: found {} samples per pixel, expected 1 or 4, as WebGPU has them",
            scene.samples));
}

void check_webgpu_sampler(const SamplerState& state, const std::string& name) {
    const auto refuse = [&](const std::string& found) {
        throw UsageError(fmt::format(
            "--language wgsl: {}: found {}, expected a sampler that WebGPU has", name, found));
    };
    for (const Wrap wrap : {state.wrap_u, state.wrap_v}) {
        if (wrap == Wrap::clamp_to_border) refuse("clamp-to-border");
        if (wrap == Wrap::mirror_once) refuse("mirror-once");
    }
    if (state.lod_bias != 0) refuse(fmt::format("a bias of {} levels", state.lod_bias));
}

bool reads_by_sampler(const std::string& shader, const std::string& map) {
    return binding_of(shader, map + "_sampler") >= 0;
}

int binding_of(const std::string& shader, const std::string& name) {
    const std::size_t at = shader.find(") var " + name + ":");
    if (at == std::string::npos) return -1;
    const std::string word = "@binding(";
    return std::atoi(shader.c_str() + shader.rfind(word, at) + word.size());
}

UniformBuffer uniform_buffer(const std::vector<ProgramName>& uniforms) {
    UniformBuffer buffer;
    for (const ProgramName& uniform : uniforms) {
        const Layout layout = layout_of(uniform);
        buffer.offsets.push_back(aligned(buffer.size, layout.align));
        buffer.size = buffer.offsets.back() + layout.size;
    }
    buffer.size = aligned(buffer.size, 16);
    return buffer;
}

}  // namespace quadrel
