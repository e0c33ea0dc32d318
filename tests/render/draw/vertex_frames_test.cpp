// From a scene's mesh to the frames of its fragments: tangents of vertices, by way of transforms,
// texture matrices, mirroring and clipping, against the frame of the triangle.
#include "quadrel/scene/tangents.hpp"
#include "render/draw/primitive_vertices.hpp"
#include "render/planted.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

/// A slanted plane of many triangles, partly outside of the picture, under a frame.
Scene plane_scene(const std::string& frame, const glm::dmat4& transform,
                  const glm::dmat4& texture_matrix = glm::dmat4(1.0)) {
    Scene scene = empty_scene(32, 24);
    set_perspective_camera(scene, {0, 0, 4}, {.near = 3.5, .far = 50});
    Material material = plain_material("plane");
    material.frame.id = frame;
    material.depth = 0.1f;
    material.texture_matrix = glm::mat4(texture_matrix);
    scene.materials = {material};
    add_object(scene, make_quad(4, 3, 2), 0, rotation(40, {1, 2, 0.5}) * transform);
    return scene;
}

/// K of both frames agree in every pixel, up to `tolerance` of its length.
testing::AssertionResult same_shift(const Renderer& renderer, const Scene& a, const Scene& b,
                                    double tolerance = 1e-4) {
    const Film of_a = take(renderer, a, {"A", "K"}), of_b = take(renderer, b, {"A", "K"});
    int compared = 0;
    double worst = 0;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            if (value(of_a, "A", x, y) == 0) continue;
            ++compared;
            const glm::dvec2 first(value(of_a, "K.U", x, y), value(of_a, "K.V", x, y));
            const glm::dvec2 second(value(of_b, "K.U", x, y), value(of_b, "K.V", x, y));
            worst = std::max(worst, length(first - second) / (length(first) + 1e-6));
        }
    }
    if (compared > 100 && worst <= tolerance) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "off by " << worst << " over " << compared << " pixels";
}

const std::pair<const char*, glm::dmat4> transforms[] = {
    {"none", glm::dmat4(1.0)},
    {"mirror", scaling({-1, 1, 1})},
    {"uniform scale", scaling(glm::dvec3(1.5))},
    {"scale along an axis", scaling({0.5, 2, 3})},
};

TEST(VertexFrames, AgreeWithTheTriangleUnderTransforms) {
    for (const auto& [name, transform] : transforms) {
        const Scene exact = plane_scene("frame-face", transform);
        for (const char* frame : {"frame-gram", "frame-vertex", "frame-mikkt", "frame-cot"})
            EXPECT_TRUE(same_shift(render, exact, plane_scene(frame, transform)))
                << frame << ", " << name;
    }
    EXPECT_FALSE(same_shift(render, plane_scene("frame-face", glm::dmat4(1.0)),
                            plane_scene("frame-vertex", scaling({-1, 1, 1}))));
}

TEST(VertexFrames, FollowTheTextureMatrix) {
    for (const glm::dmat4& map : {rotation(30, {0, 0, 1}), scaling({3, 0.25, 1}),
                                  scaling({-1, 1, 1}) * rotation(70, {0, 0, 1})}) {
        const Scene exact = plane_scene("frame-face", glm::dmat4(1.0), map);
        for (const char* frame : {"frame-vertex", "frame-mikkt"})
            EXPECT_TRUE(same_shift(render, exact, plane_scene(frame, glm::dmat4(1.0), map)))
                << frame;
    }
}

/// The file's tangents, in glTF's sense of the bitangent, serve as well as those made here; a sense
/// that the file has wrong does not turn the search.
TEST(VertexFrames, TakeTheMeshsOwnTangents) {
    const Scene made = plane_scene("frame-mikkt", glm::dmat4(1.0));
    for (const float w : {-1.0f, 1.0f}) {
        Scene own = made;
        own.meshes[0].tangents.assign(own.meshes[0].positions.size(), glm::vec4(1, 0, 0, w));
        EXPECT_TRUE(same_shift(render, made, own)) << w;
        const Film film = take(render, own, {"A", "B.X"});
        const Film expected = take(render, made, {"A", "B.X"});
        const double side = value(film, "B.X", 16, 12) * value(expected, "B.X", 16, 12);
        EXPECT_EQ(side > 0, w < 0);  // glTF's bitangent points against v
    }
    Scene turned = made;
    turned.meshes[0].tangents.assign(turned.meshes[0].positions.size(), glm::vec4(0, 1, 0, -1));
    EXPECT_FALSE(same_shift(render, made, turned));
}

