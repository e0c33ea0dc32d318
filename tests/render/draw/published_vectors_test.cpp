// Published rows whose vectors come from a vertex program, from a scene's mesh to hit.UV, over
// constant heights: what the listing gives for the vectors of the mesh's vertices, in double. The
// former error, vectors made anew of the fragment's interpolated frame, is planted and caught.
#include "quadrel/scene/tangents.hpp"
#include "relief/frame/frame_listings.hpp"
#include "relief/trace/trace_listings.hpp"
#include "render/planted.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

using listings::Vec2;
using listings::Vec3;

constexpr float map_height = 0.063f;

// ---- Scenes -------------------------------------------------------------------------------------

Material published_material(const std::string& trace) {
    Material material = plain_material("published");
    material.frame.id = "frame-vertex@published";
    material.trace.id = trace;
    material.depth = 0.1f;
    material.textures["height"] =
        texture(write_texture("level.exr", 2, [](int, int, int) { return map_height; }), "r");
    return material;
}

Scene scene_of(const Mesh& mesh, const glm::dmat4& transform, const std::string& trace,
               double near = 0.1) {
    Scene scene = empty_scene(32, 32);
    set_perspective_camera(scene, {0, 0, 4}, {.near = near, .far = 50});
    scene.materials = {published_material(trace)};
    add_object(scene, mesh, 0, transform);
    return scene;
}

/// The mesh with uv = M uv.
Mesh mapped(Mesh mesh, const glm::dmat2& M) {
    for (glm::vec2& uv : mesh.uvs) uv = glm::vec2(M * glm::dvec2(uv));
    return mesh;
}

const glm::dmat2 sheared(1, 0, 0.8, 1), mirrored(-1, 0, 0, 1),
    rotated_uv(glm::dvec2(0.6, 0.8), glm::dvec2(-0.8, 0.6));

// ---- The listing's vectors ----------------------------------------------------------------------

/// One triangle as it is drawn: attributes of its corners in object space.
struct Corners {
    std::array<listings::WelshVertex, 3> vertex;
};

class ShearedObject {
  public:
    explicit ShearedObject(const Scene& scene)
        : mesh_(scene.meshes[0]),
          model_view_(glm::dmat4(scene.camera.view) * glm::dmat4(scene.objects[0].transform)),
          tangents_(uv_tangents(mesh_)) {}

    Corners corners(std::uint32_t triangle) const {
        Corners out;
        const bool turned_round = glm::determinant(glm::dmat3(model_view_)) < 0;
        for (std::size_t v = 0; v < 3; ++v) {
            const std::size_t c = turned_round && v > 0 ? 3 - v : v;
            const std::uint32_t index = mesh_.triangles[triangle][c];
            listings::WelshVertex& vertex = out.vertex[v];
            vertex.eye = Vec3(glm::inverse(model_view_)[3]);
            vertex.position = mesh_.positions[index];
            vertex.normal = mesh_.normals[index];
            vertex.tangent = Vec3(glm::normalize(glm::dvec3(tangents_[triangle][c].dPdu)));
            vertex.binormal = Vec3(glm::normalize(glm::dvec3(tangents_[triangle][c].dPdv)));
            vertex.main();
        }
        return out;
    }

  private:
    const Mesh& mesh_;
    glm::dmat4 model_view_;
    std::vector<std::array<UvTangents, 3>> tangents_;
};

/// The eye along tangent, binormal and normal at a fragment.
using EyeVector = Vec3 (*)(const Corners&, const glm::dvec3& b);

template <class Member>
glm::dvec3 interpolate(const Corners& corners, const glm::dvec3& b, Member member) {
    glm::dvec3 sum(0);
    for (int v = 0; v < 3; ++v) sum += b[v] * glm::dvec3(corners.vertex[std::size_t(v)].*member);
    return sum;
}

Vec3 of_the_vertices(const Corners& corners, const glm::dvec3& b) {
    return Vec3(interpolate(corners, b, &listings::WelshVertex::texcoord3));
}

/// The error: from the interpolated position, tangent and normal, with binormal = cross(N, T).
Vec3 of_the_fragment(const Corners& corners, const glm::dvec3& b) {
    using Vertex = listings::WelshVertex;
    const glm::dvec3 eye =
        glm::dvec3(corners.vertex[0].eye) - interpolate(corners, b, &Vertex::position);
    const glm::dvec3 N = glm::normalize(interpolate(corners, b, &Vertex::normal));
    const glm::dvec3 T = glm::normalize(interpolate(corners, b, &Vertex::tangent));
    const glm::dvec3 B = interpolate(corners, b, &Vertex::binormal);
    const double side = glm::dot(glm::cross(N, T), B) < 0 ? -1 : 1;
    return Vec3(glm::dot(eye, T), glm::dot(eye, glm::cross(N, T)) * side, glm::dot(eye, N));
}

// ---- The check ----------------------------------------------------------------------------------

/// A row and its listing.
struct Row {
    const char* id;
    Vec2 (*listing)(const Vec2& uv, const Vec3& eye);
    double tolerance;
};

