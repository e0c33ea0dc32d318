// How far textures tear at creases: the jump of the displaced coordinates across an edge that two
// facets share, by the angle between the facets, for flat and smooth normals and for refined
// meshes. ("Derivative-Based Relief Mapping", 2012, finds it invisible below 10 degrees and obvious
// above 20, figure 16, and proposes refinement.) Prints the table that data/scenes/README.md shows.
#include <fmt/format.h>

#include <functional>
#include <map>

#include "quadrel/scene/refine.hpp"
#include "render/planted.hpp"
#include "render/scenes.hpp"
#include "scene/degrees.hpp"

namespace quadrel::render_tests {
namespace {

constexpr double texels_a_unit = 256;

/// Two squares that meet in the y axis with `crease` degrees between their normals, u across the
/// edge in lengths of the surface, v along it. Smooth normals: vertical at the edge.
Mesh roof(double crease) {
    const SinCos half = sin_cos_degrees(crease / 2);
    Mesh mesh;
    for (int side = -1; side <= 1; ++side) {
        for (const double y : {-1.0, 1.0}) {
            mesh.positions.emplace_back(
                glm::dvec3(side * half.cosine, y, side == 0 ? 0 : -half.sine));
            mesh.normals.emplace_back(glm::dvec3(side * half.sine, 0, side == 0 ? 1 : half.cosine));
            mesh.uvs.emplace_back(side, y);
        }
    }
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}};
    return mesh;
}

/// What is compared: a frame on a roof, refined or not, with one normal a facet or smooth ones.
struct Variant {
    const char* name;
    const char* frame;
    bool smooth;
    int levels;
};

constexpr Variant variants[] = {
    {"flat, thesis", "frame-thesis", false, 0},  {"flat, gram", "frame-gram", false, 0},
    {"smooth, thesis", "frame-thesis", true, 0}, {"smooth, gram", "frame-gram", true, 0},
    {"smooth, cot", "frame-cot", true, 0},       {"refined 1, flat", "frame-gram", false, 1},
    {"refined 2, flat", "frame-gram", false, 2}, {"refined 3, flat", "frame-gram", false, 3},
};

/// Seen 45 degrees from the vertical and askew to the edge, in parallel, over a relief whose bottom
/// is hit everywhere: the shift is K, the greatest one that the depth allows.
Scene roof_scene(double crease, const Variant& variant) {
    Scene scene = empty_scene(160, 160);
    scene.camera.view = view_matrix(glm::dvec3(2, 1, 2.24), {0, 0, 0}, {0, 1, 0.3});
    scene.camera.projection =
        orthographic_matrix(2.0, 1, {.near = 0.1, .far = 20}, scene.conventions);
    Material material = plain_material("roof");
    material.frame.id = variant.frame;
    material.trace.id = "linear";
    material.trace.parameters["steps"] = 4;
    material.depth = 0.05f;
    material.textures["height"] =
        texture(write_texture("bottom.exr", 4, [](int, int, int) { return 0.0; }), "r");
    scene.materials = {material};
    Mesh mesh = refined_by_curvature(roof(crease), variant.levels);
    add_object(scene, variant.smooth ? mesh : flat_shaded(mesh), 0);
    return scene;
}

glm::dvec2 shift_at(const Film& film, int x, int y) {
    return {value(film, "hit.U", x, y) - value(film, "uv.U", x, y),
            value(film, "hit.V", x, y) - value(film, "uv.V", x, y)};
}

