// What WebGPU has in its own way, or not at all.
#pragma once

#include <string>
#include <vector>

#include "export/export.hpp"
#include "quadrel/scene/scene.hpp"

namespace quadrel {

/// Throws UsageError for conventions and counts of samples that WebGPU has not.
void check_webgpu_scene(const Scene& scene);

/// Throws UsageError for what its samplers lack: borders, mirroring once, a bias of levels.
void check_webgpu_sampler(const SamplerState& state, const std::string& name);

/// Whether a shader in WGSL looks a map up by its sampler, which it otherwise has none of.
bool reads_by_sampler(const std::string& shader, const std::string& map);

/// Where the shader binds that name, in group 0; -1 where it does not.
int binding_of(const std::string& shader, const std::string& name);

/// The buffer of numbers that both shaders of a program read: offsets in bytes, of arrays of floats
/// that of the first, the others behind it without gaps.
struct UniformBuffer {
    std::vector<std::size_t> offsets;  ///< of each uniform of the program
    std::size_t size = 0;
};
UniformBuffer uniform_buffer(const std::vector<ProgramName>& uniforms);

}  // namespace quadrel
