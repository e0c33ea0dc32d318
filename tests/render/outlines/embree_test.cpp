// prism-exact against Embree, which traces the same relief as triangles: pixel by pixel the first
// hit and the outline, in the shell's own tetrahedra up to rounding, and on displaced meshes up to
// what relief/shell/shell_face.hpp says that tetrahedra are off.
#include <cstdlib>

#include "effort.hpp"
#include "quadrel/scene/displace.hpp"
#include "quadrel/texture/of_texels.hpp"
#include "render/films.hpp"
#include "render/outlines/embree_shapes.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

constexpr double traced_depth = 0.15;
using Split = ReliefFacets::Split;

/// Pixels along a side. Set QUADREL_EMBREE_SIDE for more.
int traced_side() {
    const char* const side = std::getenv("QUADREL_EMBREE_SIDE");
    return side != nullptr ? std::atoi(side) : test::sanitized ? 40 : 96;
}

CellMap traced_map(double planted = 0) {
    CellMap map{16, {}};
    for (int y = 0; y < map.texels; ++y)
        for (int x = 0; x < map.texels; ++x)
            map.heights.push_back(static_cast<float>(0.25 + planted + 0.5 * noise(x, y, 1)));
    return map;
}

struct TracedShape {
    const char* name;
    Mesh mesh;
};

std::vector<TracedShape> traced_shapes() {
    std::vector<TracedShape> shapes;
    shapes.push_back({"sphere of 12 facets", make_sphere(1, 12, 8)});
    if (!test::sanitized) {
        shapes.push_back({"sphere of 48 facets", make_sphere(1, 48, 32)});
        shapes.push_back({"torus", make_torus(0.3, 0.7, 24, 36)});
    }
    return shapes;
}

Scene traced_scene(const Mesh& mesh) {
    Scene scene = empty_scene(traced_side(), traced_side());
    set_perspective_camera(scene, {0.3, -0.2, 3}, {.near = 0.5, .far = 20});
    scene.materials = {plain_material("shell", {1, 1, 1})};
    Material& material = scene.materials[0];
    material.frame = stage("frame-shell", "frame");
    material.trace = stage("prism-exact", "trace");
    material.trace.parameters["surface"] = 1;
    material.frag_depth = stage("frag-depth", "frag_depth");
    material.depth = static_cast<float>(traced_depth);
    TextureReference heights = texture(write_texture(
        "traced.exr", 16, [map = traced_map()](int x, int y, int) { return map.at(x, y); }));
    heights.sampler.mip = MipFilter::none;
    material.textures["height"] = heights;
    // So that no edge lies along rows of pixels.
    add_object(scene, mesh, 0, rotation(25, {1, 2, 0.5}));
    return scene;
}

/// What the shell shows in a pixel: its ray, and the distance of the hit, if there is one.
struct SeenPixel {
    glm::dvec3 direction;
    std::optional<double> t;
};

/// All pixels of the scene, in doubles; rays of fragments are their own, which snapping moves by
/// up to 1/256 of a pixel.
std::vector<SeenPixel> seen_pixels(const Scene& scene) {
    RenderOptions options;
    options.channels = {"A", "P", "hit.P"};
    options.number = "double";
    const Film film = render(scene, options);
    const glm::dmat4 unproject = glm::inverse(glm::dmat4(scene.camera.projection));
    std::vector<SeenPixel> pixels;
    for (int y = 0; y < scene.height; ++y)
        for (int x = 0; x < scene.width; ++x) {
            const auto point = [&](const std::string& name) {
                return glm::dvec3(value(film, name + ".X", x, y), value(film, name + ".Y", x, y),
                                  value(film, name + ".Z", x, y));
            };
            if (value(film, "A", x, y) > 0) {
                pixels.push_back({glm::normalize(point("P")), glm::length(point("hit.P"))});
                continue;
            }
            const glm::dvec4 far = unproject * glm::dvec4((2 * x + 1.0) / scene.width - 1,
                                                          1 - (2 * y + 1.0) / scene.height, 1, 1);
            pixels.push_back({glm::normalize(glm::dvec3(far) / far.w), std::nullopt});
        }
    return pixels;
}