/// On a curved surface averages differ from the facets, by about the facets' angle.
TEST(VertexFrames, AreSmoothOnASphere) {
    Scene vertex = plane_scene("frame-vertex", glm::dmat4(1.0));
    vertex.meshes[0] = make_sphere(1.2, 48, 48);
    Scene face = vertex;
    face.materials[0].frame.id = "frame-face";
    const Film film = take(render, vertex, {"A", "J.U.X", "J.U.Y", "J.U.Z"}),
               flat = take(render, face, {"A", "J"});
    int compared = 0;
    for (int y = 8; y < 16; ++y) {
        for (int x = 12; x < 20; ++x) {
            if (value(film, "A", x, y) == 0) continue;
            const auto row = [&](const Film& f) {
                return glm::dvec3(value(f, "J.U.X", x, y), value(f, "J.U.Y", x, y),
                                  value(f, "J.U.Z", x, y));
            };
            EXPECT_LT(length(row(film) - row(flat)), 0.15 * length(row(flat)));
            ++compared;
        }
    }
    EXPECT_GT(compared, 30);
}

// ---- What vertex programs read ------------------------------------------------------------------

AssembledTriangle whole_triangle() {
    AssembledTriangle whole{};
    for (std::size_t v = 0; v < 3; ++v) whole.weights[v].perspective[v] = 1;
    return whole;
}

glm::vec3 as_vector(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

/// The mesh's attributes in object space, in the order in which the corners are drawn, and the
/// transforms there and back.
TEST(VertexRows, HoldTheMeshsAttributes) {
    const Mesh mesh = make_quad(2, 1, 1);
    const glm::mat4 model_view(translation({0.3, -0.2, -4}) * rotation(50, {1, 2, 3}) *
                               scaling({1, 2, 0.5}));
    const VertexRows rows(mesh, model_view, mesh.uvs);
    const std::array<std::uint32_t, 3> turned{0, 2, 1};
    const PrimitiveVertices row = rows.of(whole_triangle(), {0, turned});
    for (std::size_t v = 0; v < 3; ++v) {
        const std::uint32_t index = mesh.triangles[0][turned[v]];
        EXPECT_EQ(as_vector(row.position[v]), mesh.positions[index]);
        EXPECT_EQ(as_vector(row.normal[v]), mesh.normals[index]);
        EXPECT_EQ(as_vector(row.tangent[v]), glm::vec3(1, 0, 0));
        EXPECT_EQ(as_vector(row.binormal[v]), glm::vec3(0, 1, 0));
        EXPECT_EQ(glm::vec2(row.uv[v][0], row.uv[v][1]), mesh.uvs[index]);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(row.weights[v][i], v == i ? 1.0f : 0.0f);
    }
    // Row 3 of the inverse transpose: the eye in object space.
    const glm::mat4 mvit(glm::transpose(glm::inverse(glm::dmat4(model_view))));
    for (int r = 0; r < 3; ++r) {
        EXPECT_EQ(row.to_object[4 * r + 3], mvit[r][3]);
        for (int c = 0; c < 4; ++c) EXPECT_EQ(row.to_eye[4 * r + c], model_view[c][r]);
    }
}

/// Binormals run along growing v, against glTF's; tangents of the file do not survive a texture
/// matrix that turns the map.
TEST(VertexRows, TakeTheMeshsOwnTangents) {
    Mesh mesh = make_quad(2, 1, 1);
    mesh.tangents.assign(mesh.positions.size(), glm::vec4(0, 2, 0, -1));
    const VertexRows own(mesh, glm::mat4(1), mesh.uvs);
    const PrimitiveVertices row = own.of(whole_triangle(), {0, {0, 1, 2}});
    EXPECT_EQ(as_vector(row.tangent[0]), glm::vec3(0, 1, 0));
    EXPECT_EQ(as_vector(row.binormal[0]), glm::vec3(-1, 0, 0));
    std::vector<glm::vec2> turned;
    for (const glm::vec2& uv : mesh.uvs) turned.emplace_back(-uv.y, uv.x);
    const VertexRows made(mesh, glm::mat4(1), turned);
    const PrimitiveVertices of_uv = made.of(whole_triangle(), {0, {0, 1, 2}});
    EXPECT_EQ(as_vector(of_uv.tangent[0]), glm::vec3(0, -1, 0));
    EXPECT_EQ(as_vector(of_uv.binormal[0]), glm::vec3(1, 0, 0));
}

/// A mesh without normals has those of its triangles; one without a map no tangents.
TEST(VertexRows, StandInForWhatIsMissing) {
    Mesh mesh = triangle({0, 0, 0}, {0, 0, -2}, {0, 2, 0});
    mesh.uvs.clear();
    const std::vector<glm::vec2> none(3);
    const VertexRows rows(mesh, glm::mat4(1), none);
    const PrimitiveVertices row = rows.of(whole_triangle(), {0, {0, 1, 2}});
    EXPECT_EQ(as_vector(row.normal[1]), glm::vec3(1, 0, 0));
    EXPECT_EQ(as_vector(row.tangent[1]), glm::vec3(0));
}

}  // namespace
}  // namespace quadrel::render_tests
