// Meshes from files, as far as the picture: small files of kinds that readers get wrong.
#include <cmath>

#include "quadrel/scene/load.hpp"
#include "quadrel/stats.hpp"
#include "render/films.hpp"

namespace quadrel::render_tests {
namespace {

const std::string folder = QUADREL_DATA_DIR "/../tests/data/meshes/";

Film render_mesh(const std::string& file, const std::vector<std::string>& channels,
                 std::vector<std::string> overrides = {}) {
    overrides.insert(overrides.begin(), "objects[0].mesh.file=" + file);
    return take(render, load_scene(folder + "view.json", overrides), channels);
}

/// uv.U at a pixel of the square in the view.
float u_at(const std::string& file, int x, int y) {
    return value(render_mesh(file, {"uv"}), "uv.U", x, y);
}

TEST(MeshFilesRendered, ObjMarksCommentsAndLineEnds) {
    for (const char* file : {"silent.obj", "bad.obj", "bom_silent.obj", "cr.obj"}) {
        EXPECT_EQ(u_at(file, 8, 32), 8.5f / 64) << file;
        EXPECT_EQ(value(render_mesh(file, {"A"}), "A", 60, 60), 1) << file;
    }
}

TEST(MeshFilesRendered, GltfContainersAndExtensions) {
    for (const char* file : {"emptybin.glb", "EXT_texture_webp.gltf", "KHR_texture_basisu.gltf"})
        EXPECT_EQ(u_at(file, 8, 32), 8.5f / 64) << file;
}

TEST(MeshFilesRendered, NormalsOfTwoPrimitives) {
    const Film film = render_mesh("mixed.gltf", {"N"});
    EXPECT_NEAR(value(film, "N.X", 16, 32), 0.6f, 1e-6);
    EXPECT_NEAR(value(film, "N.Z", 16, 32), 0.8f, 1e-6);
    EXPECT_EQ(value(film, "N.X", 48, 32), 0);
    EXPECT_EQ(value(film, "N.Z", 48, 32), 1);
}

TEST(MeshFilesRendered, QuantisedTextureCoordinates) {
    // Its image is nowhere; the transform of its texture is the mesh's, too.
    const Film film = render_mesh("q.gltf", {"uv"}, {"objects[0].mesh.materials=false"});
    EXPECT_NEAR(value(film, "uv.U", 16, 20), 16.5 / 64, 1e-6);
    EXPECT_NEAR(value(film, "uv.V", 16, 20), 20.5 / 64, 1e-6);
}

TEST(MeshFilesRendered, MorphTargetsAndSetsOfTextureCoordinates) {
    EXPECT_EQ(value(render_mesh("morph.gltf", {"Z"}), "Z", 32, 32), 2.5f);
    const Film first = render_mesh("uv1.gltf", {"uv"});
    const Film second = render_mesh("uv1.gltf", {"uv"}, {"objects[0].mesh.uv_set=1"});
    EXPECT_EQ(value(first, "uv.U", 8, 32), 0) << "the first set is one point";
    EXPECT_EQ(value(second, "uv.U", 8, 32), 8.5f / 64);
}

TEST(MeshFilesRendered, IgnoredPartsAreNotes) {
    const auto notes = [](const std::string& file) {
        return load_scene(folder + "view.json", {"objects[0].mesh.file=" + file}).notes;
    };
    EXPECT_TRUE(notes("bad.obj").empty());
    ASSERT_EQ(notes("EXT_texture_webp.gltf").size(), 1u);
    EXPECT_NE(notes("EXT_texture_webp.gltf")[0].find("ignored: EXT_texture_webp"),
              std::string::npos);
    EXPECT_NE(notes("uv1.gltf")[0].find("ignored: TEXCOORD_1"), std::string::npos);
}

// ---- Faces without a map

/// The textured half of the square is not flagged, the other is, and nothing of both is NaN.
testing::AssertionResult flags_the_untextured_half(const Film& film) {
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const auto flags = film.find("hit.flags")->bits[film.index(x, y)];
            const auto status = film.find("hit.status")->bits[film.index(x, y)];
            if (status != 1 || (flags & 1) != (x < 32 ? 0u : 1u))
                return testing::AssertionFailure()
                       << "at " << x << ", " << y << ": status " << status << ", flags " << flags;
            for (const char* channel : {"hit.U", "hit.V", "N.X", "N.Y", "N.Z", "J.Ux"})
                if (film.find(channel) && std::isnan(value(film, channel, x, y)))
                    return testing::AssertionFailure() << channel << " at " << x << ", " << y;
        }
    return testing::AssertionSuccess();
}

TEST(MeshFilesRendered, UntexturedFacesAreFlagged) {
    for (const char* frame : {"frame-gram", "frame-thesis", "frame-cot", "frame-face",
                              "frame-mikkt", "frame-inverse-tbn", "frame-vertex"}) {
        const auto render_half = [&](const char* file) {
            return render_mesh(
                file, {"hit", "N"},
                {"material.relief.frame=" + std::string(frame), "material.height={\"noise\": {}}",
                 "material.relief.trace=linear", "material.relief.steps=4"});
        };
        EXPECT_TRUE(flags_the_untextured_half(render_half("half.obj"))) << frame;
        EXPECT_FALSE(flags_the_untextured_half(render_half("bad.obj"))) << frame;
    }
}

// ---- Normals that are none

/// Nothing is NaN, and the normal is the square's.
testing::AssertionResult faces_the_viewer(const Film& film) {
    for (const Plane& plane : film.planes)
        for (int i = 0; i < 64 * 64; ++i)
            if (std::isnan(plane.as_float(static_cast<std::size_t>(i))))
                return testing::AssertionFailure() << plane.name;
    if (value(film, "N.Z", 20, 30) != 1) return testing::AssertionFailure() << "another normal";
    return testing::AssertionSuccess();
}

TEST(MeshFilesRendered, NullNormalsAreNoNaN) {
    const std::vector<std::string> channels = {"R", "G", "B", "N", "Ng", "J", "K", "r", "hit"};
    for (const char* frame : {"frame-gram", "frame-thesis", "frame-mikkt"})
        EXPECT_TRUE(faces_the_viewer(
            render_mesh("zero_vn.obj", channels, {"material.relief.frame=" + std::string(frame)})));
    // The check is worth something: a mesh made past the door has the NaN.
    Scene scene = load_scene(folder + "view.json", {"objects[0].mesh.file=bad.obj"});
    scene.meshes[0].normals.assign(scene.meshes[0].positions.size(), glm::vec3(0.0f));
    EXPECT_FALSE(faces_the_viewer(take(render, scene, channels)));
}

/// A triangle without area is none, even where rounding to pixels would give it some.
TEST(MeshFilesRendered, TrianglesWithoutAreaAreNotDrawn) {
    Scene scene = load_scene(folder + "view.json", {"objects[0].mesh.file=bad.obj"});
    Mesh& mesh = scene.meshes[0];
    mesh.positions = {{-0.9f, -0.7f, 0}, {0.9f, 0.7f, 0}, {0.9f, 0.7f, 0}};
    mesh.triangles = {{0, 1, 2}};
    mesh.uvs.resize(3);
    RenderStats stats;
    RenderOptions options;
    options.stats = &stats;
    const Film film = render(scene, options);
    EXPECT_EQ(stats.primitives.submitted, 1u);
    EXPECT_EQ(stats.primitives.zero_area, 1u);
}

}  // namespace
}  // namespace quadrel::render_tests
