// Displaced meshes: closed where the mesh was, every facet in half a cell and at the heights of the
// map, nothing moved where nothing is to be moved.
#include "quadrel/scene/displace.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "io/mesh/mesh_properties.hpp"
#include "quadrel/num/math.hpp"
#include "quadrel/scene/shapes.hpp"
#include "quadrel/scene/transform.hpp"
#include "scene/displaced_field.hpp"
#include "scene/planted.hpp"

namespace quadrel {
namespace {

using planted::DisplaceDefect;
using Displace = std::function<Mesh(const Mesh&, const Displacement&)>;

Displacement by(const Map& map, double depth = 0.2) {
    Displacement displacement;
    displacement.heights = &map.heights;
    displacement.depth = depth;
    return displacement;
}

glm::mat4 texture_matrix(double u, double v, double degrees, const glm::dvec2& offset) {
    return glm::mat4(translation({offset, 0}) * rotation(degrees, {0, 0, 1}) * scaling({u, v, 1}));
}

// ---- Displacing, with an error
// -------------------------------------------------------------------

Displace displace(DisplaceDefect defect) {
    return [defect](const Mesh& mesh, const Displacement& displacement) {
        Displacement changed = displacement;
        Mesh copy = mesh;
        switch (defect) {
            case DisplaceDefect::none:
                break;
            case DisplaceDefect::other_diagonal:
                changed.split =
                    changed.split == CellSplit::main ? CellSplit::anti : CellSplit::main;
                break;
            case DisplaceDefect::seat_ignored:
                changed.seat = 1;
                break;
            case DisplaceDefect::mirrored_inside_out:
                for (auto& t : copy.triangles) std::swap(t[1], t[2]);
                break;
            case DisplaceDefect::half_a_texel_off:
                for (auto& uv : copy.uvs) uv += glm::vec2(0.5f / 13, 0);
                break;
            case DisplaceDefect::seams_open: {
                Mesh out = displaced(copy, changed);
                out.triangles.pop_back();  // walls come last
                return out;
            }
            case DisplaceDefect::each_triangle_alone: {
                copy = flat_shaded(copy);  // vertices of its own
                copy.normals.clear();
                for (std::size_t v = 0; v < copy.uvs.size(); v += 6) copy.uvs[v].x += 0.01f;
                Mesh out;
                for (std::size_t t = 0; t < copy.triangles.size(); ++t) {
                    Mesh one = copy;
                    one.triangles = {copy.triangles[t]};
                    one = displaced(one, changed);
                    const auto base = static_cast<std::uint32_t>(out.positions.size());
                    out.positions.insert(out.positions.end(), one.positions.begin(),
                                         one.positions.end());
                    for (const auto& f : one.triangles)
                        out.triangles.push_back({f[0] + base, f[1] + base, f[2] + base});
                }
                return out;
            }
        }
        return displaced(copy, changed);
    };
}

// ---- Closed -------------------------------------------------------------------------------------

std::vector<Mesh> closed_meshes() {
    Mesh mirrored = make_sphere(1, 7, 5);
    for (auto& uv : mirrored.uvs) uv.x = -uv.x;
    Mesh point = make_icosahedron(1, true), line = point;
    for (auto& uv : point.uvs) uv = {0.3f, 0.7f};
    for (auto& uv : line.uvs) uv = {uv.x, 2 * uv.x};
    Mesh bare = make_sphere(1, 6, 4);
    bare.normals.clear();
    return {make_cube(2),
            make_icosahedron(1, false),
            make_icosahedron(1, true),
            make_sphere(1, 8, 6),
            make_sphere(2, 3, 2),
            make_torus(0.4, 1, 7, 5),
            mirrored,
            point,
            line,
            bare};
}

/// Every directed edge, by the positions of its ends, comes as often as its opposite: walls of
/// several seams may share an edge.
testing::AssertionResult is_watertight(const Mesh& mesh) {
    using Key = std::array<float, 3>;
    std::map<std::pair<Key, Key>, int> balance;
    for (const auto& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3 a = mesh.positions[t[k]], b = mesh.positions[t[(k + 1) % 3]];
            const Key from{a.x, a.y, a.z}, to{b.x, b.y, b.z};
            from < to ? ++balance[{from, to}] : --balance[{to, from}];
        }
    for (const auto& [edge, sum] : balance)
        if (sum != 0)
            return testing::AssertionFailure() << "an open edge at " << edge.first[0] << " "
                                               << edge.first[1] << " " << edge.first[2];
    return testing::AssertionSuccess();
}

testing::AssertionResult stays_closed(const Displace& displace, const Mesh& mesh,
                                      const Displacement& displacement) {
    const Mesh out = displace(mesh, displacement);
    if (const auto result = is_watertight(out); !result) return result;
    if (out.triangles.size() < mesh.triangles.size())
        return testing::AssertionFailure() << out.triangles.size() << " triangles";
    return is_consistent(out);
}

/// Seams, creases, poles, degenerate and mirrored texture coordinates: no crack opens.
TEST(Displaced, ClosedMeshesStayClosed) {
    const Map map(13, 7);
    int i = 0;
    for (const Mesh& mesh : closed_meshes()) {
        for (const CellSplit split : {CellSplit::main, CellSplit::anti, CellSplit::min}) {
            Displacement d = by(map);
            d.split = split;
            d.cells = i % 3 == 0 ? 0 : 3 * i;
            d.seat = 0.25 * (i % 5);
            if (i % 2 == 0) d.texture_matrix = texture_matrix(1.5, 1, 10 * i, {0.1, -3});
            EXPECT_TRUE(stays_closed(displace(DisplaceDefect::none), mesh, d))
                << mesh.name << " " << i;
            ++i;
        }
    }
}

TEST(Displaced, CracksAreNoticed) {
    const Map map(13, 7);
    for (const auto defect : {DisplaceDefect::seams_open, DisplaceDefect::each_triangle_alone})
        EXPECT_FALSE(stays_closed(displace(defect), make_cube(2), by(map)));
}

/// Where both sides of a seam agree there are no walls: a torus that a whole number of tiles covers
/// is one surface, whose Euler characteristic is that of its positions.
TEST(Displaced, SeamsThatAgreeAreJoinedByNothing) {
    const Map map(8, 8);
    const Mesh torus = displaced(make_torus(0.4, 1, 8, 16), by(map));
    std::set<std::array<float, 3>> positions;
    for (const auto& p : torus.positions) positions.insert({p.x, p.y, p.z});
    EXPECT_EQ(2 * positions.size(), torus.triangles.size());
    EXPECT_TRUE(is_closed(torus));
}

// ---- At the right height ------------------------------------------------------------------------

/// A square whose uv are turned, scaled and moved: (u, v) is an affine map of its x and y.
Mesh turned_square(double degrees, double scale, bool mirrored) {
    Mesh mesh = make_quad(2, 2, 1);
    const glm::mat4 turn =
        texture_matrix(mirrored ? -scale : scale, scale * 0.7, degrees, {0.37, -1.21});
    for (auto& uv : mesh.uvs) uv = glm::vec2(turn * glm::vec4(uv, 0, 1));
    return mesh;
}

/// Every facet is flat in the field: its corners and its middle have the field's heights, it faces
/// up, and together they cover the square once.
testing::AssertionResult is_the_field(const Displace& displace, const Mesh& square, const Map& map,
                                      const Displacement& d) {
    const Mesh out = displace(square, d);
    double area = 0;
    for (const auto& t : out.triangles) {
        const auto [a, b, c] = corners_of(out, t);
        const glm::dvec3 n = cross(b - a, c - a);
        if (!(n.z >= 0)) return testing::AssertionFailure() << "a facet that faces down";
        area += n.z / 2;
        if (n.z < 1e-6) continue;  // slivers have no middle
        const glm::dvec3 middle = (a + b + c) / 3.0;
        const glm::dvec2 uv =
            (glm::dvec2(out.uvs[t[0]]) + glm::dvec2(out.uvs[t[1]]) + glm::dvec2(out.uvs[t[2]])) /
            3.0;
        const double expected = (cell_at(map, d, uv).height() - d.seat) * d.depth;
        if (!(std::abs(middle.z - expected) < 1e-4 * d.depth))
            return testing::AssertionFailure()
                   << "at uv " << uv.x << " " << uv.y << " " << middle.z << ", not " << expected;
    }
    if (!(std::abs(area - 4) < 1e-5)) return testing::AssertionFailure() << "an area of " << area;
    if (!(out.triangles.size() == displaced_size(square, d).triangles))
        return testing::AssertionFailure() << out.triangles.size() << " triangles";
    return is_consistent(out);
}

constexpr Wrap all_wraps[] = {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge,
                              Wrap::clamp_to_border, Wrap::mirror_once};

TEST(Displaced, FacetsLieInHalfCellsAtTheFieldsHeights) {
    int i = 0;
    for (const Wrap wrap : all_wraps)
        for (const CellSplit split : {CellSplit::main, CellSplit::anti, CellSplit::min})
            for (const int cells : {0, 5}) {
                const Map map(13, 7, wrap, std::uint64_t(i));
                Displacement d = by(map);
                d.split = split;
                d.cells = cells;
                d.seat = 0.1 * (i % 11);
                const Mesh square = turned_square(37.0 * i, 0.4 + 0.2 * i, i % 2 == 1);
                EXPECT_TRUE(is_the_field(displace(DisplaceDefect::none), square, map, d)) << i;
                ++i;
            }
}

/// Lattice lines through corners, along edges and along diagonals.
TEST(Displaced, MeetsTheLatticeExactly) {
    const Map map(4, 4);
    Displacement d = by(map);
    for (const int cells : {1, 2, 4, 8})
        for (const CellSplit split : {CellSplit::main, CellSplit::anti, CellSplit::min}) {
            d.cells = cells;
            d.split = split;
            const Mesh square = make_quad(2, 1, 1);
            EXPECT_TRUE(is_the_field(displace(DisplaceDefect::none), square, map, d)) << cells;
            const Mesh out = displaced(square, d);
            if (split == CellSplit::main) {
                // The square's own diagonal is theirs: two triangles a cell, and nothing else.
                EXPECT_EQ(out.triangles.size(), 2u * std::size_t(cells * cells));
                EXPECT_EQ(out.positions.size(), std::size_t((cells + 1) * (cells + 1)));
            }
        }
}

TEST(Displaced, OtherSurfacesAreNoticed) {
    const Map map(13, 7);
    Displacement d = by(map);
    d.seat = 0.5;
    const Mesh square = turned_square(20, 1, false);
    for (const auto defect :
         {DisplaceDefect::other_diagonal, DisplaceDefect::seat_ignored,
          DisplaceDefect::mirrored_inside_out, DisplaceDefect::half_a_texel_off})
        EXPECT_FALSE(is_the_field(displace(defect), square, map, d));
}

// ---- Where nothing moves, and where all moves alike
// ----------------------------------------------

/// Positions within the mesh's triangles, normals as they are interpolated there.
TEST(Displaced, WithoutDepthOrAtTheSeatItIsTheMesh) {
    const Map map(13, 7);
    Map level(5, 5);
    std::fill(level.texels.begin(), level.texels.end(), 0.75f);
    Displacement none = by(map, 0), seated = by(level, 3);
    seated.seat = 0.75;
    for (const Displacement& d : {none, seated}) {
        const Mesh flat = displaced(make_cube(2), d);
        for (std::size_t v = 0; v < flat.positions.size(); ++v) {
            const glm::vec3 p = flat.positions[v], n = flat.normals[v];
            EXPECT_NEAR(dot(glm::dvec3(p), glm::dvec3(n)), 1, 1e-6);
            EXPECT_NEAR(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}), 1, 1e-6);
        }
        // A sphere's normals are its positions; between vertices both are interpolated alike.
        const Mesh sphere = displaced(make_sphere(1, 24, 16), d);
        EXPECT_TRUE(is_closed(sphere));
        for (std::size_t v = 0; v < sphere.positions.size(); ++v) {
            const glm::dvec3 p(sphere.positions[v]), n(sphere.normals[v]);
            ASSERT_NEAR(dot(p, n) / length(p), 1, 1e-6);
            ASSERT_GT(length(p), 0.97);
            ASSERT_LT(length(p), 1 + 1e-6);
        }
    }
}

