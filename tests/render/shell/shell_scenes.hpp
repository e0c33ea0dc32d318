// Scenes of shells for tests: bumps of few texels over wound meshes.
#pragma once

#include "effort.hpp"
#include "render/films.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {

inline constexpr int bump_texels = 16;

inline double bump_height(int x, int y) { return 0.25 + 0.5 * noise(x, y, 1); }

/// One level, so that every search reads the same heights.
inline TextureReference bump_texture() {
    TextureReference reference = texture(write_texture(
        "shell-bumps.exr", bump_texels, [](int x, int y, int) { return bump_height(x, y); }));
    reference.sampler.mip = MipFilter::none;
    return reference;
}

/// Everywhere the same height.
inline TextureReference even_texture(double level) {
    TextureReference reference = texture(
        write_texture(fmt::format("even-{}.exr", level), 4, [=](int, int, int) { return level; }));
    reference.sampler.mip = MipFilter::none;
    return reference;
}

/// So that no edge of a mesh lies along rows of pixels.
inline glm::dmat4 wound_transform() { return rotation(25, {1, 2, 0.5}); }

/// A mesh in its shell, seen from three units away.
inline Scene scene_of_shell(const Mesh& mesh, const std::string& frame, const std::string& trace,
                            const TextureReference& heights, int size) {
    Scene scene = empty_scene(size, size);
    set_perspective_camera(scene, {0.3, -0.2, 3}, {.near = 0.5, .far = 20});
    scene.materials = {plain_material("shell", {1, 1, 1})};
    Material& material = scene.materials[0];
    material.frame.id = frame;
    material.trace = stage(trace, "materials.shell.relief.trace");
    material.frag_depth = stage("frag-depth", "materials.shell.relief.frag_depth");
    material.depth = 0.2f;
    material.textures["height"] = heights;
    add_object(scene, mesh, 0, wound_transform());
    return scene;
}

}  // namespace quadrel::render_tests
