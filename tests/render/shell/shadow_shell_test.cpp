// Shadows out of shells: what lies between a hit and the light, in whichever tetrahedron.
#include <glm/geometric.hpp>

#include "quadrel/scene/displace.hpp"
#include "quadrel/texture/of_texels.hpp"
#include "render/draw/shell.hpp"
#include "render/draw/shell/shell_cells.hpp"
#include "render/shell/shell_scenes.hpp"

namespace quadrel::render_tests {
namespace {

constexpr int shadow_size = test::sanitized ? 20 : 40;

Scene shadow_scene(const Mesh& mesh, const std::string& shadow, const glm::vec3& light) {
    Scene scene = scene_of_shell(mesh, "frame-shell", "prism-exact", bump_texture(), shadow_size);
    scene.materials[0].shadow.id = shadow;
    Light lamp;
    lamp.kind = Light::Kind::point;
    lamp.space = Light::Space::eye;
    lamp.position = light;
    scene.lights = {lamp};
    return scene;
}

double bump_at(const glm::dvec2& uv) {
    const double x = uv.x * bump_texels - 0.5, y = uv.y * bump_texels - 0.5;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    const auto h = [&](int a, int b) {
        const auto wrapped = [](int k) { return (k % bump_texels + bump_texels) % bump_texels; };
        return bump_height(wrapped(i + a), wrapped(j + b));
    };
    const double f = x - i, g = y - j;
    return (h(0, 0) * (1 - f) + h(1, 0) * f) * (1 - g) + (h(0, 1) * (1 - f) + h(1, 1) * f) * g;
}

/// Every tetrahedron of a shell, to be asked for the one around a point. Knows nothing of faces
/// and neighbours.
class AllTetrahedra {
  public:
    explicit AllTetrahedra(const Scene& scene) {
        const Object& object = scene.objects[0];
        const Material& material = scene.materials[0];
        const Mesh& mesh = scene.meshes[object.mesh];
        const Shell shell(
            mesh,
            shade_vertices(mesh, scene.camera, scene.camera.view * glm::mat4(object.transform),
                           material.texture_matrix),
            material, scene.camera.projection);
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
            for (const ShellTetrahedron& corner : shell.tetrahedra(t)) {
                One one;
                for (std::size_t k = 0; k < 4; ++k) {
                    one.place[k] = shell.vertices().eye[corner[k]];
                    one.uv[k] = shell.vertices().uv[corner[k]];
                    one.s[k] = shell.is_bottom(corner[k]) ? 1 : 0;
                }
                one.low = glm::min(glm::min(one.place[0], one.place[1]),
                                   glm::min(one.place[2], one.place[3]));
                one.high = glm::max(glm::max(one.place[0], one.place[1]),
                                    glm::max(one.place[2], one.place[3]));
                if (shell.gradients(corner, one.gradient)) all_.push_back(one);
            }
    }

    enum class Verdict { dark, lit, unclear };

    /// By points along the way, for as long as one of them is in a tetrahedron.
    Verdict look(const glm::dvec3& P, const glm::dvec3& L, double depth) const {
        std::vector<const One*> near;
        for (const One& one : all_)
            if (may_meet(one, P, L)) near.push_back(&one);
        const double step = depth / 300;
        double highest = -1;
        for (int k = 4;; ++k) {
            const glm::dvec3 at = P + L * (step * k);
            const One* around = nullptr;
            for (const One* one : near)
                if (is_in(*one, at)) around = one;
            if (around == nullptr) break;
            glm::dvec2 uv(0);
            double s = 0;
            for (std::size_t i = 0; i < 4; ++i) {
                const double weight = weight_of(*around, i, at);
                uv += around->uv[i] * weight;
                s += around->s[i] * weight;
            }
            if (s > 1 - 1e-4) return Verdict::dark;
            highest = std::max(highest, bump_at(uv) - (1 - s));
            if (highest > 0.01) return Verdict::dark;
        }
        return highest < -0.002 ? Verdict::lit : Verdict::unclear;
    }

  private:
    struct One {
        std::array<glm::dvec3, 4> place, gradient;
        std::array<glm::dvec2, 4> uv;
        std::array<double, 4> s{};
        glm::dvec3 low, high;
    };

