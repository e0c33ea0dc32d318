// A world that is larger by a power of two looks the same, to the last bit: what frames compute on
// their way neither overflows nor vanishes.
#include "render/scenes.hpp"

#include <gtest/gtest.h>

#include "render/films.hpp"

namespace quadrel::render_tests {
namespace {

const std::vector<std::string> channels = {
    "uv", "K", "r", "hit.U", "hit.V", "hit.s", "hit.status", "hit.flags", "T", "N", "R", "G", "B"};

Scene relief_scene(const std::string& frame, bool orthographic) {
    Scene scene = empty_scene(24, 20);
    set_perspective_camera(scene, {0.3, 0.5, 4}, {.near = 1, .far = 20});
    if (orthographic)
        scene.camera.projection =
            orthographic_matrix(3, 1.2, {.near = 1, .far = 20}, scene.conventions);
    scene.materials = {relief_material("relief", false)};
    scene.materials[0].frame.id = frame;
    scene.lights = {Light()};
    add_object(scene, make_quad(2.5), 0, rotation(35, {1, 0.2, 0}));
    return scene;
}

/// The same world in other units.
Scene scaled(Scene scene, float k) {
    const auto from_origin = [k](glm::vec4& column) { column = {glm::vec3(column) * k, column.w}; };
    from_origin(scene.camera.view[3]);
    for (int column = 0; column < 3; ++column)
        scene.camera.projection[column] = scene.camera.projection[column] / k;
    for (Object& object : scene.objects)
        for (int column = 0; column < 4; ++column) from_origin(object.transform[column]);
    for (Light& light : scene.lights) light.position *= k;
    for (Material& material : scene.materials) material.depth *= k;
    return scene;
}

testing::AssertionResult looks_the_same(const std::string& frame, bool orthographic, int power) {
    const Scene scene = relief_scene(frame, orthographic);
    RenderOptions options;
    options.channels = channels;
    for (const char* number : {"float", "double"}) {
        options.number = number;
        const Film one = render(scene, options);
        const Film other = render(scaled(scene, std::ldexp(1.0f, power)), options);
        for (const Plane& plane : one.planes)
            if (plane.bits != other.find(plane.name)->bits)
                return testing::AssertionFailure() << plane.name << " by " << number;
    }
    return testing::AssertionSuccess();
}

TEST(WorldScale, FramesDoNotDependOnIt) {
    for (const char* frame : {"frame-gram", "frame-face", "frame-vertex", "frame-mikkt",
                              "frame-cot", "frame-inverse-tbn"})
        for (const bool orthographic : {false, true})
            for (const int power : {-50, -20, 20, 50})
                EXPECT_TRUE(looks_the_same(frame, orthographic, power))
                    << frame << (orthographic ? ", orthographic, 2^" : ", 2^") << power;
}

/// The square of a distance of 2^70 is no float.
TEST(WorldScale, TooLargeAWorldIsNoticed) { EXPECT_FALSE(looks_the_same("frame-gram", false, 70)); }

}  // namespace
}  // namespace quadrel::render_tests