/// Equal heights: the offset mesh, which is the sphere scaled.
TEST(Displaced, EqualHeightsScaleASphere) {
    Map level(5, 5);
    std::fill(level.texels.begin(), level.texels.end(), 0.5f);
    Displacement d = by(level, 0.5);
    for (const double seat : {0.0, 0.5, 1.0}) {
        d.seat = seat;
        const double scale = 1 + (0.5 - seat) * 0.5;
        const Mesh base = make_sphere(1, 12, 8), out = displaced(base, d);
        for (std::size_t v = 0; v < base.positions.size(); ++v)
            EXPECT_LT(length(glm::dvec3(out.positions[v]) - glm::dvec3(base.positions[v]) * scale),
                      1e-6);
        EXPECT_NEAR(signed_volume(out), signed_volume(base) * scale * scale * scale, 1e-4);
    }
}

/// Means of facets: on a slope that goes on, the slope's.
TEST(Displaced, NormalsAreThoseOfTheSurface) {
    Map slope(16, 1);
    for (int i = 0; i < 16; ++i) slope.texels[std::size_t(i)] = float(i) / 16;
    const Displacement d = by(slope, 0.5);
    Mesh square = make_quad(1, 1, 1);
    for (auto& uv : square.uvs) uv = glm::vec2(0.1f) + uv * 0.8f;  // between texel centres
    const Mesh out = displaced(square, d);
    // A rise of 0.5 along 1 / 0.8: the texture's length.
    const glm::dvec3 expected = normalize(glm::dvec3(-0.5 * 0.8, 0, 1));
    for (const auto& n : out.normals) EXPECT_LT(length(glm::dvec3(n) - expected), 1e-5);
}

