// Plugins that the build made, and scenes that use their stages.
#pragma once

#include <filesystem>
#include <string>

#include "quadrel/relief/registry.hpp"
#include "render/films.hpp"
#include "render/scenes.hpp"

namespace quadrel::plugin_tests {

using render_tests::Renderer;
using render_tests::same_bits;

inline std::filesystem::path plugin(const std::string& name) {
    return std::filesystem::path(QUADREL_PLUGINS) / (name + ".so");
}

/// Which stages the relief of a scene is made of.
struct Choice {
    std::string trace, surface, shade;
};

/// A tilted quad of relief and a curved one, lit, at a width that is no multiple of a packet's.
inline Scene relief_scene(const Choice& choice) {
    Scene scene = render_tests::empty_scene(43, 31);
    render_tests::set_perspective_camera(scene, {0.4, 0.7, 3}, {.near = 0.5, .far = 50});
    scene.lights = {Light(), render_tests::directional_light({0.3f, 0.2f, 1})};
    scene.materials = {render_tests::relief_material("relief", false)};
    Material& material = scene.materials[0];
    if (!choice.trace.empty()) material.trace.id = choice.trace;
    if (!choice.surface.empty()) material.surface.id = choice.surface;
    if (!choice.shade.empty()) material.shade.id = choice.shade;
    material.trace.parameters.clear();
    render_tests::add_object(scene, make_quad(2.4), 0, rotation(-40, {1, 0, 0}));
    render_tests::add_object(scene, make_sphere(0.6, 12, 8), 0, translation({0.5, 0.6, 0.4}));
    return scene;
}

inline Film render_all(const Scene& scene, const std::string& isa,
                       const std::string& number = "float") {
    RenderOptions options;
    options.channels = render_tests::all_channels(scene);
    options.isa = isa;
    options.number = number;
    return render(scene, options);
}

}  // namespace quadrel::plugin_tests
