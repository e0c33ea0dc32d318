// OBJ as exporters write it: marks, comments, line ends, faces that lack something.
#include <gtest/gtest.h>

#include "io/mesh/mesh_properties.hpp"
#include "quadrel/scene/mesh_file.hpp"
#include "scene/planted.hpp"
#include "scene/support.hpp"

namespace quadrel {
namespace {

using planted::ObjDefect;

class ObjFiles : public testing::Test {
  protected:
    MeshFile read(const std::string& text) const {
        return read_mesh_file(folder.write("m.obj", text));
    }
    Mesh obj(const std::string& text) const { return read(text).mesh; }
    /// Whether a text gives the plain square's mesh.
    testing::AssertionResult is_square(const std::string& text) const;

    TemporaryFolder folder;
};

const std::string square =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";

testing::AssertionResult ObjFiles::is_square(const std::string& text) const {
    const Mesh plain = obj(square);
    try {
        const Mesh mesh = obj(text);
        if (mesh.positions == plain.positions && mesh.uvs == plain.uvs &&
            mesh.triangles == plain.triangles)
            return testing::AssertionSuccess();
        return testing::AssertionFailure() << "another mesh";
    } catch (const InputError& error) {
        return testing::AssertionFailure() << error.what();
    }
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; at += by.size())
        text.replace(at, what.size(), by);
    return text;
}

/// `text` as a reader with the defect understands it.
std::string misread(std::string text, ObjDefect defect) {
    if (defect == ObjDefect::comments_continue) text = replaced(text, "\\\n", " ");
    if (defect == ObjDefect::mark_is_a_word) text = replaced(text, "\xef\xbb\xbfv", "x");
    if (defect == ObjDefect::cr_is_a_blank) text = replaced(text, "\r", " ");
    return text;
}

TEST_F(ObjFiles, CommentsEndWithTheirLine) {
    const std::string comment = "# from D:\\meshes\\\n";
    EXPECT_TRUE(is_square(comment + square));
    EXPECT_TRUE(is_square(replaced(square, "vt 0 0\n", "vt 0 0 # C:\\\n")));
    EXPECT_TRUE(is_square(replaced(square, "2/2", "2/2 \\\n")));
    EXPECT_TRUE(is_square(replaced(square, "2/2", "2/2 \\ \r\n\\\n")));
    EXPECT_TRUE(is_square(replaced(square, "4/4", "4/4#\\")));
    EXPECT_FALSE(is_square(misread(comment + square, ObjDefect::comments_continue)));
}

TEST_F(ObjFiles, ByteOrderMark) {
    EXPECT_TRUE(is_square("\xef\xbb\xbf" + square));
    EXPECT_FALSE(is_square(misread("\xef\xbb\xbf" + square, ObjDefect::mark_is_a_word)));
}

TEST_F(ObjFiles, LineEnds) {
    const std::string old_mac = replaced(square, "\n", "\r");
    EXPECT_TRUE(is_square(old_mac));
    EXPECT_TRUE(is_square(replaced(square, "\n", "\r\n")));
    EXPECT_TRUE(is_square(replaced(square, "0\n", "0\r\r\n\r")));
    EXPECT_TRUE(is_square(replaced(replaced(square, "2/2", "2/2 \\\n"), "\n", "\r")));
    EXPECT_FALSE(is_square(misread(old_mac, ObjDefect::cr_is_a_blank)));
}

TEST_F(ObjFiles, ErrorsNameTheLineWhateverEndsIt) {
    for (const char* end : {"\n", "\r", "\r\n"})
        EXPECT_TRUE(complains([&] { obj(replaced("v 0 0 0\n\nv 1 0 0\nv x 1 0\n", "\n", end)); },
                              {"", "\"x\"", "finite", 4}));
    // Of a statement of several lines, where it begins; of a face, where it stands.
    EXPECT_TRUE(complains([&] { obj("v 0 0 0\nv 1 \\\n 0 \\\n y\n"); }, {"", "\"y\"", "", 2}));
    EXPECT_TRUE(complains([&] { obj("f 1 2 3\nv 0 0 0\nv 1 0 0\n"); },
                          {"", "position index 3", "of the 2", 1}));
}

TEST_F(ObjFiles, FacesMayComeBeforeTheirVertices) {
    const std::string face = "f 1/1 2/2 3/3 4/4\n";
    EXPECT_TRUE(is_square(face + replaced(square, face, "")));
}

TEST_F(ObjFiles, UntexturedFacesHaveADegenerateMap) {
    const Mesh mesh = obj(square + "v 2 0 0\nv 2 1 0\nf 2 5 6 3\n");
    ASSERT_EQ(mesh.triangles.size(), 4u);
    EXPECT_TRUE(is_consistent(mesh));
    for (std::size_t t = 0; t < 4; ++t) {
        const auto [a, b, c] = mesh.triangles[t];
        const glm::dvec2 ab(mesh.uvs[b] - mesh.uvs[a]), ac(mesh.uvs[c] - mesh.uvs[a]);
        EXPECT_EQ(ab.x * ac.y - ab.y * ac.x != 0, t < 2) << t;
    }
    // One corner without is as good as none.
    const Mesh half = obj(square + "v 2 0 0\nv 2 1 0\nf 2/1 5/2 6\n");
    EXPECT_EQ(half.uvs[half.triangles[2][0]], half.uvs[half.triangles[2][1]]);
    EXPECT_TRUE(obj(replaced(square, "f 1/1 2/2 3/3 4/4", "f 1 2 3 4")).uvs.empty());
}

/// Every corner has the normal that `expected` says for its triangle.
testing::AssertionResult has_normals(const Mesh& mesh, const std::vector<glm::vec3>& expected) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const std::uint32_t v : mesh.triangles[t]) {
            const glm::vec3 n = mesh.normals.empty() ? glm::vec3(0.0f) : mesh.normals[v];
            if (!(length(glm::dvec3(n) - glm::dvec3(expected[t])) < 1e-6))
                return testing::AssertionFailure()
                       << "triangle " << t << ": " << n.x << " " << n.y << " " << n.z;
        }
    return testing::AssertionSuccess();
}

