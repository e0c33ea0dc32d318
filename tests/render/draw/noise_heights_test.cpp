// Heights of noise in place of a height map, from the scene to the film.
#include "quadrel/quad/value.hpp"
#include "quadrel/relief/noise.hpp"
#include "render/planted.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

/// A quad whose relief is noise; there is no texture at all.
Scene noise_scene(float frequency) {
    Scene scene = empty_scene(24, 18);
    set_perspective_camera(scene, {0, 1.5, 2}, {});
    Material stone = relief_material("stone", false);
    stone.textures.clear();
    stone.noise = NoiseHeights{frequency, 3};
    stone.surface.id = "h2n-patch";
    scene.materials = {stone};
    scene.lights = {Light()};
    add_object(scene, make_quad(), 0);
    return scene;
}

/// The height at every hit is the field's.
testing::AssertionResult shows_noise(float shown, float expected) {
    const Film film =
        take(render, noise_scene(shown), {"A", "hit.U", "hit.V", "hit.h", "hit.status"});
    return everywhere(film, covered(film), [&](int x, int y) -> std::string {
        if (bits(film, "hit.status", x, y) != static_cast<std::uint32_t>(Status::hit)) return "";
        const vec2<float> uv(value(film, "hit.U", x, y), value(film, "hit.V", x, y));
        return differs("hit.h", value(film, "hit.h", x, y), noise_field(uv, expected, 3).value,
                       1e-5);
    });
}

TEST(NoiseHeights, AreWhatSearchesFind) {
    EXPECT_TRUE(shows_noise(4, 4));
    EXPECT_TRUE(shows_noise(2.5f, 2.5f));
    EXPECT_FALSE(shows_noise(4, 5));
}

/// Without a choice of normals, those that noise can have.
TEST(NoiseHeights, HaveDefaults) {
    Scene chosen = noise_scene(4), open = chosen;
    for (StageChoice* choice : {&open.materials[0].surface, &open.materials[0].frame})
        choice->id.clear();
    const std::vector<std::string> picture = {"R", "G", "B", "N"};
    EXPECT_TRUE(same_bits(take(render, chosen, picture), take(render, open, picture)));
    open.materials[0].surface.id = "none";
    EXPECT_FALSE(same_bits(take(render, chosen, picture), take(render, open, picture)));
}

}  // namespace
}  // namespace quadrel::render_tests