    static double weight_of(const One& one, std::size_t k, const glm::dvec3& at) {
        return glm::dot(one.gradient[k], at - one.place[0]) + (k == 0 ? 1 : 0);
    }
    static bool is_in(const One& one, const glm::dvec3& at) {
        for (std::size_t k = 0; k < 4; ++k)
            if (weight_of(one, k, at) < -1e-7) return false;
        return true;
    }
    static bool may_meet(const One& one, const glm::dvec3& P, const glm::dvec3& L) {
        double from = 0, to = 1e30;
        for (int i = 0; i < 3; ++i) {
            const double a = (one.low[i] - 1e-6 - P[i]) / L[i],
                         b = (one.high[i] + 1e-6 - P[i]) / L[i];
            from = std::max(from, std::min(a, b));
            to = std::min(to, std::max(a, b));
        }
        return from <= to;
    }

    std::vector<One> all_;
};

struct SeenHit {
    int x, y;
    glm::dvec3 P, L;
    bool is_lit;
};

std::vector<SeenHit> seen_hits(const Scene& scene) {
    const Film film = take(render, scene, {"A", "hit.P", "shadow.visibility"});
    const glm::dvec3 light(scene.lights[0].position);
    std::vector<SeenHit> hits;
    for (int y = 0; y < scene.height; ++y)
        for (int x = 0; x < scene.width; ++x) {
            if (value(film, "A", x, y) == 0) continue;
            const glm::dvec3 P(value(film, "hit.P.X", x, y), value(film, "hit.P.Y", x, y),
                               value(film, "hit.P.Z", x, y));
            hits.push_back(
                {x, y, P, glm::normalize(light - P), value(film, "shadow.visibility", x, y) > 0.5});
        }
    return hits;
}

constexpr glm::vec3 side_lights[] = {{-6, 1, -3}, {2, 7, -2.5}, {5, -5, 1}};

/// Every shadow that is clear is there, and no other; but for `share` of them.
testing::AssertionResult shadows_are_those_of_tetrahedra(const Mesh& mesh,
                                                         const std::string& shadow, double share) {
    using Verdict = AllTetrahedra::Verdict;
    int dark = 0, lit = 0, unclear = 0, wrong = 0;
    std::string first;
    for (const glm::vec3& light : side_lights) {
        const Scene scene = shadow_scene(mesh, shadow, light);
        const AllTetrahedra truth(scene);
        for (const SeenHit& hit : seen_hits(scene)) {
            const Verdict verdict = truth.look(hit.P, hit.L, scene.materials[0].depth);
            dark += verdict == Verdict::dark;
            lit += verdict == Verdict::lit;
            unclear += verdict == Verdict::unclear;
            if (verdict == Verdict::unclear || (verdict == Verdict::lit) == hit.is_lit) continue;
            ++wrong;
            if (first.empty())
                first = fmt::format("{} at {},{}", hit.is_lit ? "lit" : "dark", hit.x, hit.y);
        }
    }
    const int fewest = shadow_size * shadow_size / 16;
    if (dark < fewest || lit < fewest || unclear > (dark + lit) / 2)
        return testing::AssertionFailure()
               << dark << " dark, " << lit << " lit, " << unclear << " unclear";
    if (wrong <= share * (dark + lit)) return testing::AssertionSuccess();
    return testing::AssertionFailure() << wrong << " of " << dark + lit << " wrong: " << first;
}

TEST(ShadowShell, IsThatOfTheTetrahedraOnTheWay) {
    const double few = test::sanitized ? 0.02 : 0.005;
    for (const Mesh& mesh : {make_sphere(1, 12, 8), make_torus(0.3, 0.7, 8, 12)}) {
        // Snapping moves rays: some hits lie a little below the surface, where they enter.
        EXPECT_TRUE(shadows_are_those_of_tetrahedra(mesh, "shadow-shell", few));
        EXPECT_TRUE(shadows_are_those_of_tetrahedra(mesh, "shadow-shell-march", 0.05));
        // As if the mesh were flat from the hit on.
        EXPECT_FALSE(shadows_are_those_of_tetrahedra(mesh, "shadow-exact", few));
        EXPECT_FALSE(shadows_are_those_of_tetrahedra(mesh, "shadow-none", 0.05));
    }
}

/// Of the hits, those that the displaced mesh's triangles shadow otherwise.
double share_unlike_the_mesh(const Mesh& mesh, const std::string& shadow) {
    std::vector<float> heights;
    for (int y = 0; y < bump_texels; ++y)
        for (int x = 0; x < bump_texels; ++x)
            heights.push_back(static_cast<float>(bump_height(x, y)));
    const SampledTexture map = texture_of_texels(heights, bump_texels, bump_texels);
    int hits = 0, unlike = 0;
    for (const glm::vec3& light : side_lights) {
        const Scene scene = shadow_scene(mesh, shadow, light);
        Displacement displacement;
        displacement.heights = &map;
        displacement.depth = scene.materials[0].depth;
        const Mesh solid = displaced(mesh, displacement);
        const glm::dmat4 to_eye =
            glm::dmat4(scene.camera.view) * glm::dmat4(scene.objects[0].transform);
        std::vector<std::array<glm::dvec3, 3>> triangles;
        for (const auto& corner : solid.triangles) {
            std::array<glm::dvec3, 3> at;
            for (std::size_t k = 0; k < 3; ++k)
                at[k] = to_eye * glm::dvec4(solid.positions[corner[k]], 1);
            triangles.push_back(at);
        }
        for (const SeenHit& hit : seen_hits(scene)) {
            const glm::dvec3 from = hit.P + hit.L * (0.05 * displacement.depth);
            bool dark = false;
            for (const auto& [a, b, c] : triangles) {
                const glm::dvec3 e1 = b - a, e2 = c - a, h = glm::cross(hit.L, e2);
                const double det = glm::dot(e1, h);
                const glm::dvec3 to = from - a, q = glm::cross(to, e1);
                const double u = glm::dot(to, h) / det, v = glm::dot(hit.L, q) / det;
                dark |= u >= 0 && v >= 0 && u + v <= 1 && glm::dot(e2, q) / det > 0;
                if (dark) break;
            }
            ++hits;
            unlike += dark == hit.is_lit;
        }
    }
    EXPECT_GT(hits, shadow_size * shadow_size / 2);
    testing::Test::RecordProperty("unlike_" + shadow, std::to_string(double(unlike) / hits));
    return double(unlike) / hits;
}

TEST(ShadowShell, IsNearThatOfTheDisplacedMesh) {
    const Mesh mesh = make_sphere(1, 24, 16);
    const double walked = share_unlike_the_mesh(mesh, "shadow-shell");
    // Its triangles are not the patches between texels, of which one is a bump here.
    EXPECT_LT(walked, 0.13);
    EXPECT_GT(share_unlike_the_mesh(mesh, "shadow-none"), 2 * walked);
}

// ---- Neighbours ---------------------------------------------------------------------------------

struct PlacedCells {
    Mesh mesh;
    Material material;
    Shell shell;
    std::vector<ShellCell> cells;

