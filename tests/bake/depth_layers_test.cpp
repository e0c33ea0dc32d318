// Depth layers of closed meshes: where rays through texel centres go in and out, by other
// arithmetic; that they go out as often as in, wherever they hit; what is no closed mesh.
#include "quadrel/bake/depth_layers.hpp"

#include <glm/geometric.hpp>

#include "bake/support.hpp"
#include "quadrel/error.hpp"
#include "quadrel/scene/shapes.hpp"

namespace quadrel::test {
namespace {

using Peel = std::function<DepthLayers(const Mesh&, const DepthLayerOptions&)>;

float depth_of(const DepthLayers& layers, int i, int j, int c) {
    return layers.film.planes[static_cast<std::size_t>(c)].as_float(layers.film.index(i, j));
}

/// Depths at which a line parallel to z, seen from above, goes through the triangles of a mesh; by
/// barycentrics in double. Empty, and not `certain`, where it passes an edge within 1e-6.
std::vector<double> lines_through(const Mesh& mesh, double x, double y, bool& certain) {
    std::vector<double> depths;
    for (const auto& triangle : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[triangle[0]]), b(mesh.positions[triangle[1]]),
            c(mesh.positions[triangle[2]]);
        const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        const double v = ((x - a.x) * (c.y - a.y) - (y - a.y) * (c.x - a.x)) / area;
        const double w = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
        const double u = 1 - v - w;
        const double least = std::min({u, v, w});
        if (std::abs(least) < 1e-6) certain = false;
        if (least > 0) depths.push_back(u * a.z + v * b.z + w * c.z);
    }
    std::sort(depths.rbegin(), depths.rend());
    return depths;
}

/// Texel by texel, looking along -z, on a mesh without surfaces inside of it.
testing::AssertionResult has_the_depths_of(const Mesh& mesh, const Peel& peel) {
    DepthLayerOptions options;
    options.width = 31;
    options.height = 27;
    const DepthLayers layers = peel(mesh, options);
    glm::dvec3 low(1e9), high(-1e9);
    for (const glm::vec3& p : mesh.positions)
        for (int c = 0; c < 3; ++c) {
            low[c] = std::min<double>(low[c], p[c]);
            high[c] = std::max<double>(high[c], p[c]);
        }
    const glm::dvec3 middle = (low + high) * 0.5;
    int compared = 0, solids = 0;
    for (int j = 0; j < options.height; ++j)
        for (int i = 0; i < options.width; ++i) {
            bool certain = true;
            const double x = middle.x + ((i + 0.5) / options.width - 0.5) * layers.tile;
            const double y = middle.y + ((j + 0.5) / options.height - 0.5) * layers.tile;
            const std::vector<double> z = lines_through(mesh, x, y, certain);
            if (!certain || z.size() % 2 != 0) continue;
            ++compared;
            for (std::size_t pair = 0; pair < 2; ++pair) {
                const int c = 2 * static_cast<int>(pair);
                const float front = depth_of(layers, i, j, c), back = depth_of(layers, i, j, c + 1);
                if (2 * pair >= z.size()) {
                    if (front != back)
                        return testing::AssertionFailure() << i << ", " << j << ": too many";
                    continue;
                }
                ++solids;
                const double expected[] = {(high.z - z[2 * pair]) / layers.thickness,
                                           (high.z - z[2 * pair + 1]) / layers.thickness};
                if (std::abs(front - expected[0]) > 1e-6 || std::abs(back - expected[1]) > 1e-6)
                    return testing::AssertionFailure()
                           << i << ", " << j << ": " << front << " to " << back << " for "
                           << expected[0] << " to " << expected[1];
            }
        }
    if (compared < 400 || solids < 60)
        return testing::AssertionFailure() << compared << " texels, " << solids << " solids";
    return testing::AssertionSuccess();
}

Mesh moved(Mesh mesh, const std::function<glm::vec3(const glm::vec3&)>& move) {
    for (glm::vec3& p : mesh.positions) p = move(p);
    return mesh;
}
/// Lies on its side, so that a ray goes through it twice, and a little askew.
Mesh upright_torus() {
    return moved(make_torus(0.25, 0.7, 17, 23),
                 [](const glm::vec3& p) { return glm::vec3(p.x + 0.01f * p.y, p.z, p.y); });
}

TEST(DepthLayers, AreWhereRaysGoInAndOut) {
    const Peel peel = peel_depth_layers;
    EXPECT_TRUE(has_the_depths_of(make_sphere(1.3, 19, 14), peel));
    EXPECT_TRUE(has_the_depths_of(make_torus(0.3, 0.8, 16, 21), peel));
    EXPECT_TRUE(has_the_depths_of(upright_torus(), peel));
    const auto with = [](const std::function<void(DepthLayers&)>& change) {
        return [=](const Mesh& mesh, const DepthLayerOptions& options) {
            DepthLayers layers = peel_depth_layers(mesh, options);
            change(layers);
            return layers;
        };
    };
    EXPECT_FALSE(has_the_depths_of(upright_torus(), with([](DepthLayers& layers) {
                                       std::swap(layers.film.planes[0].bits,
                                                 layers.film.planes[1].bits);
                                   })))
        << "swapped entry and exit";
    EXPECT_FALSE(has_the_depths_of(upright_torus(), with([](DepthLayers& layers) {
                                       layers.film.planes[3].bits = layers.film.planes[2].bits;
                                   })))
        << "a lost layer";
    EXPECT_FALSE(has_the_depths_of(make_sphere(), [](const Mesh& mesh, DepthLayerOptions options) {
        options.towards = {0.05, 0, -1};
        return peel_depth_layers(mesh, options);
    })) << "from another side";
}

/// A block of cells, its surface in triangles whose edges run through texel centres.
Mesh block_on_centres() {
    Mesh mesh = make_cube(2);
    const Mesh top = make_quad(2, 8, 8);
    // The two faces that are looked at in 8 x 8 cells; the sides in as many strips.
    mesh.positions.clear();
    mesh.triangles.clear();
    const auto add = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::vec3& p : {a, b, c}) mesh.positions.push_back(p);
        mesh.triangles.push_back({first, first + 1, first + 2});
    };
    for (const auto& t : top.triangles) {
        const auto at = [&](std::size_t k, float z) {
            const glm::vec3& p = top.positions[t[k]];
            return glm::vec3(p.x, p.y, z);
        };
        add(at(0, 1), at(1, 1), at(2, 1));
        add(at(2, -1), at(1, -1), at(0, -1));
    }
    for (int k = 0; k < 8; ++k) {
        const float from = -1 + 0.25f * static_cast<float>(k), to = from + 0.25f;
        const auto side = [&](const auto& at) {
            add(at(from, -1.0f), at(to, -1.0f), at(to, 1.0f));
            add(at(from, -1.0f), at(to, 1.0f), at(from, 1.0f));
        };
        side([](float s, float z) { return glm::vec3(s, -1, z); });
        side([](float s, float z) { return glm::vec3(-s, 1, z); });
        side([](float s, float z) { return glm::vec3(1, s, z); });
        side([](float s, float z) { return glm::vec3(-1, -s, z); });
    }
    return mesh;
}

