// Shading in double: the same fragments, values that differ by rounding except where a decision
// falls the other way. NaNs are one value.
#include <set>

#include "quadrel/error.hpp"
#include "quadrel/scene/load.hpp"
#include "render/planted.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

Film in_double(const Renderer& renderer, const Scene& scene,
               const std::vector<std::string>& channels) {
    RenderOptions options;
    options.channels = channels;
    options.number = "double";
    return renderer(scene, options);
}

/// Decisions of the front end are shared: coverage, visible triangles and depth.
const std::vector<std::string> front_end = {"A", "depth", "id", "quad"};
/// Decisions of a march.
const std::vector<std::string> decisions = {"hit.status", "hit.steps", "shadow.0.steps"};
const std::vector<std::string> smooth = {"P",     "uv",    "N", "dUVdx", "K", "hit.U",
                                         "hit.V", "hit.s", "R", "G",     "B", "Z"};

bool decide_alike(const Film& a, const Film& b, int x, int y) {
    return std::all_of(decisions.begin(), decisions.end(), [&](const std::string& name) {
        return bits(a, name, x, y) == bits(b, name, x, y);
    });
}

/// Relative to 1: values here are of that size.
bool nearly_equal(float a, float b) {
    return a == b || std::abs(a - b) <= 2e-4f * std::max(1.0f, std::abs(a));
}

struct Tally {
    int covered = 0, decided_otherwise = 0, off = 0, rounded = 0;
};

Tally tally_of(const Film& in_float, const Film& other) {
    Tally tally;
    for (int y = 0; y < in_float.window.y1; ++y)
        for (int x = 0; x < in_float.window.x1; ++x) {
            if (value(in_float, "A", x, y) == 0) continue;
            ++tally.covered;
            if (!decide_alike(in_float, other, x, y)) {
                ++tally.decided_otherwise;
                continue;
            }
            bool near = true, equal = true;
            for (const Plane& plane : in_float.planes) {
                if (plane.type == ChannelType::uint32) continue;
                const float a = value(in_float, plane.name, x, y);
                const float b = value(other, plane.name, x, y);
                near = near && nearly_equal(a, b);
                equal = equal && a == b;
            }
            tally.off += !near;
            tally.rounded += !equal;
        }
    return tally;
}

/// At most 3 pixels in 100 may decide otherwise, as many may lie at an edge of a texel or of the
/// shading that rounding moves them over; and some bits must differ, or it was not double.
testing::AssertionResult differs_by_rounding(const Renderer& renderer, const Scene& scene) {
    auto channels = front_end;
    channels.insert(channels.end(), decisions.begin(), decisions.end());
    const Film fixed = take(render, scene, front_end);
    if (auto same = same_bits(fixed, in_double(renderer, scene, front_end)); !same) return same;
    channels.insert(channels.end(), smooth.begin(), smooth.end());
    const Film in_float = take(render, scene, channels);
    const Tally tally = tally_of(in_float, in_double(renderer, scene, channels));
    if (tally.rounded > 0 && 100 * tally.decided_otherwise <= 3 * tally.covered &&
        100 * tally.off <= 3 * tally.covered)
        return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << fmt::format("{} covered, {} decided otherwise, {} off, {} rounded otherwise",
                          tally.covered, tally.decided_otherwise, tally.off, tally.rounded);
}

TEST(Double, DiffersFromFloatByRounding) {
    for (const char* name : {"thesis-quad", "thesis-sphere", "spikes-60", "thesis-quad-published"})
        EXPECT_TRUE(differs_by_rounding(render, load_scene(name, {"size=[26,20]"}))) << name;
}

TEST(Double, ErrorsAreNoticed) {
    const Scene scene = load_scene("thesis-quad", {"size=[26,20]"});
    EXPECT_FALSE(differs_by_rounding(with(Planted::float_as_double), scene));
    EXPECT_FALSE(differs_by_rounding(with(Planted::uncovered_object_zero), scene));
}

/// A scene whose texture coordinates overflow: infinite at two corners of its quad.
Scene overflowing_scene() {
    Scene scene = varied_scene();
    scene.materials[0].texture_matrix[0][0] = 3e38f;
    scene.materials[0].texture_matrix[0][1] = 3e38f;
    scene.materials[0].texture_matrix[3][0] = 3e38f;
    return scene;
}

bool is_nan(std::uint32_t bits) { return (bits & 0x7fffffffu) > 0x7f800000u; }

/// There are NaNs, and each is the canonical one.
testing::AssertionResult nans_are_canonical(const Renderer& renderer, const std::string& number) {
    const Scene scene = overflowing_scene();
    const auto channels = all_channels(scene);
    const Film film =
        number == "double" ? in_double(renderer, scene, channels) : take(renderer, scene, channels);
    std::set<std::uint32_t> seen;
    for (const Plane& plane : film.planes)
        if (plane.type == ChannelType::float32)
            std::copy_if(plane.bits.begin(), plane.bits.end(), std::inserter(seen, seen.end()),
                         is_nan);
    if (seen == std::set<std::uint32_t>{canonical_nan}) return testing::AssertionSuccess();
    return testing::AssertionFailure() << seen.size() << " kinds of NaN";
}

TEST(NotANumber, IsOneValue) {
    for (const char* number : {"float", "double"}) {
        EXPECT_TRUE(nans_are_canonical(render, number)) << number;
        EXPECT_FALSE(nans_are_canonical(with(Planted::nan_payload), number));
    }
}

TEST(Film, HasTheWindowsSizeAndTheTablesTypes) {
    for (const char* number : {"float", "double"})
        for (const int samples : {1, 4}) {
            const Scene scene = varied_scene(samples);
            RenderOptions options;
            options.channels = all_channels(scene);
            options.number = number;
            options.window = Window{3, 5, 20, 16};
            const Film film = render(scene, options);
            EXPECT_EQ(film.frame, (Window{0, 0, scene.width, scene.height}));
            EXPECT_EQ(film.window, *options.window);
            ASSERT_EQ(film.planes.size(), options.channels.size());
            for (std::size_t i = 0; i < film.planes.size(); ++i) {
                EXPECT_EQ(film.planes[i].name, options.channels[i]);
                EXPECT_EQ(film.planes[i].type, find_channel(options.channels[i])->type);
                EXPECT_EQ(film.planes[i].bits.size(), options.window->area());
            }
        }
}

}  // namespace
}  // namespace quadrel::render_tests