    explicit PlacedCells(const Mesh& of)
        : mesh(of),
          material(deep()),
          shell(mesh,
                {mesh.positions, mesh.normals, std::vector<glm::vec4>(mesh.positions.size()),
                 mesh.uvs},
                material, glm::mat4(1.0f)),
          cells(shell_cells(shell, mesh, 7)) {}

  private:
    static Material deep() {
        Material material;
        material.depth = 0.1f;
        return material;
    }
};

/// Faces that have no neighbour but are neither top nor bottom.
int open_sides(const PlacedCells& placed) {
    int open = 0;
    for (std::size_t i = 0; i < placed.cells.size(); ++i)
        for (int k = 0; k < 4; ++k) {
            const ShellCell& cell = placed.cells[i];
            float depth = 0;
            for (int c = 0; c < 4; ++c) depth += c == k ? 0 : cell.s[c];
            const std::int32_t next = cell.link[k];
            EXPECT_EQ(depth == 3, next == ShellCell::below);
            EXPECT_TRUE(depth != 0 || next == ShellCell::outside);
            open += next == ShellCell::outside && depth != 0;
            if (next < ShellCell::first_link) continue;
            const std::int32_t row = (next - ShellCell::first_link) / 4, back = next % 4;
            const ShellCell& other = placed.cells[static_cast<std::size_t>(row - 7)];
            EXPECT_EQ(other.link[back], ShellCell::link_to(static_cast<std::int32_t>(i) + 7, k));
        }
    return open;
}

TEST(ShellCells, NeighboursAgreeAcrossSeams) {
    EXPECT_EQ(open_sides(PlacedCells(make_torus(0.3, 0.7, 8, 12))), 0);
    Mesh apart = make_torus(0.3, 0.7, 8, 12);
    // A seam whose vertices are not in one place.
    for (std::size_t i = 0; i < apart.positions.size(); ++i)
        if (apart.uvs[i].x == 0) apart.positions[i] *= 1.001f;
    EXPECT_GT(open_sides(PlacedCells(apart)), 0);
    EXPECT_GT(open_sides(PlacedCells(make_quad(1, 2, 2))), 0) << "an open border";
}

}  // namespace
}  // namespace quadrel::render_tests