TEST_F(ObjFiles, FacesWithoutNormalsAreFlatBesideOthers) {
    // The second square stands upright on the first; its corners are shared.
    const std::string corner = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 -1\nv 1 1 -1\n";
    const std::string first = "f 1//1 2//1 3//1 4//1\n", second = "f 2 5 6 3\n";
    const glm::vec3 given(0.6f, 0, 0.8f), face(1, 0, 0);
    const Mesh mesh = obj(corner + "vn .6 0 .8\n" + first + second);
    EXPECT_TRUE(is_consistent(mesh));
    EXPECT_TRUE(has_normals(mesh, {given, given, face, face}));
    EXPECT_FALSE(has_normals(mesh, {given, given, given, given}));
    EXPECT_TRUE(obj(corner + "vn .6 0 .8\nf 1 2 3 4\n" + second).normals.empty());
}

TEST_F(ObjFiles, NullNormalsAreTheFaces) {
    const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 -1\nv 1 1 -1\n";
    const std::string faces = "f 1//1 2//1 3//1 4//1\nf 2//1 5//1 6//1 3//1\n";
    // All of them: as if there were none.
    EXPECT_TRUE(obj(corners + "vn 0 0 0\n" + faces).normals.empty());
    const Mesh some = obj(corners + "vn 0 0 0\nvn 0 1 0\n" + faces + "f 1//2 2//2 3//2\n");
    const glm::vec3 up(0, 0, 1), right(1, 0, 0), given(0, 1, 0);
    EXPECT_TRUE(has_normals(some, {up, up, right, right, given}));
    EXPECT_EQ(some.positions.size(), 11u) << "corners of equal normals share a vertex";
}

TEST_F(ObjFiles, NormalsOfAnyLengthAreDirections) {
    for (const char* text : {"vn 0 0 1e-30\n", "vn 0 0 3e38\n", "vn 1e-45 0 0\n"}) {
        const Mesh mesh =
            obj("v 0 0 0\nv 1 0 0\nv 1 1 0\n" + std::string(text) + "f 1//1 2//1 3//1\n");
        ASSERT_EQ(mesh.normals.size(), 3u);
        EXPECT_NEAR(length(glm::dvec3(mesh.normals[0])), 1, 1e-6) << text;
    }
    // Others are nobody's business.
    EXPECT_EQ(obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 5\nf 1//1 2//1 3//1\n").normals[0],
              glm::vec3(0, 0, 5));
}

TEST_F(ObjFiles, FacesWithoutAreaGetSomeNormal) {
    const Mesh mesh =
        obj("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nvn 0 1 0\n"
            "f 1 2 3\nf 1 2 4\nf 1//1 2//1 4//1\n");
    EXPECT_TRUE(is_consistent(mesh));
    for (const auto& n : mesh.normals) EXPECT_NEAR(length(glm::dvec3(n)), 1, 1e-6);
}

TEST_F(ObjFiles, IgnoredStatementsAreNamedOnce) {
    using Names = std::vector<std::string>;
    EXPECT_EQ(read("o a\ng b c\ns off\n" + square).ignored, Names{});
    EXPECT_EQ(read("mtllib a.mtl\nusemtl b\nusemtl c\nl 1 2\n" + square).ignored,
              (Names{"mtllib", "usemtl", "l"}));
    EXPECT_EQ(read("s 1\n" + square).ignored, Names{"s"}) << "these faces would be smooth";
    EXPECT_EQ(
        read("s 1\nvn 0 0 1\n" + replaced(square, "f 1/1 2/2 3/3 4/4", "f 1//1 2//1 3//1")).ignored,
        Names{});
    EXPECT_EQ(read("\x1b\xff\x80x 1\n" + square).ignored, Names{"???x"}) << "names are text";
    std::string other;
    for (int i = 0; i < 1000; ++i) other += "word" + std::to_string(i) + "\n";
    EXPECT_EQ(read(other + square).ignored.size(), 17u);
}

TEST_F(ObjFiles, OneSetOfTextureCoordinates) {
    EXPECT_EQ(read(square).uv_sets, 1);
    EXPECT_EQ(read("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n").uv_sets, 0);
    MeshFileOptions second;
    second.uv_set = 1;
    const auto file = folder.write("m.obj", square);
    EXPECT_TRUE(complains([&] { read_mesh_file(file, second); }, {"", "uv_set 1", "OBJ has one"}));
}

}  // namespace
}  // namespace quadrel