/// Edges and corners on texel centres are crossed once: all of a block is one solid from 0 to 1,
/// and of those on its outline half belong to it.
TEST(DepthLayers, EdgesAndCornersAreCrossedOnce) {
    DepthLayerOptions options;
    options.margin = 0.1;
    // Over a tile of 2.5 all of them lie on diagonals, and of 15 some on corners and the outline.
    for (const int size : {10, 20, 15, 40}) {
        options.width = options.height = size;
        const DepthLayers layers = peel_depth_layers(block_on_centres(), options);
        int inside = 0;
        for (int j = 0; j < size; ++j)
            for (int i = 0; i < size; ++i) {
                const float front = depth_of(layers, i, j, 0), back = depth_of(layers, i, j, 1);
                EXPECT_TRUE(front == back || (front == 0 && back == 1)) << i << ", " << j;
                EXPECT_EQ(depth_of(layers, i, j, 2), depth_of(layers, i, j, 3));
                inside += front < back;
            }
        // 2 of 2.5 units each way.
        EXPECT_EQ(inside, size * size * 16 / 25) << size;
    }
}

/// What is solid weighs as much as the mesh.
TEST(DepthLayers, HoldTheVolumeOfTheMesh) {
    for (const glm::dvec3& towards : {glm::dvec3(0, 0, -1), glm::dvec3(0, -1, 0),
                                      glm::dvec3(1, 0, 0), glm::dvec3(1, -2, -1.5)}) {
        const Mesh mesh = make_torus(0.3, 0.8, 24, 40);
        double volume = 0;
        for (const auto& t : mesh.triangles)
            volume += glm::dot(glm::dvec3(mesh.positions[t[0]]),
                               glm::cross(glm::dvec3(mesh.positions[t[1]]),
                                          glm::dvec3(mesh.positions[t[2]]))) /
                      6;
        const DepthLayers layers = peel_depth_layers(mesh, {200, 200, towards, 1.0 / 16});
        double sum = 0;
        for (int j = 0; j < 200; ++j)
            for (int i = 0; i < 200; ++i)
                for (int c = 0; c < 4; c += 2)
                    sum += double(depth_of(layers, i, j, c + 1)) - depth_of(layers, i, j, c);
        const double texel = layers.tile / 200;
        EXPECT_NEAR(sum * texel * texel * layers.thickness, std::abs(volume),
                    0.005 * std::abs(volume));
        EXPECT_EQ(layers.deeper, 0u);
    }
}