/// How a pixel's two answers go together.
enum class Agreement : std::size_t {
    missed,    ///< both miss
    same,      ///< hits as near as they can be told to be
    passed,    ///< one ray passes an edge of the relief that the other meets, within the bound
    outlined,  ///< and so at the outline: one of them misses
    snapped,   ///< a ray beside, within what snapping moves, has the other answer
    /// Rays are followed past the sides of a tetrahedron by what snapping may have moved them
    /// (prism_ray.hpp), which along a side that is seen edge-on is more than itself: met there,
    /// within half a pixel of the surface.
    beyond,
    wrong,  ///< nothing explains it
    count
};
using Agreements = std::array<int, static_cast<std::size_t>(Agreement::count)>;

/// Where rays are in doubt by a part of a pixel, and surfaces by a distance in space.
struct Doubts {
    double pixel;    ///< an angle; two snapping steps are a 128th of it
    double surface;  ///< how far what is traced may be from what is shown
};

/// What floats make of hits 3 units away.
constexpr double traced_rounding = 2e-6;

/// How far hits may be apart along rays that meet at that cosine.
double along_ray(double distance, double cosine) {
    return distance * (1 + 1 / std::max(cosine, 1e-9));
}

/// Rays around, up to that angle away: what is thin is not passed over.
std::vector<glm::dvec3> rays_around(const glm::dvec3& d, double angle) {
    const glm::dvec3 right = glm::normalize(glm::cross(d, glm::dvec3(0, 1, 0)));
    const glm::dvec3 up = glm::cross(right, d);
    std::vector<glm::dvec3> rays;
    for (int k = 0; k < 24; ++k) {
        const double turn = k * 0.7853981633974483, away = angle / (1 << (k / 8));
        rays.push_back(glm::normalize(d + (right * std::cos(turn) + up * std::sin(turn)) * away));
    }
    return rays;
}

/// `shown`: the shell's own surface, where `traced` is another one.
Agreement agreement_of(const SeenPixel& seen, const EmbreeFacets& traced, const EmbreeFacets& shown,
                       const Doubts& doubts) {
    const auto met = traced.trace(seen.direction);
    if (!met && !seen.t) return Agreement::missed;
    const double off = doubts.surface + traced_rounding;
    if (met && seen.t && std::abs(met->t - *seen.t) <= along_ray(off, met->cosine))
        return Agreement::same;
    // What is met first is at most as far from the other surface as the two are apart.
    const bool shell_first = seen.t && (!met || *seen.t < met->t);
    const glm::dvec3 first = seen.direction * (shell_first ? *seen.t : met->t);
    if (doubts.surface > 0 && (shell_first ? traced : shown).distance(first, 2 * off) <= off)
        return met && seen.t ? Agreement::passed : Agreement::outlined;
    const double angle = doubts.pixel * 2 / 256;
    for (const glm::dvec3& beside : rays_around(seen.direction, angle)) {
        const auto other = traced.trace(beside);
        if (!other && !seen.t) return Agreement::snapped;
        const double moved = off + angle * (other ? other->t : 0);
        if (other && seen.t && std::abs(other->t - *seen.t) <= along_ray(moved, other->cosine))
            return Agreement::snapped;
    }
    const double half = seen.t ? doubts.pixel * *seen.t / 2 + off : 0;
    const bool near = seen.t && traced.distance(seen.direction * *seen.t, half) <= half;
    return near ? Agreement::beyond : Agreement::wrong;
}

/// A shape as its shell is drawn, and the tetrahedra's own surface.
struct DrawnShell {
    Scene scene;
    glm::dmat4 to_eye;
    std::vector<SeenPixel> seen;
    ReliefFacets facets;
    EmbreeFacets shown;

    DrawnShell(const Mesh& mesh, const CellMap& map)
        : scene(traced_scene(mesh)),
          to_eye(glm::dmat4(scene.camera.view) * glm::dmat4(scene.objects[0].transform)),
          seen(seen_pixels(scene)),
          facets(mesh, map, traced_depth, to_eye, Split::by_vertex),
          shown(facets.facets()) {}

    int pixels() const { return scene.width * scene.height; }

    /// Beside facets that are up to `surface` apart from its own.
    Agreements beside(const EmbreeFacets& traced, double surface) const {
        const double pixel = 2 * std::tan(0.4363323129985824) / scene.height;  // half of 50 degrees
        Agreements tally{};
        for (const SeenPixel& one : seen)
            ++tally[static_cast<std::size_t>(agreement_of(one, traced, shown, {pixel, surface}))];
        return tally;
    }
};

int count_of(const Agreements& tally, Agreement of) { return tally[static_cast<std::size_t>(of)]; }