Vec2 welsh(const Vec2& uv, const Vec3& eye, bool limited) {
    return listings::welsh(uv, eye, 0.04f, -0.02f, limited, [](const Vec2&) { return map_height; })
        .uv;
}

const Row vector_rows[] = {
    {"offset-limit@published", [](const Vec2& uv, const Vec3& eye) { return welsh(uv, eye, true); },
     1e-6},
    {"parallax-bias@published",
     [](const Vec2& uv, const Vec3& eye) { return welsh(uv, eye, false); }, 3e-6},
    {"steep@published",
     [](const Vec2& uv, const Vec3& eye) {
         return listings::mcguire(uv, eye * Vec3(1.0f, -1.0f, 1.0f), 5, 0.05f, false,
                                  [](const Vec2&) { return map_height; })
             .uv;
     },
     1e-5},
    {"height-outward@published",
     [](const Vec2& uv, const Vec3& eye) {
         return listings::flightgear(uv, -eye, 0.1f, 1, 50, [](const Vec2&) { return map_height; })
             .uv;
     },
     1e-5},
};

/// Largest distance in UV between the render and the listing with the eye vectors of `of`, over
/// views flatter than neither 86 degrees; and how many pixels that were.
struct Difference {
    double worst = 0;
    int pixels = 0;
};

Film picture(const Scene& scene) {
    return take(render, scene, {"A", "id.primitive", "bary", "uv", "hit"});
}

Difference difference(const Scene& scene, const Film& film, const Row& row, EyeVector of) {
    const ShearedObject object(scene);
    Difference result;
    for (int y = 0; y < scene.height; ++y) {
        for (int x = 0; x < scene.width; ++x) {
            if (value(film, "A", x, y) == 0) continue;
            const auto at = [&](const char* channel) { return value(film, channel, x, y); };
            const Corners corners = object.corners(bits(film, "id.primitive", x, y));
            const glm::dvec3 b(at("bary.0"), at("bary.1"), at("bary.2"));
            const Vec3 right = of_the_vertices(corners, b);
            if (right.z < 0.07f * glm::length(right)) continue;
            const Vec2 listed = row.listing({at("uv.U"), at("uv.V")}, of(corners, b));
            const glm::dvec2 off = glm::dvec2(at("hit.U"), at("hit.V")) - glm::dvec2(listed);
            result.worst = std::max(result.worst, glm::length(off));
            ++result.pixels;
        }
    }
    return result;
}

testing::AssertionResult as_listed(const Scene& scene, const Film& film, const Row& row,
                                   EyeVector of) {
    const auto [worst, pixels] = difference(scene, film, row, of);
    if (pixels > 30 && worst <= row.tolerance) return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << row.id << ": off by " << worst << " over " << pixels << " pixels";
}

glm::dmat4 tilted(double degrees) {
    return translation({0, 0, 2.2}) * rotation(-degrees, {1, 0, 0});
}

TEST(PublishedVectors, ComeFromTheVerticesOfShearedQuads) {
    for (const Row& row : vector_rows) {
        const Scene scene = scene_of(mapped(make_quad(2), sheared), tilted(75), row.id);
        const Film film = picture(scene);
        EXPECT_TRUE(as_listed(scene, film, row, of_the_vertices));
        EXPECT_FALSE(as_listed(scene, film, row, of_the_fragment)) << row.id;
        // Not rounding.
        EXPECT_GT(difference(scene, film, row, of_the_fragment).worst, 3e-3) << row.id;
    }
}

/// Spheres of few facets, whose vertices' axes differ by 45 degrees.
TEST(PublishedVectors, ComeFromTheVerticesOfCurvedMeshes) {
    const Mesh sphere = make_sphere(1.2, 8, 6);
    for (const Row& row : vector_rows) {
        for (const glm::dmat2& map : {glm::dmat2(1), mirrored, rotated_uv}) {
            for (const glm::dmat4& transform :
                 {rotation(50, {1, 2, 0.5}), rotation(50, {1, 2, 0.5}) * scaling({1, 0.6, 1.3}),
                  scaling({-1, 1, 1}) * rotation(20, {0, 1, 1})}) {
                const Scene scene = scene_of(mapped(sphere, map), transform, row.id);
                const Film film = picture(scene);
                EXPECT_TRUE(as_listed(scene, film, row, of_the_vertices));
                EXPECT_FALSE(as_listed(scene, film, row, of_the_fragment)) << row.id;
            }
        }
    }
}

/// A near plane through the mesh: where both pictures show it, they show the same.
TEST(PublishedVectors, SurviveClipping) {
    for (const Row& row : vector_rows) {
        const auto scene = [&](double near) {
            return scene_of(make_sphere(1.2, 8, 6), rotation(50, {1, 2, 0.5}), row.id, near);
        };
        const Film whole = take(render, scene(0.1), {"A", "id.primitive", "uv", "hit"});
        const Film cut = take(render, scene(3.1), {"A", "id.primitive", "uv", "hit"});
        int compared = 0;
        for (int y = 0; y < 32; ++y) {
            for (int x = 0; x < 32; ++x) {
                if (bits(whole, "id.primitive", x, y) != bits(cut, "id.primitive", x, y)) continue;
                if (value(whole, "A", x, y) == 0) continue;
                const auto shift = [&](const Film& film) {
                    return glm::dvec2(value(film, "hit.U", x, y) - value(film, "uv.U", x, y),
                                      value(film, "hit.V", x, y) - value(film, "uv.V", x, y));
                };
                EXPECT_LT(glm::length(shift(whole) - shift(cut)), 2e-3) << row.id;
                ++compared;
            }
        }
        EXPECT_GT(compared, 50);
    }
}

