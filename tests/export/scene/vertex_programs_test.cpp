// What stages compute at the vertices, in exported scenes: Quadrel's own values among the vertices,
// and a program that has no more attributes than a GPU.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>

#include "export/scene/content.hpp"
#include "export/scene/judge_page.hpp"
#include "export/scene/judged.hpp"
#include "export/scene/small_scenes.hpp"
#include "quadrel/num/math.hpp"
#include "render/draw/geometry.hpp"

namespace quadrel::export_tests {
namespace {

SceneExport without_reference() {
    SceneExport options;
    options.reference = false;
    return options;
}

using Bits = std::vector<std::uint32_t>;

/// The floats of an attribute of the vertex that an index names; none if vertices have none of it.
Bits attribute_bits(const VertexBuffers& buffers, std::uint32_t index, const std::string& name) {
    const float* const all =
        buffers.vertices.data() + std::size_t(index) * std::size_t(buffers.floats_a_vertex());
    for (const VertexAttribute& of : buffers.attributes) {
        if (of.name != name) continue;
        Bits bits(std::size_t(of.components));
        std::memcpy(bits.data(), all + of.offset / int(sizeof(float)), bits.size() * sizeof(float));
        return bits;
    }
    return {};
}

Bits bits_of(const vec3<float>& v) {
    return {std::bit_cast<std::uint32_t>(v.x), std::bit_cast<std::uint32_t>(v.y),
            std::bit_cast<std::uint32_t>(v.z)};
}

vec3<float> at(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

/// The vector to the eye along the axes of a vertex, as Welsh's program has it.
vec3<float> eye_vector(const PrimitiveVertices& row, int v) {
    const float* const m = row.to_object;
    const auto component = [&](int r) {
        const vec3<float> of_row(m[4 * r], m[4 * r + 1], m[4 * r + 2]);
        return dot(of_row, vec3<float>(0.0f)) + m[4 * r + 3] * 1.0f;
    };
    const vec3<float> eye(component(0), component(1), component(2));
    const vec3<float> way = eye - at(row.position[v]);
    return {dot(way, at(row.tangent[v])), dot(way, at(row.binormal[v])),
            dot(way, at(row.normal[v]))};
}

/// Of the corners that Quadrel draws, those whose eye vector no vertex at their place has; -1 if
/// there are none. `turn`: of what Quadrel has.
int wrong_eye_vectors(const Scene& scene, float turn) {
    const ExportContent content = export_content(scene, without_reference());
    const Geometry geometry = assemble_geometry(scene, scene_hardware(scene), {false, true, false});
    std::map<Bits, std::vector<Bits>> known;  // by position
    for (const std::uint32_t index : content.buffers.indices)
        known[attribute_bits(content.buffers, index, "position")].push_back(
            attribute_bits(content.buffers, index, "shaded_frame_vertex_published_vertex_eye"));
    int wrong = 0, seen = 0;
    for (const PrimitiveVertices& row : geometry.vertices)
        for (int v = 0; v < 3; ++v, ++seen) {
            const auto& found = known[bits_of(at(row.position[v]))];
            const Bits expected = bits_of(eye_vector(row, v) * turn);
            wrong += std::find(found.begin(), found.end(), expected) == found.end();
        }
    return seen > 0 ? wrong : -1;
}

TEST(SceneVertexPrograms, VerticesHaveWhatQuadrelInterpolates) {
    const SmallScenes scenes;
    for (const char* name : {"thesis-quad", "thesis-icosahedron"}) {
        Scene scene = scenes.load(name, {"material.relief.frame=frame-vertex@published"});
        EXPECT_EQ(wrong_eye_vectors(scene, 1), 0) << name;
        EXPECT_GT(wrong_eye_vectors(scene, -1), 0) << name;
        // Normals of faces.
        for (Mesh& mesh : scene.meshes) mesh.normals.clear();
        EXPECT_EQ(wrong_eye_vectors(scene, 1), 0) << name;
    }
}

/// Of a vertex shader, "location name" of each attribute.
std::vector<std::string> declared_attributes(const std::string& text) {
    const std::string word = "layout(location = ";
    std::vector<std::string> found;
    for (std::size_t begin = text.find(word); begin != std::string::npos;
         begin = text.find(word, begin + 1)) {
        const std::string line = text.substr(begin, text.find(';', begin) - begin);
        const std::size_t number = word.size(), end = line.find(')');
        found.push_back(line.substr(number, end - number) + line.substr(line.rfind(' ')));
    }
    return found;
}

std::vector<std::string> had_attributes(const VertexBuffers& buffers) {
    std::vector<std::string> all;
    for (const VertexAttribute& of : buffers.attributes)
        all.push_back(std::to_string(of.location) + " " + of.name);
    return all;
}

/// What is declared and vertices do not have.
int lacking(const ExportContent& content) {
    const std::vector<std::string> had = had_attributes(content.buffers);
    int wrong = 0;
    for (const ContentMaterial& material : content.materials)
        for (const std::string& of : declared_attributes(material.program.vertex))
            wrong += std::find(had.begin(), had.end(), of) == had.end();
    return wrong;
}

TEST(SceneVertexPrograms, HaveNoMoreAttributesThanGpus) {
    const SmallScenes scenes;
    Scene scene = scenes.load("rows/shadow-soft-pom-published");
    const ExportContent few = export_content(scene, without_reference());
    EXPECT_EQ(lacking(few), 0);
    EXPECT_LT(few.buffers.attributes.size(), most_vertex_attributes);
    // A varying for each light, of which only the first have an attribute each.
    scene.lights.resize(max_lights, scene.lights.front());
    ExportContent many = export_content(scene, without_reference());
    EXPECT_EQ(lacking(many), 0);
    EXPECT_EQ(many.buffers.attributes.size(), most_vertex_attributes);
    const auto place_of_call = [](const ExportContent& content, int light) {
        return content.materials.at(0).program.vertex.find(
            "    vertex_shadow_shadow_soft_pom_published_light" + std::to_string(light) + "(");
    };
    const auto place_of_branch = [](const ExportContent& content) {
        return content.materials.at(0).program.vertex.find("#if SHADED_VERTICES");
    };
    EXPECT_GT(place_of_call(few, 0), place_of_branch(few));
    EXPECT_GT(place_of_call(many, 0), place_of_branch(many));
    EXPECT_LT(place_of_call(many, max_lights - 1), place_of_branch(many));
    // One that is declared elsewhere is noticed.
    many.buffers.attributes.back().location += 1;
    EXPECT_EQ(lacking(many), 1);
}

/// A page whose frame and light are made at the vertices.
std::string page_of_vertex_programs() {
    const Scene scene = load_scene(
        "bricks-45", {test::sanitized ? "size=[8,8]" : "size=[16,12]", "camera.fov_y=2",
                      "hardware=chromium", "material.relief.frame=frame-vertex@published",
                      "material.relief.trace=parallax-bias", "material.relief.shadow=shadow-none",
                      "material.shade=shade-welsh@published", "material.gloss=null",
                      "textures.bricks-color.file=" QUADREL_DATA_DIR "/textures/calibration.exr"});
    return judge_page(scene, {{}, "gl,snapping=0.0625"});
}

TEST_F(JudgePageInABrowser, FindsWhatVertexProgramsMakeLegal) {
    const std::string page = page_of_vertex_programs();
    const Judged shaded(page, "");
    ASSERT_EQ(shaded.error(), "");
    EXPECT_EQ(shaded.failing(), 0) << shaded.verdict().dump(1);
    // The same by the vertex shader's own arithmetic.
    const std::string by_matrices =
        with_planted(page, "#define SHADED_VERTICES 1", "#define SHADED_VERTICES 0");
    const Judged transformed(by_matrices, "");
    ASSERT_EQ(transformed.error(), "");
    EXPECT_EQ(transformed.failing(), 0) << transformed.verdict().dump(1);
    const Judged wrong(with_planted(by_matrices, "= target_ - position", "= target_ + position"),
                       "");
    EXPECT_GT(wrong.failing(), 0) << wrong.error();
    EXPECT_EQ(wrong.first_to_leave().substr(0, 2), "K.") << wrong.first_to_leave();
}

}  // namespace
}  // namespace quadrel::export_tests