/// All but a few of these are errors.
int unexplained(const Agreements& tally) {
    return count_of(tally, Agreement::wrong) + count_of(tally, Agreement::beyond);
}

void print_agreements(const char* shape, const char* against, const Agreements& tally) {
    fmt::print(
        "{} against {}: {} missed by both, {} the same, {} passed, {} outlined, {} snapped, {} "
        "beyond, {} wrong\n",
        shape, against, tally[0], tally[1], tally[2], tally[3], tally[4], tally[5], tally[6]);
}

/// Hits and outline are those of the tetrahedra, to rounding, but for what snapping moves.
TEST(EmbreeShells, TetrahedraAreMetWhereTheyAre) {
    const CellMap map = traced_map(), higher = traced_map(0.02);
    for (const TracedShape& shape : traced_shapes()) {
        const DrawnShell drawn(shape.mesh, map);
        const Agreements tally = drawn.beside(drawn.shown, 0);
        print_agreements(shape.name, "its tetrahedra", tally);
        EXPECT_EQ(count_of(tally, Agreement::wrong), 0) << shape.name;
        EXPECT_GT(count_of(tally, Agreement::same), drawn.pixels() / 8) << shape.name;
        EXPECT_LE(count_of(tally, Agreement::snapped), drawn.pixels() / 50) << shape.name;
        EXPECT_LE(count_of(tally, Agreement::beyond), drawn.pixels() / 25000) << shape.name;
        const auto wrong_with = [&](const CellMap& of, Split split) {
            const ReliefFacets planted(shape.mesh, of, traced_depth, drawn.to_eye, split);
            return unexplained(drawn.beside(EmbreeFacets(planted.facets()), 0));
        };
        const int few = drawn.pixels() / 100;
        EXPECT_GT(wrong_with(map, Split::by_corner), few / 2) << shape.name << ", wrong split";
        EXPECT_GT(wrong_with(map, Split::none), few / 2) << shape.name << ", no split";
        EXPECT_GT(wrong_with(higher, Split::by_vertex), 5 * few) << shape.name << ", higher";
    }
}

/// The mesh as `displace` makes it, in eye space.
std::vector<Facet> displaced_facets(const Mesh& mesh, const CellMap& map, double depth,
                                    const glm::dmat4& to_eye) {
    const SampledTexture heights = texture_of_texels(map.heights, map.texels, map.texels);
    Displacement displacement;
    displacement.heights = &heights;
    displacement.depth = depth;
    const Mesh moved = displaced(mesh, displacement);
    std::vector<Facet> facets;
    for (const auto& corner : moved.triangles) {
        Facet facet;
        for (std::size_t k = 0; k < 3; ++k)
            facet[k] = to_eye * glm::dvec4(glm::dvec3(moved.positions[corner[k]]), 1);
        facets.push_back(facet);
    }
    return facets;
}

/// The displaced mesh is met within the bound, or passed within it.
TEST(EmbreeShells, DisplacedMeshesAreMetWithinTheBound) {
    const CellMap map = traced_map();
    for (const TracedShape& shape : traced_shapes()) {
        const DrawnShell drawn(shape.mesh, map);
        const double bound = drawn.facets.bound();
        const auto tally_of = [&](double depth, double off) {
            return drawn.beside(
                EmbreeFacets(displaced_facets(shape.mesh, map, depth, drawn.to_eye)), off);
        };
        const Agreements tally = tally_of(traced_depth, bound);
        print_agreements(shape.name, "the displaced mesh", tally);
        EXPECT_EQ(count_of(tally, Agreement::wrong), 0) << shape.name;
        EXPECT_LE(count_of(tally, Agreement::beyond), drawn.pixels() / 25000) << shape.name;
        EXPECT_LE(count_of(tally, Agreement::passed), drawn.pixels() / 20) << shape.name;
        EXPECT_LE(count_of(tally, Agreement::outlined), drawn.pixels() / 50) << shape.name;
        // A relief that is deeper by some bounds is noticed, and so is a bound of less.
        const double deeper = traced_depth + 8 * bound;
        EXPECT_GT(unexplained(tally_of(deeper, bound)), drawn.pixels() / 100);
        EXPECT_GT(unexplained(tally_of(traced_depth, bound / 50)), drawn.pixels() / 500);
    }
}

}  // namespace
}  // namespace quadrel::render_tests
