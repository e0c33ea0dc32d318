// Shells as they are drawn: without cracks, equal to the mesh where there is no relief, and as the
// displaced mesh where there is.
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "effort.hpp"
#include "quadrel/scene/displace.hpp"
#include "quadrel/texture/of_texels.hpp"
#include "render/films.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

constexpr float shell_depth = 0.2f;
/// Pixels along a side of the pictures that take longest.
constexpr int silhouette_size = test::sanitized ? 40 : 112;

/// Everywhere the same height.
TextureReference level_texture(double level) {
    TextureReference reference = texture(
        write_texture(fmt::format("level-{}.exr", level), 4, [=](int, int, int) { return level; }));
    reference.sampler.mip = MipFilter::none;
    return reference;
}

Scene shell_scene(const Mesh& mesh, const TextureReference& heights, int size,
                  const glm::dmat4& transform = glm::dmat4(1.0)) {
    Scene scene = empty_scene(size, size);
    set_perspective_camera(scene, {0.3, -0.2, 3}, {.near = 0.5, .far = 20});
    scene.materials = {plain_material("shell", {1, 1, 1})};
    Material& material = scene.materials[0];
    material.frame = stage("frame-shell", "frame");
    material.trace = stage("prism-exact", "trace");
    material.frag_depth = stage("frag-depth", "frag_depth");
    material.depth = shell_depth;
    material.textures["height"] = heights;
    add_object(scene, mesh, 0, transform);
    return scene;
}

/// The mesh in place of its shell, moved along its normals.
Scene plain_scene(Scene scene, double offset) {
    scene.materials = {plain_material("plain", {1, 1, 1})};
    Mesh& mesh = scene.meshes[0];
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        mesh.positions[i] += glm::normalize(mesh.normals[i]) * static_cast<float>(offset);
    return scene;
}

const std::vector<std::string> shape_channels = {"A", "Z"};

/// A wound sphere, so that no edge of it lies along rows of pixels.
const glm::dmat4 wound = rotation(25, {1, 2, 0.5});

// ---- No cracks ----------------------------------------------------------------------------------

/// A level surface in the shell covers what the shell's bottom does and no more than its top, and
/// lies between both; no ray begins below it by more than what a ray's place in a pixel can be off.
testing::AssertionResult has_no_cracks(double level, double seat, double lower = 0) {
    Scene scene = shell_scene(make_sphere(1, 16, 10), level_texture(level), silhouette_size, wound);
    scene.materials[0].seat = static_cast<float>(seat);
    const Film film = take(render, scene, {"A", "Z", "hit.s", "hit.h"});
    // The chords of the level's own triangles lie above those of any lower level.
    const auto at = [&](double layer) {
        return take(render, plain_scene(scene, (layer - seat) * shell_depth), shape_channels);
    };
    const Film bottom = at(0.0), top = at(1.0);
    int at_outlines = 0;
    for (int y = 0; y < scene.height; ++y)
        for (int x = 0; x < scene.width; ++x) {
            const bool drawn = value(film, "A", x, y) > 0;
            if (!drawn && value(bottom, "A", x, y) > 0)
                return testing::AssertionFailure() << "a hole at " << x << "," << y;
            if (drawn && value(top, "A", x, y) == 0)
                return testing::AssertionFailure() << "outside at " << x << "," << y;
            if (!drawn) continue;
            // Rays are a fraction of a pixel apart in neighbouring tetrahedra (their corners are
            // snapped): at an outline one may pass what the next one meets.
            const double z = value(film, "Z", x, y);
            at_outlines += z < value(top, "Z", x, y) - 1e-3 ||
                           (value(bottom, "A", x, y) > 0 && z > value(bottom, "Z", x, y) + 1e-3);
            const double s = value(film, "hit.s", x, y);
            if (std::abs(1 - s - level + lower) > 0.01)
                return testing::AssertionFailure()
                       << "met at height " << 1 - s << " at " << x << "," << y;
        }
    if (at_outlines <= 4) return testing::AssertionSuccess();
    return testing::AssertionFailure() << at_outlines << " not in the shell";
}

