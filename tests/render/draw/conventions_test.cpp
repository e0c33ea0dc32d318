// gl, vulkan and d3d give one picture, up to what their window axes change.
//
// Window row y of gl is row H - 1 - y of vulkan and d3d. With an even H both pair the same image
// rows in quads, so that everything is equal bit for bit but: derivatives along y (negated) and the
// bitangent of window-space frames with them, the lane numbers, and depth (another range, rounded
// otherwise). With an odd H other rows pair up: what comes from differences may differ, what is
// interpolated may not. vulkan and d3d have the same window, so they differ in nothing.
//
// The published normal is an exception by its own listing: the cross product of window-space
// tangents changes its sign with the window's y, and the smooth-shading difference is added before
// the side is chosen. So its N, and what is shaded with it, depend on the conventions.
#include "quadrel/scene/load.hpp"
#include "render/planted.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

using MakeScene = std::function<Scene(Conventions)>;

const std::vector<std::string> negated = {"dUVdy", "dPdy"};
const std::vector<std::string> window_bound = {"quad", "depth", "frag.depth", "B.X", "B.Y", "B.Z"};

std::vector<std::string> plus(std::vector<std::string> a, const std::vector<std::string>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

testing::AssertionResult turns_sign(const Film& gl, const Film& other) {
    for (const char* name : {"dUVdy.U", "dUVdy.V", "dPdy.X", "dPdy.Y", "dPdy.Z"})
        if (auto result = everywhere(gl, covered(gl),
                                     [&](int x, int y) {
                                         return differs(name, value(other, name, x, y),
                                                        -value(gl, name, x, y), 0);
                                     });
            !result)
            return result;
    return testing::AssertionSuccess();
}

/// The difference of equal numbers is +0 whichever is subtracted, so zeros do not turn their sign
/// where all else does.
Film without_signs_of_zeros(Film film) {
    for (Plane& plane : film.planes)
        for (std::uint32_t& bits : plane.bits) bits = bits == 0x80000000u ? 0 : bits;
    return film;
}

testing::AssertionResult even_frames_agree(const Renderer& renderer, const MakeScene& make,
                                           const std::vector<std::string>& but = {}) {
    const Scene scene = make(Conventions::gl);
    const auto all = without(all_channels(scene), but);
    const auto equal = without(all, plus(negated, window_bound));
    const Film gl = take(renderer, scene, all);
    const Film vulkan = take(renderer, make(Conventions::vulkan), all);
    const Film d3d = take(renderer, make(Conventions::d3d), all);
    if (auto same = same_bits(without_signs_of_zeros(with_planes(gl, equal)),
                              without_signs_of_zeros(vulkan));
        !same)
        return same;
    if (auto sign = turns_sign(gl, vulkan); !sign) return sign;
    return same_bits(vulkan, d3d);
}

/// Without the bits of what comes from differences.
testing::AssertionResult odd_frames_agree(const Renderer& renderer, const MakeScene& make) {
    const std::vector<std::string> interpolated = {"A", "P", "uv", "Ng", "id", "bary"};
    const Film gl = take(renderer, make(Conventions::gl), interpolated);
    const Film vulkan = take(renderer, make(Conventions::vulkan), interpolated);
    const Film d3d = take(renderer, make(Conventions::d3d), interpolated);
    if (auto same = same_bits(gl, vulkan); !same) return same;
    return same_bits(vulkan, d3d);
}

Scene even(Conventions conventions) {
    Scene scene = varied_scene(1, conventions, 36, 28);
    scene.objects[1].material = 0;  // not the published relief
    return scene;
}
Scene odd(Conventions conventions) { return varied_scene(1, conventions, 37, 27); }

MakeScene installed(const std::string& name) {
    return [name](Conventions conventions) {
        const char* const names[] = {"gl", "vulkan", "d3d"};
        return load_scene(name, {"size=[20,14]", std::string("conventions=\"") +
                                                     names[static_cast<int>(conventions)] + "\""});
    };
}

TEST(Conventions, GiveOnePictureOnEvenFrames) {
    EXPECT_TRUE(even_frames_agree(render, even));
    EXPECT_TRUE(even_frames_agree(render, installed("thesis-teapot")));
    EXPECT_TRUE(even_frames_agree(render, installed("thesis-quad-published"),
                                  {"N", "R", "G", "B", "light"}));
}

TEST(Conventions, GiveOneVisibilityOnOddFrames) { EXPECT_TRUE(odd_frames_agree(render, odd)); }

TEST(Conventions, ErrorsAreNoticed) {
    EXPECT_TRUE(even_frames_agree(with(Planted::none), even));
    EXPECT_FALSE(even_frames_agree(with(Planted::picture_upside_down), even));
    EXPECT_FALSE(even_frames_agree(with(Planted::derivatives_of_image), even));
    EXPECT_FALSE(odd_frames_agree(with(Planted::picture_upside_down), odd));
}

/// Edges through pixel centres: the row at the smallest window y is in, so the picture of gl is
/// that of the others turned over.
TEST(Conventions, FillRuleIsTheWindows) {
    const auto film = [](Conventions conventions) {
        Scene scene = empty_scene(8, 8);
        scene.conventions = conventions;
        set_pixel_camera(scene);
        scene.materials = {plain_material("white", glm::vec3(1))};
        add_object(scene, rectangle(-2.5f, -1.5f, 2.5f, 1.5f, -2), 0);
        return take(render, scene, {"A"});
    };
    const Film gl = film(Conventions::gl), vulkan = film(Conventions::vulkan);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            const bool column = x >= 1 && x < 6;  // left edge in, right edge out
            EXPECT_EQ(value(gl, "A", x, y), column && y >= 3 && y < 6) << x << "," << y;
            EXPECT_EQ(value(vulkan, "A", x, y), column && y >= 2 && y < 5) << x << "," << y;
        }
    EXPECT_TRUE(same_bits(vulkan, film(Conventions::d3d)));
}

/// What nothing covers: the background, A 0, Z +inf, no object, zeros.
testing::AssertionResult uncovered_is_empty(const Renderer& renderer, const Scene& scene) {
    const Film film = take(renderer, scene, all_channels(scene));
    const auto uncovered = [&](int x, int y) { return value(film, "A", x, y) == 0; };
    return everywhere(film, uncovered, [&](int x, int y) -> std::string {
        for (const Plane& plane : film.planes) {
            const std::string& name = plane.name;
            std::uint32_t expected = 0;
            for (int c = 0; c < 3; ++c)
                if (name == std::string(1, "RGB"[c]))
                    expected = std::bit_cast<std::uint32_t>(scene.background[c]);
            if (name == "Z") expected = 0x7f800000u;
            if (name.rfind("id.", 0) == 0) expected = 0xffffffffu;
            if (plane.bits[film.index(x, y)] != expected) return name + " is not empty";
        }
        return {};
    });
}

TEST(Uncovered, IsBackground) {
    EXPECT_TRUE(uncovered_is_empty(render, varied_scene()));
    EXPECT_TRUE(uncovered_is_empty(render, varied_scene(4)));
    Scene nothing = empty_scene(5, 3);
    set_pixel_camera(nothing);
    EXPECT_TRUE(uncovered_is_empty(render, nothing));
}

TEST(Uncovered, ErrorsAreNoticed) {
    for (const Planted error :
         {Planted::uncovered_is_black, Planted::uncovered_z_zero, Planted::uncovered_object_zero})
        EXPECT_FALSE(uncovered_is_empty(with(error), varied_scene())) << static_cast<int>(error);
}

}  // namespace
}  // namespace quadrel::render_tests
