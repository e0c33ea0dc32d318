// Small scenes for tests, made in code.
#pragma once

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "film/films.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/scene/camera.hpp"
#include "quadrel/scene/scene.hpp"
#include "quadrel/scene/shapes.hpp"
#include "quadrel/scene/transform.hpp"

namespace quadrel::render_tests {

/// A folder for texture files, as long as the process lives.
inline const testing_films::TemporaryFolder& texture_folder() {
    static const testing_films::TemporaryFolder folder;
    return folder;
}

/// Writes a texture unless it is there: tests of one process may give one name to two maps.
inline std::filesystem::path write_if_new(const std::string& name, const Film& film) {
    static std::map<std::string, Film> written;
    const auto file = texture_folder() / name;
    if (written[name] != film) write_exr(file, film, {});
    written[name] = film;
    return file;
}

/// Writes an RGBA image of `size` squared texels; `texel(x, y, channel)` gives its values.
template <class Texel>
std::filesystem::path write_texture(const std::string& name, int size, const Texel& texel) {
    Film film{{0, 0, size, size}, {0, 0, size, size}, {}};
    const char* const names[] = {"R", "G", "B", "A"};
    for (int c = 0; c < 4; ++c) {
        Plane& plane = film.add(names[c], ChannelType::float32);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                plane.bits[film.index(x, y)] =
                    std::bit_cast<std::uint32_t>(static_cast<float>(texel(x, y, c)));
    }
    return write_if_new(name, film);
}

/// Values in [0, 1] that look like noise; all of them different.
inline double noise(int x, int y, int channel) {
    std::uint32_t h = std::uint32_t(x) * 73856093u ^ std::uint32_t(y) * 19349663u ^
                      std::uint32_t(channel) * 83492791u;
    h = (h ^ (h >> 13)) * 0x5bd1e995u;
    return static_cast<double>((h ^ (h >> 15)) & 0xffff) / 65535.0;
}

inline TextureReference texture(const std::filesystem::path& file,
                                const std::string& swizzle = "") {
    TextureReference reference;
    reference.file = file;
    reference.swizzle = swizzle;
    reference.key = "textures." + file.stem().string();
    return reference;
}

inline TextureReference noise_texture(const std::string& swizzle = "") {
    return texture(write_texture("noise.exr", 16, noise), swizzle);
}

/// White; alpha is 0 in every other square of 4x4 texels, else 1. Not filtered.
inline TextureReference holes_texture() {
    TextureReference reference = texture(write_texture("holes.exr", 16, [](int x, int y, int c) {
        return c < 3 || (x / 4 + y / 4) % 2 == 0 ? 1.0 : 0.0;
    }));
    reference.sampler.mag = reference.sampler.min = Filter::nearest;
    reference.sampler.mip = MipFilter::none;
    return reference;
}

inline Environment noise_environment() {
    Environment environment;
    for (int face = 0; face < 6; ++face)
        environment.faces[static_cast<std::size_t>(face)] =
            write_texture("face" + std::to_string(face) + ".exr", 4,
                          [face](int x, int y, int c) { return noise(x + 7 * face, y, c); });
    environment.key = "environment";
    return environment;
}

inline StageChoice stage(const std::string& id, const std::string& key) {
    StageChoice choice;
    choice.id = id;
    choice.key = key;
    return choice;
}

/// A material without relief: its colour is `emission` exactly when there are no lights.
inline Material plain_material(const std::string& name, const glm::vec3& emission = glm::vec3(0)) {
    Material material;
    material.name = name;
    material.frame = stage("none", "materials." + name + ".relief.frame");
    material.trace = stage("none", "materials." + name + ".relief.trace");
    material.surface = stage("none", "materials." + name + ".relief.surface");
    material.shadow = stage("none", "materials." + name + ".relief.shadow");
    material.shade = stage("shade-thesis", "materials." + name + ".shade");
    material.emission = glm::vec4(emission, 1);
    return material;
}

/// A material of relief with every map.
inline Material relief_material(const std::string& name, bool published) {
    Material material = plain_material(name);
    material.frame.id = published ? "frame-thesis" : "frame-gram";
    material.trace.id = published ? "linear-thesis" : "linear";
    material.surface.id = published ? "h2n-thesis@published" : "h2n-thesis";
    material.shadow.id = published ? "shadow-march-thesis@published" : "shadow-march-thesis";
    material.shade.id = published ? "shade-thesis@published" : "shade-thesis";
    if (!published) material.trace.parameters["steps"] = 24;
    if (!published) material.shadow.parameters["steps"] = 16;
    material.depth = 0.3f;
    material.textures["height"] = noise_texture("g");
    for (const char* map : {"color", "gloss", "emissive"}) material.textures[map] = noise_texture();
    return material;
}

inline Scene empty_scene(int width, int height) {
    Scene scene;
    scene.file = "test.json";
    scene.width = width;
    scene.height = height;
    scene.background = {0.25f, 0.5f, 0.125f, 0};
    return scene;
}

/// Looks down -z from the origin, parallel; one unit of length is a pixel, the middle of the frame
/// is (0, 0).
inline void set_pixel_camera(Scene& scene) {
    scene.camera.view = glm::mat4(1.0f);
    scene.camera.projection =
        orthographic_matrix(scene.height, static_cast<double>(scene.width) / scene.height,
                            {.near = 1, .far = 9}, scene.conventions);
}

inline void set_perspective_camera(Scene& scene, const glm::dvec3& eye, const DepthAndShift& lens) {
    scene.camera.view = view_matrix(eye, {0, 0, 0}, {0, 1, 0});
    scene.camera.projection = perspective_matrix(
        50, static_cast<double>(scene.width) / scene.height, lens, scene.conventions);
    scene.camera.reversed_z = lens.reversed_z;
}

/// Adds an object with a mesh of its own.
inline void add_object(Scene& scene, const Mesh& mesh, std::size_t material,
                       const glm::dmat4& transform = glm::dmat4(1.0)) {
    scene.meshes.push_back(mesh);
    Object object;
    object.name = "object " + std::to_string(scene.objects.size());
    object.mesh = scene.meshes.size() - 1;
    object.material = material;
    object.transform = glm::mat4(transform);
    scene.objects.push_back(object);
}

/// One triangle, counter-clockwise from +z if its corners are; no normals.
inline Mesh triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    Mesh mesh;
    mesh.positions = {a, b, c};
    mesh.uvs = {{0, 0}, {1, 0}, {0, 1}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

/// A rectangle in a plane of constant z; no normals.
inline Mesh rectangle(float x0, float y0, float x1, float y1, float z) {
    Mesh mesh;
    mesh.positions = {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

inline Light directional_light(const glm::vec3& direction) {
    Light light;
    light.kind = Light::Kind::directional;
    light.space = Light::Space::world;
    light.position = direction;
    return light;
}

/// A little of everything: relief of both kinds, holes, a flat cube, a sphere, two lights, an
/// environment. Its size is odd on purpose.
inline Scene varied_scene(int samples = 1, Conventions conventions = Conventions::gl,
                          int width = 37, int height = 27) {
    Scene scene = empty_scene(width, height);
    scene.samples = samples;
    scene.conventions = conventions;
    set_perspective_camera(scene, {0.6, 0.9, 4}, {.near = 0.5, .far = 50});
    scene.lights = {Light(), directional_light({0.3f, -0.2f, 1})};
    scene.lights[0].quadratic_attenuation = 0.002f;
    scene.environment = noise_environment();
    scene.materials = {relief_material("relief", false), relief_material("published", true),
                       plain_material("holes", {0.5f, 0.25f, 0.125f}), plain_material("plain")};
    scene.materials[2].textures["color"] = holes_texture();
    scene.materials[2].discard_below = 0.5f;
    Mesh bare_cube = make_cube(0.9);
    bare_cube.normals.clear();
    add_object(scene, make_quad(3, 2, 3), 0, translation({-0.9, 0, 0}) * rotation(40, {0, 1, 0}));
    add_object(scene, make_quad(2), 1, translation({1.2, 0.1, -0.3}) * rotation(-35, {1, 0, 0}));
    add_object(scene, make_quad(1.6), 2, translation({0, -0.2, 1}) * rotation(20, {0, 0, 1}));
    add_object(scene, bare_cube, 3, translation({0.4, -0.9, 0.6}) * rotation(30, {1, 1, 0}));
    add_object(scene, make_sphere(0.5, 12, 8), 0, translation({0.5, 1, 0.4}));
    return scene;
}

/// The scene with one of its objects alone.
inline Scene only(Scene scene, std::size_t object) {
    for (std::size_t i = 0; i < scene.objects.size(); ++i) scene.objects[i].visible = i == object;
    return scene;
}

}  // namespace quadrel::render_tests
