// From a scene's mesh to the frames of its fragments: tangents of vertices, by way of transforms,
// texture matrices, mirroring and clipping, against the frame of the triangle.
#include "quadrel/scene/tangents.hpp"
#include "relief/frame_listings.hpp"
#include "render/planted.hpp"
#include "render/primitive_frame.hpp"
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

// ---- The vertex program of Welsh ----------------------------------------------------------------

/// The rows of frame-vertex@published are the program's output, in object space.
TEST(VertexFrames, PublishedRowsAreTheVertexProgram) {
    const Mesh mesh = make_quad(2, 1, 1);
    const glm::mat4 model_view(translation({0.3, -0.2, -4}) * rotation(50, {1, 2, 3}) *
                               scaling({1, 2, 0.5}));
    std::vector<glm::vec3> eye;
    for (const glm::vec3& p : mesh.positions) eye.emplace_back(model_view * glm::vec4(p, 1));
    const PrimitiveFrames frames(mesh, model_view, eye, mesh.uvs, "frame-vertex@published");
    AssembledTriangle whole{};
    for (std::size_t v = 0; v < 3; ++v) whole.weights[v].perspective[static_cast<int>(v)] = 1;
    const PrimitiveFrame row = frames.of(whole, {0, {0, 1, 2}});
    const glm::mat4 mvit(glm::transpose(glm::inverse(glm::dmat4(model_view))));
    for (int v = 0; v < 3; ++v) {
        listings::WelshVertex program;
        // Row 3 of the inverse transpose.
        program.eye = {mvit[0][3], mvit[1][3], mvit[2][3]};
        program.tangent = {1, 0, 0};
        program.binormal = {0, 1, 0};
        program.normal = {0, 0, 1};
        program.position = mesh.positions[mesh.triangles[0][static_cast<std::size_t>(v)]];
        program.main();
        for (int c = 0; c < 3; ++c) EXPECT_EQ(row.tangent[v][c], program.texcoord3[c]) << v;
    }
}

}  // namespace
}  // namespace quadrel::render_tests