/// A pile of so many cubes, each a solid of its own.
Mesh pile(int cubes) {
    Mesh mesh;
    for (int k = 0; k < cubes; ++k) {
        const Mesh cube = make_cube(0.5);
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::vec3& p : cube.positions)
            mesh.positions.push_back(p + glm::vec3(0.02f * static_cast<float>(k), 0, k));
        for (const auto& [a, b, c] : cube.triangles)
            mesh.triangles.push_back({first + a, first + b, first + c});
    }
    return mesh;
}

/// Channels of fewer solids are those of more, and what is behind is counted.
testing::AssertionResult keeps_the_nearest(const Peel& peel) {
    DepthLayerOptions options;
    options.width = options.height = 24;
    options.solids = most_solids;
    const DepthLayers all = peel(pile(6), options);
    if (all.film.planes.size() != 12 || all.deeper != 0)
        return testing::AssertionFailure() << all.deeper << " texels are deeper";
    for (int c = 0; c + 1 < 12; ++c)
        if (!(depth_of(all, 12, 12, c) < depth_of(all, 12, 12, c + 1)))
            return testing::AssertionFailure() << "channel " << c;
    for (int solids = 1; solids < most_solids; ++solids) {
        options.solids = solids;
        const DepthLayers fewer = peel(pile(6), options);
        if (fewer.deeper == 0 || fewer.film.planes.size() != std::size_t(solids + 1) / 2 * 4)
            return testing::AssertionFailure() << "of " << solids;
        for (std::size_t c = 0; c < 2 * std::size_t(solids); ++c)
            if (fewer.film.planes[c] != all.film.planes[c])
                return testing::AssertionFailure() << "channel " << c << " of " << solids;
        if (solids % 2 == 1 && depth_of(fewer, 12, 12, 2 * solids) != 1)
            return testing::AssertionFailure() << "something behind the last of " << solids;
    }
    return testing::AssertionSuccess();
}

TEST(DepthLayers, KeepUpToSixSolids) {
    EXPECT_TRUE(keeps_the_nearest(peel_depth_layers));
    EXPECT_FALSE(keeps_the_nearest([](const Mesh& mesh, DepthLayerOptions options) {
        options.solids = std::min(options.solids, 5);
        return peel_depth_layers(mesh, options);
    })) << "one less";
    EXPECT_FALSE(keeps_the_nearest([](const Mesh& mesh, const DepthLayerOptions& options) {
        DepthLayers layers = peel_depth_layers(mesh, options);
        if (options.solids < 4) std::swap(layers.film.planes[0].bits, layers.film.planes[1].bits);
        return layers;
    })) << "others than the nearest";
}