// ---- FlightGear's normal map --------------------------------------------------------------------

/// The listing's axes at a fragment: unit at the vertices, interpolated; `normalised`: and made
/// unit again, which the listing does not do.
glm::dvec3 renk_normal(const Scene& scene, const Corners& corners, const glm::dvec3& b,
                       bool normalised) {
    using Vertex = listings::WelshVertex;
    const glm::dmat3 gl_NormalMatrix(glm::transpose(glm::inverse(
        glm::dmat3(glm::dmat4(scene.camera.view) * glm::dmat4(scene.objects[0].transform)))));
    const auto axis = [&](Vec3 Vertex::*attribute) {
        glm::dvec3 sum(0);
        for (int v = 0; v < 3; ++v) {
            const Vertex& vertex = corners.vertex[static_cast<std::size_t>(v)];
            sum += glm::normalize(gl_NormalMatrix * glm::dvec3(vertex.*attribute)) * b[v];
        }
        return normalised ? glm::normalize(sum) : sum;
    };
    // N = normal_texel.rgb * 2.0 - 1.0, of a map of one colour
    const glm::dvec3 N = glm::dvec3(0.8f, 0.3f, 0.7f) * 2.0 - 1.0;
    return glm::normalize(axis(&Vertex::tangent) * N.x + axis(&Vertex::binormal) * N.y +
                          axis(&Vertex::normal) * N.z);
}

/// Largest distance of N from the listing's.
double normal_difference(const Scene& scene, bool normalised) {
    const Film film = take(render, scene, {"A", "id.primitive", "bary", "N"});
    const ShearedObject object(scene);
    double worst = 0;
    for (int y = 0; y < scene.height; ++y) {
        for (int x = 0; x < scene.width; ++x) {
            const auto at = [&](const char* channel) { return value(film, channel, x, y); };
            if (at("A") == 0) continue;
            const glm::dvec3 expected =
                renk_normal(scene, object.corners(bits(film, "id.primitive", x, y)),
                            {at("bary.0"), at("bary.1"), at("bary.2")}, normalised);
            const glm::dvec3 N(at("N.X"), at("N.Y"), at("N.Z"));
            worst = std::max(worst, glm::length(N - expected));
        }
    }
    return worst;
}

TEST(PublishedVectors, OfFlightGearsNormalMapAreUnitAtTheVertices) {
    for (const glm::dmat2& map : {glm::dmat2(1), mirrored, rotated_uv, sheared}) {
        Scene scene = scene_of(mapped(make_sphere(1.2, 8, 6), map),
                               rotation(50, {1, 2, 0.5}) * scaling({1, 0.6, 1.3}), "none");
        scene.materials[0].surface.id = "normal-map-flightgear@published";
        scene.materials[0].textures["normal"] =
            texture(write_texture("lean.exr", 2, [](int, int, int c) {
                return c == 0 ? 0.8 : c == 1 ? 0.3 : 0.7;
            }));
        EXPECT_LT(normal_difference(scene, false), 2e-6);
        EXPECT_GT(normal_difference(scene, true), 1e-3);
    }
}

// ---- One scale for Rabbid76's frame and normals -------------------------------------------------

Scene rabbid_scene(const std::string& surface, float depth, bool in_tiles) {
    Scene scene = scene_of(make_quad(4), tilted(40), "none");
    Material& material = scene.materials[0];
    material.frame.id = "frame-inverse-tbn@published";
    material.surface.id = surface;
    material.textures["height"] = noise_texture("g");
    material.depth = depth;
    material.depth_in_tiles = in_tiles;
    return scene;
}

/// {"thickness": 0.05, "tile": 1} on tiles of 4 units is u_displacement_scale 0.05, as a depth of
/// 0.05 is: the same normals and the same K.
TEST(PublishedScale, IsOneNumberForFrameAndNormals) {
    for (const char* surface :
         {"h2n-gather@published", "h2n-4tap@published", "h2n-sobel@published"}) {
        const auto film = [&](float depth, bool in_tiles) {
            return take(render, rabbid_scene(surface, depth, in_tiles), {"N", "K"});
        };
        const Film in_tiles = film(0.05f, true);
        EXPECT_TRUE(same_bits(in_tiles, film(0.05f, false))) << surface;
        const Film thick = film(0.2f, false);
        EXPECT_FALSE(same_bits(with_planes(in_tiles, {"N.X"}), with_planes(thick, {"N.X"})));
        EXPECT_FALSE(same_bits(with_planes(in_tiles, {"K.U"}), with_planes(thick, {"K.U"})));
    }
}

}  // namespace
}  // namespace quadrel::render_tests