TEST(Silhouettes, HaveNoCracks) {
    const std::pair<double, double> levels_and_seats[] = {{0, 1}, {0.3, 0}, {0.9, 0.5}, {0.6, 1}};
    for (const auto& [level, seat] : levels_and_seats)
        EXPECT_TRUE(has_no_cracks(level, seat)) << level << " " << seat;
    EXPECT_FALSE(has_no_cracks(0.5, 1, 0.05));
}

// ---- Without relief -----------------------------------------------------------------------------

/// Coverage of the same bits, depths that are as near as float has them.
testing::AssertionResult looks_like(const Film& film, const Film& mesh, double tolerance) {
    if (auto same = same_bits(with_planes(mesh, {"A"}), with_planes(film, {"A"})); !same)
        return same;
    return everywhere(mesh, covered(mesh), [&](int x, int y) {
        return differs("Z", value(film, "Z", x, y), value(mesh, "Z", x, y), tolerance);
    });
}

TEST(Silhouettes, WithoutDepthAreTheMesh) {
    for (const Mesh& mesh : {make_sphere(1, 12, 8), make_quad(1.5, 3, 2), make_torus(0.3, 0.7)}) {
        Scene scene = shell_scene(mesh, noise_texture("g"), 64, wound);
        scene.materials[0].depth = 0;
        const std::vector<std::string> channels = {"A", "Z", "uv", "N", "hit"};
        const Film film = take(render, scene, channels);
        scene.materials[0].frame.id = "frame-gram";
        scene.materials[0].trace.id = "trace-none";
        const Film plain = take(render, scene, channels);
        EXPECT_TRUE(looks_like(film, plain, 1e-6));
        const std::vector<std::string> same = {"uv.U", "uv.V", "N.X", "N.Y", "N.Z", "hit.U"};
        EXPECT_TRUE(same_bits(with_planes(plain, same), with_planes(film, same), covered(plain)));
    }
}

/// Heights of 1 are the top of the shell; over a seat of 1 that is the mesh.
TEST(Silhouettes, FlatReliefIsTheMesh) {
    for (const Mesh& mesh : {make_sphere(1, 12, 8), make_torus(0.3, 0.7)}) {
        const Scene scene = shell_scene(mesh, level_texture(1), 96, wound);
        const Film film = take(render, scene, shape_channels);
        EXPECT_TRUE(looks_like(film, take(render, plain_scene(scene, 0), shape_channels), 1e-5));
        const Film lower = take(render, plain_scene(scene, -0.02), shape_channels);
        EXPECT_FALSE(looks_like(film, lower, 1e-5));
    }
}

// ---- Where the mesh lies ------------------------------------------------------------------------

/// Another seat over a mesh that is moved the other way is the same shell.
TEST(Silhouettes, SeatMovesTheMeshInTheShell) {
    Scene scene = shell_scene(make_sphere(1, 16, 10), noise_texture("g"), 96, wound);
    const Film inset = take(render, scene, shape_channels);
    for (const double seat : {0.0, 0.5}) {
        Scene moved = scene;
        moved.materials[0].seat = static_cast<float>(seat);
        Mesh& mesh = moved.meshes[0];
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            mesh.positions[i] -=
                glm::normalize(mesh.normals[i]) * static_cast<float>((1 - seat) * shell_depth);
        const Film other = take(render, moved, shape_channels);
        int off = 0, drawn = 0;
        for (int y = 0; y < scene.height; ++y)
            for (int x = 0; x < scene.width; ++x) {
                drawn += value(inset, "A", x, y) > 0;
                off += value(inset, "A", x, y) != value(other, "A", x, y) ||
                       (value(inset, "A", x, y) > 0 &&
                        std::abs(value(inset, "Z", x, y) - value(other, "Z", x, y)) > 1e-3);
            }
        EXPECT_GT(drawn, 2000);
        EXPECT_LE(off, drawn / 100);
    }
}

/// Mirrored before a camera on the axis: the mirrored picture.
TEST(Silhouettes, AreMirrored) {
    const auto film_of = [](double mirror) {
        Scene scene = shell_scene(make_torus(0.3, 0.7, 8, 12), noise_texture("g"), 64,
                                  scaling({mirror, 1, 1}) * wound);
        set_perspective_camera(scene, {0, 0, 3}, {.near = 0.5, .far = 20});
        return take(render, scene, shape_channels);
    };
    const Film film = film_of(1), other = film_of(-1);
    int off = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            off += value(film, "A", x, y) != value(other, "A", 63 - x, y) ||
                   (value(film, "A", x, y) > 0 &&
                    std::abs(value(film, "Z", x, y) - value(other, "Z", 63 - x, y)) > 1e-3);
    EXPECT_LE(off, 20);
}

