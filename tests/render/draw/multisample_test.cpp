// Multisampling against an oracle that tests every sample of every triangle in integers.
#include <optional>

#include "quadrel/raster/samples.hpp"
#include "render/planted.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

/// A triangle at a constant depth. Corners in 1/256 pixel from the frame's bottom-left corner; odd
/// numbers, so that no sample (all at even ones) lies on a corner.
struct Shape {
    int x[3], y[3];
    float z;
    glm::vec3 color;  // dyadic: sums of up to 16 are exact
};

constexpr int width = 12, height = 10;

const Shape shapes[] = {
    {{261, 2511, 901}, {303, 1211, 2305}, -2, {1.0f, 0.5f, 0.25f}},
    {{1001, 2903, 1503}, {205, 1507, 2401}, -3, {0.0f, 0.75f, 2.0f}},
    {{1, 1703, 333}, {2, 77, 1451}, -4, {0.5f, 0.0f, 1.0f}},
};

Scene scene_of_shapes(int samples, bool centroid) {
    Scene scene = empty_scene(width, height);
    scene.samples = samples;
    scene.centroid = centroid;
    set_pixel_camera(scene);
    for (const Shape& s : shapes) {
        scene.materials.push_back(
            plain_material("m" + std::to_string(scene.objects.size()), s.color));
        const auto corner = [&](int i) {
            return glm::vec3(s.x[i] / 256.0f - width / 2.0f, s.y[i] / 256.0f - height / 2.0f, s.z);
        };
        add_object(scene, triangle(corner(0), corner(1), corner(2)), scene.objects.size());
    }
    return scene;
}

/// Whether the point (1/256 pixel) is inside; it must not lie on an edge.
bool inside(const Shape& s, int x, int y) {
    int positive = 0;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const std::int64_t e = std::int64_t(s.x[j] - s.x[i]) * (y - s.y[i]) -
                               std::int64_t(s.y[j] - s.y[i]) * (x - s.x[i]);
        EXPECT_NE(e, 0) << "a sample on an edge: the oracle has no fill rule";
        positive += e > 0;
    }
    return positive == 0 || positive == 3;
}

/// What one pixel should be. Coordinates are in the window: y up.
struct Expected {
    float a = 0, z = std::numeric_limits<float>::infinity();
    glm::vec3 color{0};
    float depth = 0;        ///< of the lowest covered sample
    int object = -1;        ///< of the lowest covered sample
    double px = 0, py = 0;  ///< where its attributes are evaluated, in pixels
};

std::optional<int> visible_at(int x, int y) {
    for (int i = 0; i < 3; ++i)  // nearest first
        if (inside(shapes[i], x, y)) return i;
    return {};
}

/// The pixel's centre, or, for a partly covered one, the lowest sample that the shape covers.
void place(Expected& e, const Shape& shape, int x, int y, int samples, bool centroid) {
    e.px = x + 0.5;
    e.py = y + 0.5;
    if (!centroid) return;
    const auto positions = sample_positions(samples);
    int covered = 0;
    std::optional<SamplePosition> lowest;
    for (const SamplePosition& p : positions)
        if (inside(shape, 256 * x + 16 * p.x, 256 * y + 16 * p.y)) {
            ++covered;
            if (!lowest) lowest = p;
        }
    if (covered == samples || !lowest) return;
    e.px = x + lowest->x / 16.0;
    e.py = y + lowest->y / 16.0;
}

Expected expected_at(int x, int y, int samples, bool centroid) {
    Expected e;
    const glm::vec3 background(0.25f, 0.5f, 0.125f);
    for (const SamplePosition& p : sample_positions(samples)) {
        const auto visible = visible_at(256 * x + 16 * p.x, 256 * y + 16 * p.y);
        e.color += visible ? shapes[*visible].color : background;
        if (!visible) continue;
        e.a += 1;
        e.z = std::min(e.z, -shapes[*visible].z);
        if (e.object >= 0) continue;
        e.object = *visible;
        e.depth = (-shapes[*visible].z - 1) / 8;  // near 1, far 9
    }
    e.a /= static_cast<float>(samples);
    e.color /= static_cast<float>(samples);
    if (e.object >= 0) place(e, shapes[e.object], x, y, samples, centroid);
    return e;
}

std::string pixel_differs(const Film& film, int x, int y, const Expected& e) {
    const auto exact = [&](const char* channel, float expected) {
        return differs(channel, value(film, channel, x, y), expected, 0);
    };
    for (const std::string& complaint :
         {exact("A", e.a), exact("R", e.color.r), exact("G", e.color.g), exact("B", e.color.b),
          differs("Z", value(film, "Z", x, y), e.z, 1e-6),
          differs("depth", value(film, "depth", x, y), e.depth, 1e-6)})
        if (!complaint.empty()) return complaint;
    if (bits(film, "id.object", x, y) != static_cast<std::uint32_t>(e.object))
        return fmt::format("id.object is {}, expected {}", bits(film, "id.object", x, y), e.object);
    if (e.object < 0) return {};
    const auto px = differs("P.X", value(film, "P.X", x, y), e.px - width / 2.0, 1e-5);
    return px.empty() ? differs("P.Y", value(film, "P.Y", x, y), e.py - height / 2.0, 1e-5) : px;
}

testing::AssertionResult resolves(const Renderer& renderer, int samples, bool centroid) {
    const Film film = take(renderer, scene_of_shapes(samples, centroid),
                           {"R", "G", "B", "A", "Z", "depth", "id", "P"});
    return everywhere(film, {},
                      [&](int x, int y) {
                          return pixel_differs(film, x, y,
                                               expected_at(x, height - 1 - y, samples, centroid));
                      })
           << " (" << samples << " samples" << (centroid ? ", centroid)" : ")");
}

class Multisampling : public testing::TestWithParam<int> {};

TEST_P(Multisampling, ResolvesWhatItsSamplesSee) {
    EXPECT_TRUE(resolves(render, GetParam(), false));
    EXPECT_TRUE(resolves(render, GetParam(), true));
}

INSTANTIATE_TEST_SUITE_P(Samples, Multisampling, testing::Values(1, 2, 4, 8, 16));

TEST(MultisamplingErrors, AreNoticed) {
    EXPECT_TRUE(resolves(with(Planted::none), 4, true));
    for (const Planted error :
         {Planted::one_sample, Planted::background_left_out, Planted::farthest_z,
          Planted::fragment_of_centre, Planted::centre_for_centroid, Planted::uncovered_z_zero})
        EXPECT_FALSE(resolves(with(error), 4, true)) << static_cast<int>(error);
}

/// Coverage of the samples adds up: a picture cut into two triangles along any line is covered as
/// often as the whole.
TEST(Multisampling, SharedEdgesCoverOnce) {
    for (const int samples : {1, 2, 4, 8, 16}) {
        Scene scene = empty_scene(9, 7);
        scene.samples = samples;
        set_pixel_camera(scene);
        scene.materials = {plain_material("white", glm::vec3(1))};
        add_object(scene, rectangle(-4.5f, -3.5f, 4.5f, 3.5f, -2), 0, rotation(0, {0, 0, 1}));
        const Film film = take(render, scene);
        EXPECT_TRUE(everywhere(film, {}, [&](int x, int y) {
            return differs("A", value(film, "A", x, y), 1, 0) +
                   differs("R", value(film, "R", x, y), 1, 0);
        }));
    }
}

}  // namespace
}  // namespace quadrel::render_tests