// ---- Size ---------------------------------------------------------------------------------------

TEST(Displaced, SaysBeforehandWhatItComesTo) {
    const Map map(64, 64);
    for (const Mesh& mesh : {make_sphere(1, 16, 8), make_torus(0.4, 1, 7, 5), make_quad(2, 3, 2)}) {
        const DisplacedSize size = displaced_size(mesh, by(map));
        const Mesh out = displaced(mesh, by(map));
        EXPECT_LE(out.triangles.size(), size.triangles);
        EXPECT_GE(double(out.triangles.size()), 0.9 * double(size.triangles));
        EXPECT_LE(out.positions.size(), size.vertices);
    }
    Displacement fine = by(map);
    fine.cells = max_displacement_cells;
    EXPECT_THROW(displaced(make_quad(), fine), std::length_error);
    EXPECT_THROW(displaced(Mesh(), fine), std::invalid_argument);
    EXPECT_GT(displaced_size(make_quad(), fine).triangles, 8'000'000'000u);
    fine.texture_matrix = texture_matrix(1e6, 1, 0, {0, 0});
    EXPECT_GT(displaced_size(make_quad(), fine).reach, max_displacement_reach);
    fine.texture_matrix[0][0] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(displaced_size(make_quad(), fine).reach <= max_displacement_reach);
}

}  // namespace
}  // namespace quadrel