// ---- Against the displaced mesh -----------------------------------------------------------------

constexpr int bumpy_texels = 16;

TextureReference bumpy_texture() {
    TextureReference reference = texture(write_texture(
        "bumpy.exr", bumpy_texels, [](int x, int y, int) { return 0.25 + 0.5 * noise(x, y, 1); }));
    reference.sampler.mip = MipFilter::none;
    return reference;
}

Mesh bumpy_mesh(const Mesh& mesh, CellSplit split) {
    std::vector<float> heights;
    for (int y = 0; y < bumpy_texels; ++y)
        for (int x = 0; x < bumpy_texels; ++x)
            heights.push_back(static_cast<float>(0.25 + 0.5 * noise(x, y, 1)));
    const SampledTexture map = texture_of_texels(heights, bumpy_texels, bumpy_texels);
    Displacement displacement;
    displacement.heights = &map;
    displacement.depth = shell_depth;
    displacement.split = split;
    return displaced(mesh, displacement);
}

double bumpy_height(int x, int y) {
    const auto wrapped = [](int i) { return (i % bumpy_texels + bumpy_texels) % bumpy_texels; };
    return 0.25 + 0.5 * noise(wrapped(x), wrapped(y), 1);
}

/// Two triangles a cell, along the main diagonal.
double bumpy_surface(const glm::dvec2& uv) {
    const double x = uv.x * bumpy_texels - 0.5, y = uv.y * bumpy_texels - 0.5;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    const double f = x - i, g = y - j;
    const double h00 = bumpy_height(i, j), h11 = bumpy_height(i + 1, j + 1);
    const double other = f > g ? bumpy_height(i + 1, j) : bumpy_height(i, j + 1);
    return h00 + (other - h00) * std::max(f, g) + (h11 - other) * std::min(f, g);
}

/// Every hit lies where the displaced mesh has its texture coordinates, but for what
/// shell_face.hpp says of tetrahedra. `planted` is added to the heights.
testing::AssertionResult hits_are_on_the_displaced_mesh(const Mesh& mesh, double planted = 0) {
    Scene scene = shell_scene(mesh, bumpy_texture(), silhouette_size, wound);
    scene.materials[0].trace.parameters["surface"] = 1;
    const Film film =
        take(render, scene, {"A", "hit.U", "hit.V", "hit.P", "hit.s", "hit.h", "hit.flags", "id"});
    const glm::dmat4 to_object =
        glm::inverse(glm::dmat4(scene.camera.view) * glm::dmat4(scene.objects[0].transform));
    int seen = 0;
    for (int y = 0; y < scene.height; ++y)
        for (int x = 0; x < scene.width; ++x) {
            if (value(film, "A", x, y) == 0) continue;
            const auto& corner = mesh.triangles[bits(film, "id.primitive", x, y)];
            std::array<glm::dvec2, 3> uv;
            std::array<glm::dvec3, 3> position, normal;
            for (std::size_t k = 0; k < 3; ++k) {
                uv[k] = mesh.uvs[corner[k]];
                position[k] = mesh.positions[corner[k]];
                normal[k] = glm::normalize(glm::dvec3(mesh.normals[corner[k]]));
            }
            const glm::dvec2 hit(value(film, "hit.U", x, y), value(film, "hit.V", x, y));
            const auto area = [](const glm::dvec2& a, const glm::dvec2& b) {
                return a.x * b.y - a.y * b.x;
            };
            const double whole = area(uv[1] - uv[0], uv[2] - uv[0]);
            // Around a pole coordinates jump from triangle to triangle, and heights with them.
            const bool at_pole = std::ranges::any_of(
                normal, [](const glm::dvec3& v) { return std::abs(v.z) > 1 - 1e-9; });
            if (at_pole) continue;
            const double b = area(hit - uv[0], uv[2] - uv[0]) / whole;
            const double c = area(uv[1] - uv[0], hit - uv[0]) / whole, a = 1 - b - c;
            const double offset = (bumpy_surface(hit) + planted - 1) * shell_depth;
            const glm::dvec3 expected = position[0] * a + position[1] * b + position[2] * c +
                                        (normal[0] * a + normal[1] * b + normal[2] * c) * offset;
            const glm::dvec3 found(to_object * glm::dvec4(value(film, "hit.P.X", x, y),
                                                          value(film, "hit.P.Y", x, y),
                                                          value(film, "hit.P.Z", x, y), 1));
            double bound = 0;
            for (std::size_t k = 0; k < 3; ++k)
                bound = std::max(bound, glm::distance(normal[k], normal[(k + 1) % 3]));
            ++seen;
            // A ray that begins below the surface by what rounding and snapping let through is met
            // where it enters.
            if (glm::distance(found, expected) > shell_depth * (0.25 * bound + 0.005))
                return testing::AssertionFailure()
                       << glm::distance(found, expected) << " off at " << x << "," << y
                       << ", height " << value(film, "hit.h", x, y) << " at "
                       << 1 - value(film, "hit.s", x, y) << ", flags "
                       << bits(film, "hit.flags", x, y);
        }
    return seen > silhouette_size * silhouette_size / 8 ? testing::AssertionSuccess()
                                                        : testing::AssertionFailure() << seen;
}