/// Greatest difference of the shift between neighbouring pixels of different triangles, in texels.
double tear(const Renderer& renderer, double crease, const Variant& variant) {
    const Film film =
        take(renderer, roof_scene(crease, variant), {"A", "uv", "hit.U", "hit.V", "id.primitive"});
    double worst = 0;
    const auto compare = [&](int x, int y, int to_x, int to_y) {
        const bool seen = value(film, "A", x, y) > 0 && value(film, "A", to_x, to_y) > 0;
        if (!seen || bits(film, "id.primitive", x, y) == bits(film, "id.primitive", to_x, to_y))
            return;
        const glm::dvec2 jump = shift_at(film, to_x, to_y) - shift_at(film, x, y);
        worst = std::max(worst, std::sqrt(jump.x * jump.x + jump.y * jump.y) * texels_a_unit);
    };
    for (int y = 0; y + 1 < 160; ++y)
        for (int x = 0; x + 1 < 160; ++x) {
            compare(x, y, x + 1, y);
            compare(x, y, x, y + 1);
        }
    return worst;
}

/// Tears of all variants by crease, 5 to 45 degrees.
using Tears = std::array<double, std::size(variants)>;
using TearsOf = std::function<Tears(int crease)>;

const Tears& measured(int crease) {
    static std::map<int, Tears> all;
    const auto [place, fresh] = all.try_emplace(crease);
    for (std::size_t i = 0; fresh && i < std::size(variants); ++i)
        place->second[i] = tear(render, crease, variants[i]);
    return place->second;
}

void print_row(int crease, const Tears& tears) {
    fmt::print("| {} |", crease);
    for (const double t : tears) fmt::print(" {:.1f} |", t);
    fmt::print("\n");
}

/// Tears grow with the crease; smooth normals and every level of refinement make them less.
testing::AssertionResult grow_and_shrink(const TearsOf& tears_of) {
    Tears last{};
    for (int crease = 5; crease <= 45; crease += 5) {
        const Tears now = tears_of(crease);
        for (std::size_t i = 0; i < now.size(); ++i)
            if (!(now[i] > last[i])) return testing::AssertionFailure() << variants[i].name;
        for (const auto& [less, more] : {std::pair{3, 1}, {5, 1}, {6, 5}, {7, 6}})
            if (!(now[std::size_t(less)] < 0.85 * now[std::size_t(more)]))
                return testing::AssertionFailure() << variants[less].name << " against "
                                                   << variants[more].name << " at " << crease;
        last = now;
    }
    return testing::AssertionSuccess();
}

TEST(Tearing, GrowsWithTheCreaseAndShrinksWithRefinement) {
    fmt::print("| crease |");
    for (const Variant& variant : variants) fmt::print(" {} |", variant.name);
    fmt::print("\n");
    EXPECT_TRUE(grow_and_shrink([](int crease) {
        const Tears& tears = measured(crease);
        print_row(crease, tears);
        return tears;
    }));
    EXPECT_FALSE(grow_and_shrink([](int crease) {  // refinement that leaves the facets
        Tears tears = measured(crease);
        tears[6] = tears[5];
        return tears;
    }));
    EXPECT_FALSE(grow_and_shrink([](int) { return measured(20); }));
}

/// The jump between facets of one normal each, by hand: K = D J d / (V.N) on both sides.
TEST(Tearing, OfFlatFacetsIsTheDifferenceOfTheirShifts) {
    for (const double crease : {10.0, 40.0}) {
        const Scene scene = roof_scene(crease, variants[1]);
        const glm::dvec3 V = normalize(glm::dvec3(2, 1, 2.24));
        const SinCos half = sin_cos_degrees(crease / 2);
        glm::dvec2 K[2];
        for (int side = 0; side < 2; ++side) {
            const double s = side == 0 ? -1 : 1;
            const glm::dvec3 N(s * half.sine, 0, half.cosine);
            const glm::dvec3 along_u(half.cosine, 0, -s * half.sine);
            K[side] = glm::dvec2(-dot(along_u, V), -V.y) * (0.05 / dot(N, V));
        }
        const double expected = length(K[1] - K[0]) * texels_a_unit;
        EXPECT_NEAR(tear(render, crease, variants[1]), expected, 0.02 * expected);
    }
}

}  // namespace
}  // namespace quadrel::render_tests
