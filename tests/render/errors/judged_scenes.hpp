// Small scenes whose errors are known, and films of them.
#pragma once

#include "quadrel/errors.hpp"
#include "quadrel/quad/value.hpp"
#include "render/planted.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {

inline constexpr int map_size = 32;

/// Without mip levels, so that searches read what the judge reads.
inline TextureReference finest_level(TextureReference reference) {
    reference.sampler.mip = MipFilter::none;
    return reference;
}

/// One smooth hill a tile.
inline TextureReference hills() {
    return finest_level(texture(write_texture("hills.exr", map_size, [](int x, int y, int) {
        const auto bump = [](int i) {
            const double t = (i + 0.5) / map_size;
            return 16 * t * t * (1 - t) * (1 - t);
        };
        return 0.1 + 0.7 * bump(x) * bump(y);
    })));
}

/// Walls along v, one texel thin, on even ground.
inline TextureReference fences() {
    return finest_level(texture(write_texture(
        "fences.exr", map_size, [](int x, int, int) { return x % 16 == 8 ? 0.9 : 0.25; })));
}

/// A square of relief seen at an angle, all of whose stages have a say in its colour.
inline Scene judged_scene(const std::string& trace, const TextureReference& heights = hills(),
                          const std::string& frame = "frame-face", int size = 32) {
    Scene scene = empty_scene(size, size);
    set_perspective_camera(scene, {0.9, -1.2, 1.5}, {.near = 0.5, .far = 50});
    scene.materials = {relief_material("relief", false)};
    Material& material = scene.materials[0];
    material.frame = stage(frame, "materials.relief.relief.frame");
    material.trace = stage(trace, "materials.relief.relief.trace");
    material.textures["height"] = heights;
    material.depth = 0.25f;
    Light light = directional_light({0.8f, 0.3f, 1});
    scene.lights = {light};
    add_object(scene, make_quad(2), 0);
    return scene;
}

inline Film errors_of(const Renderer& renderer, const Scene& scene, RenderOptions options = {},
                      const std::vector<std::string>& more = {}) {
    options.channels = error_channels();
    options.channels.insert(options.channels.end(), more.begin(), more.end());
    return renderer(scene, options);
}

inline ErrorKind kind_at(const Film& film, int x, int y, const std::string& part = "err.") {
    return static_cast<ErrorKind>(bits(film, part + "kind", x, y));
}

/// render() with a change of the film.
inline Renderer changed(const std::function<void(Film&)>& change) {
    return [=](const Scene& scene, const RenderOptions& options) {
        Film film = render(scene, options);
        change(film);
        return film;
    };
}

/// Changes each covered value of a float plane.
inline void change_plane(Film& film, const std::string& name,
                         const std::function<float(float)>& change) {
    Plane& plane = *film.find(name);
    for (std::size_t i = 0; i < plane.bits.size(); ++i)
        if (film.find("A")->as_float(i) > 0)
            plane.bits[i] = std::bit_cast<std::uint32_t>(change(plane.as_float(i)));
}

}  // namespace quadrel::render_tests