TEST(Silhouettes, HitsAreOnTheDisplacedMesh) {
    if (test::sanitized) GTEST_SKIP() << "pixels are so large that snapping lets through too much";
    for (const Mesh& mesh :
         {make_sphere(1, 12, 8), make_sphere(1, 48, 32), make_torus(0.3, 0.7, 24, 36)}) {
        EXPECT_TRUE(hits_are_on_the_displaced_mesh(mesh));
        EXPECT_FALSE(hits_are_on_the_displaced_mesh(mesh, 0.2));
    }
}

/// Shares of the pixels: those that one of both alone covers, and those whose depths differ by more
/// than a tenth of the shell.
struct Departure {
    double coverage, depth;
};

Departure departure_from_mesh(const Mesh& mesh, CellSplit split, int slices) {
    Scene scene = shell_scene(mesh, bumpy_texture(), silhouette_size, wound);
    scene.materials[0].trace.parameters["surface"] = 1;
    const Film film = take(render, scene, shape_channels);
    scene.materials = {plain_material("plain", {1, 1, 1})};
    scene.meshes[0] = bumpy_mesh(mesh, split);
    const Film truth = take(render, scene, shape_channels);
    int all = 0, coverage = 0, depth = 0;
    for (int y = 0; y < scene.height; ++y)
        for (int x = 0; x < scene.width; ++x) {
            const bool a = value(film, "A", x, y) > 0, b = value(truth, "A", x, y) > 0;
            all += a || b;
            coverage += a != b;
            depth += a && b &&
                     std::abs(value(film, "Z", x, y) - value(truth, "Z", x, y)) > 0.1 * shell_depth;
        }
    testing::Test::RecordProperty(fmt::format("coverage_{}", slices), std::to_string(coverage));
    testing::Test::RecordProperty(fmt::format("depth_{}", slices), std::to_string(depth));
    return {double(coverage) / all, double(depth) / all};
}

TEST(Silhouettes, AreThoseOfTheDisplacedMesh) {
    const Departure coarse = departure_from_mesh(make_sphere(1, 12, 8), CellSplit::main, 12);
    const Departure fine = departure_from_mesh(make_sphere(1, 48, 32), CellSplit::main, 48);
    const Departure torus = departure_from_mesh(make_torus(0.3, 0.7, 24, 36), CellSplit::main, 36);
    EXPECT_LT(coarse.coverage, 0.015);
    EXPECT_LT(coarse.depth, 0.04);
    EXPECT_LT(fine.coverage, 0.004);
    EXPECT_LT(fine.depth, 0.01);
    EXPECT_LT(torus.coverage, 0.01);
    EXPECT_LT(torus.depth, 0.03);
    EXPECT_GT(departure_from_mesh(make_sphere(1, 48, 32), CellSplit::anti, 0).depth, fine.depth);
}

}  // namespace
}  // namespace quadrel::render_tests