/// Sorted everywhere, and closed beside solids in their middle.
TEST(DepthLayers, AreSortedAndClosed) {
    const DepthLayers layers = peel_depth_layers(upright_torus(), {64, 64, {0, 0, -1}, 1.0 / 16});
    int closed = 0;
    for (int j = 1; j < 63; ++j)
        for (int i = 1; i < 63; ++i) {
            for (int c = 0; c < 3; ++c)
                EXPECT_LE(depth_of(layers, i, j, c), depth_of(layers, i, j, c + 1));
            const bool beside = depth_of(layers, i - 1, j, 0) < depth_of(layers, i - 1, j, 1) &&
                                depth_of(layers, i, j, 0) == depth_of(layers, i, j, 1);
            if (!beside) continue;
            ++closed;
            EXPECT_LT(depth_of(layers, i, j, 0), 0.9f) << i << ", " << j;
        }
    EXPECT_GT(closed, 10);
}

/// Of shells that overlap, solid is what any encloses.
TEST(DepthLayers, SolidsMayOverlap) {
    Mesh both = make_sphere(1, 16, 12);
    const Mesh other = moved(both, [](const glm::vec3& p) { return p + glm::vec3(0, 0, 0.5f); });
    const auto first = static_cast<std::uint32_t>(both.positions.size());
    both.positions.insert(both.positions.end(), other.positions.begin(), other.positions.end());
    const auto triangles = both.triangles;
    for (const auto& [a, b, c] : triangles)
        both.triangles.push_back({a + first, b + first, c + first});
    const DepthLayers layers = peel_depth_layers(both, {9, 9, {0, 0, -1}, 0});
    EXPECT_NEAR(depth_of(layers, 4, 4, 0), 0, 1e-6);
    EXPECT_NEAR(depth_of(layers, 4, 4, 1), 1, 1e-6);
    EXPECT_EQ(depth_of(layers, 4, 4, 2), depth_of(layers, 4, 4, 3));
    // A third solid behind two is left out, and counted.
    Mesh column;
    for (const float z : {0.0f, 3.0f, 6.0f}) {
        const Mesh one =
            moved(make_cube(2), [&](const glm::vec3& p) { return p + glm::vec3(0, 0, z); });
        const auto next = static_cast<std::uint32_t>(column.positions.size());
        column.positions.insert(column.positions.end(), one.positions.begin(), one.positions.end());
        for (const auto& [a, b, c] : one.triangles)
            column.triangles.push_back({a + next, b + next, c + next});
    }
    EXPECT_EQ(peel_depth_layers(column, {8, 8, {0, 0, -1}, 0}).deeper, 64u);
}

/// The message of the refusal; empty if there is none.
std::string refusal(const Mesh& mesh, const DepthLayerOptions& options = {}) {
    try {
        peel_depth_layers(mesh, options);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

TEST(DepthLayers, RefuseWhatIsNotClosed) {
    Mesh holed = make_cube(2);
    holed.name = "cube.obj";
    EXPECT_EQ(refusal(holed), "");
    holed.triangles.pop_back();
    EXPECT_NE(refusal(holed).find("3 open edges"), std::string::npos) << refusal(holed);
    EXPECT_NE(refusal(holed).find("cube.obj"), std::string::npos);
    Mesh turned = make_cube(2);
    std::swap(turned.triangles[0][0], turned.triangles[0][1]);
    EXPECT_NE(refusal(turned).find("open edge"), std::string::npos);
    EXPECT_NE(refusal(make_quad()).find("open edge"), std::string::npos);
    EXPECT_NE(refusal({}), "");
    // Both sides of a square: closed, but nothing in between.
    Mesh flat = make_quad();
    const auto front = flat.triangles;
    for (const auto& [a, b, c] : front) flat.triangles.push_back({c, b, a});
    EXPECT_NE(refusal(flat).find("flat"), std::string::npos);
}

}  // namespace
}  // namespace quadrel::test
