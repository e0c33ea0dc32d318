// A displaced square is what the judge sees in its relief: the same first hits, by triangles on the
// one hand and by rays on the other.
#include "quadrel/scene/displace.hpp"
#include "quadrel/scene/refine.hpp"
#include "quadrel/texture/of_texels.hpp"
#include "render/draw/geometry.hpp"
#include "render/films.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

constexpr int noise_texels = 16;
constexpr double square_depth = 0.3;

struct SplitOfJudge {
    CellSplit split;
    const char* trace;
};
constexpr SplitOfJudge splits[] = {{CellSplit::main, "oracle-tri-main"},
                                   {CellSplit::anti, "oracle-tri-anti"},
                                   {CellSplit::min, "oracle-tri-min"}};

Mesh displaced_square(CellSplit split) {
    std::vector<float> heights;
    for (int y = 0; y < noise_texels; ++y)
        for (int x = 0; x < noise_texels; ++x)
            heights.push_back(static_cast<float>(noise(x, y, 1)));
    const SampledTexture map = texture_of_texels(heights, noise_texels, noise_texels);
    Displacement displacement;
    displacement.heights = &map;
    displacement.depth = square_depth;
    displacement.split = split;
    return displaced(make_quad(2, 1, 1), displacement);
}

Scene square_scene(double degrees) {
    Scene scene = empty_scene(96, 80);
    set_perspective_camera(scene, {0.2, -0.1, 3}, {.near = 1, .far = 20});
    scene.lights = {Light()};
    scene.materials = {relief_material("relief", false)};
    scene.materials[0].frame = stage("frame-face", "frame");
    scene.materials[0].depth = static_cast<float>(square_depth);
    add_object(scene, make_quad(2, 1, 1), 0, rotation(degrees, {1, 0.3, 0}));
    return scene;
}

/// Of the pixels whose ray meets the relief of the square itself, how many see another point of the
/// mesh, by more than a hundredth of a texel.
double share_that_differs(double degrees, const char* trace, CellSplit split) {
    Scene scene = square_scene(degrees);
    scene.materials[0].trace = stage(trace, "trace");
    const Film relief = take(render, scene, {"hit.U", "hit.V", "hit.status", "A"});
    scene.materials[0] = plain_material("plain");
    scene.meshes[0] = displaced_square(split);
    const Film mesh = take(render, scene, {"uv.U", "uv.V", "A"});
    int all = 0, other = 0;
    for (int y = 0; y < scene.height; ++y)
        for (int x = 0; x < scene.width; ++x) {
            const float u = value(relief, "hit.U", x, y), v = value(relief, "hit.V", x, y);
            const bool within = u > 0 && u < 1 && v > 0 && v < 1;
            if (value(relief, "A", x, y) == 0 || bits(relief, "hit.status", x, y) != 1 || !within)
                continue;
            ++all;
            const double off = std::max(std::abs(value(mesh, "uv.U", x, y) - u),
                                        std::abs(value(mesh, "uv.V", x, y) - v));
            other += value(mesh, "A", x, y) == 0 || !(off * noise_texels < 0.01);
        }
    EXPECT_GT(all, 700);
    return static_cast<double>(other) / all;
}

TEST(DisplacedMesh, IsWhatTheJudgeSeesInTheRelief) {
    for (const double degrees : {0.0, 40.0, -65.0})
        for (const SplitOfJudge& pair : splits)
            EXPECT_LT(share_that_differs(degrees, pair.trace, pair.split), 0.003)
                << degrees << " " << pair.trace;
}

TEST(DisplacedMesh, AnotherSplitIsNoticed) {
    EXPECT_GT(share_that_differs(40, "oracle-tri-main", CellSplit::anti), 0.2);
    EXPECT_GT(share_that_differs(40, "oracle-tri-min", CellSplit::main), 0.05);
}

// ---- Of a mesh much finer than the picture
// ---------------------------------------------------------

/// Of each triangle of the mesh that covers any, the samples, in their order.
std::vector<std::array<int, 4>> covered_samples(const Scene& scene, const Geometry& geometry) {
    std::vector<std::array<int, 4>> found;
    for (const DrawnTriangle& triangle : geometry.triangles) {
        const PixelRect& bounds = triangle.screen.bounds;
        for (int y = bounds.y0; y < bounds.y1; ++y)
            for (int x = bounds.x0; x < bounds.x1; ++x)
                if (const int mask = coverage_mask(triangle.screen, x, y, scene.samples); mask != 0)
                    found.push_back({static_cast<int>(triangle.primitive), x, y, mask});
    }
    return found;
}

Scene fine_scene(int samples) {
    Scene scene = square_scene(40);
    scene.samples = samples;
    scene.width = scene.height = 24;
    scene.materials = {plain_material("plain")};
    scene.meshes[0] = refined_by_curvature(displaced_square(CellSplit::main), 3);
    return scene;
}

/// What is kept covers every sample that all triangles cover.
TEST(DisplacedMesh, TrianglesBetweenTheSamplesAreNotKept) {
    for (const int samples : {1, 4}) {
        const Scene scene = fine_scene(samples);
        const HardwareModel hardware = scene_hardware(scene);
        const Geometry kept = assemble_geometry(scene, hardware);
        GeometryParts parts;
        parts.all_triangles = true;
        const Geometry all = assemble_geometry(scene, hardware, parts);
        EXPECT_EQ(all.triangles.size(), all.counts.drawn);
        EXPECT_EQ(kept.counts, all.counts);
        EXPECT_LT(kept.triangles.size(), all.triangles.size() / (samples == 1 ? 4 : 2));
        EXPECT_EQ(covered_samples(scene, kept), covered_samples(scene, all));
    }
}

}  // namespace
}  // namespace quadrel::render_tests
