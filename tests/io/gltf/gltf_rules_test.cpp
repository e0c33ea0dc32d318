// What a glTF file must not do, as far as geometry is concerned: one line that says what and where.
#include <gtest/gtest.h>

#include "io/gltf/gltf_files.hpp"
#include "quadrel/scene/mesh_file.hpp"
#include "scene/support.hpp"

namespace quadrel {
namespace {

using nlohmann::json;

class GltfRules : public testing::Test {
  protected:
    testing::AssertionResult loads(const GltfBuilder& gltf) const {
        try {
            load_mesh(folder.write("m.glb", gltf.binary()));
            return testing::AssertionSuccess();
        } catch (const InputError& error) {
            return testing::AssertionFailure() << error.what();
        }
    }
    /// Whether the square is refused after `change`.
    template <class Change>
    testing::AssertionResult refused(const Change& change, const Complaint& complaint) const {
        GltfBuilder gltf = square_gltf();
        change(gltf.json);
        return complains([&] { load_mesh(folder.write("m.glb", gltf.binary())); }, complaint);
    }
    template <class Change>
    testing::AssertionResult accepted(const Change& change) const {
        GltfBuilder gltf = square_gltf();
        change(gltf.json);
        return loads(gltf);
    }
    TemporaryFolder folder;
};

// ---- Asset

TEST_F(GltfRules, Versions) {
    const auto version = [](const json& asset) { return [=](json& j) { j["asset"] = asset; }; };
    EXPECT_TRUE(accepted(version({{"version", "2.0"}, {"minVersion", "2.0"}})));
    EXPECT_TRUE(accepted(version({{"version", "2.1"}})));
    EXPECT_TRUE(accepted(version({{"version", "3.0"}, {"minVersion", "2.0"}})));
    EXPECT_TRUE(refused(version({{"version", "1.0"}}), {"asset.version", "1.0", "2.0"}));
    EXPECT_TRUE(refused(version({{"version", "3.0"}}), {"asset.version", "3.0", "2.0"}));
    EXPECT_TRUE(refused(version({{"version", "2.1"}, {"minVersion", "2.1"}}),
                        {"asset.minVersion", "2.1", "at most 2.0"}));
    EXPECT_TRUE(refused(version({{"version", "2.0"}, {"minVersion", "2.1"}}),
                        {"asset.minVersion", "2.1", "at most the version"}));
    for (const char* text : {"", "2", "2.", ".0", "2.00", "02.0", "2.0.0", "+2.0", "2.x", "2,0"})
        EXPECT_TRUE(refused(version({{"version", text}}), {"asset.version", text, "version"}))
            << text;
    EXPECT_TRUE(refused(version({{"version", 2.0}}), {"asset.version", "2.0", "version"}));
    EXPECT_TRUE(refused([](json& j) { j.erase("asset"); }, {"asset.version", "none", ""}));
}

/// glTF 1.0 has objects where 2.0 has arrays: what is wrong is the version.
TEST_F(GltfRules, FilesOfVersion1) {
    const auto file = folder.write(
        "m.gltf", R"({"asset": {"version": "1.0"}, "accessors": {"a": {}}, "nodes": {"n": {}}})");
    EXPECT_TRUE(complains([&] { load_mesh(file); }, {"asset.version", "1.0", "2.0"}));
}

TEST_F(GltfRules, Extensions) {
    const auto required = [](const char* name) {
        return
            [=](json& j) { j["extensionsUsed"] = j["extensionsRequired"] = json::array({name}); };
    };
    for (const char* name :
         {"EXT_texture_webp", "KHR_texture_basisu", "MSFT_texture_dds", "KHR_materials_unlit",
          "KHR_texture_transform", "KHR_mesh_quantization", "KHR_lights_punctual",
          "KHR_animation_pointer", "KHR_node_visibility", "EXT_lights_image_based"})
        EXPECT_TRUE(accepted(required(name))) << name;
    for (const char* name :
         {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression",
          "EXT_mesh_gpu_instancing", "EXT_mesh_primitive_restart", "ACME_materials", "KHR_texture"})
        EXPECT_TRUE(refused(required(name), {"extensionsRequired", name, ""})) << name;
    // Used without being required, they leave something that can be read.
    EXPECT_TRUE(accepted([](json& j) { j["extensionsUsed"] = {"KHR_draco_mesh_compression"}; }));
}

// ---- Values

TEST_F(GltfRules, OffsetsAndIndicesAreNotNegative) {
    EXPECT_TRUE(refused([](json& j) { j["bufferViews"][1]["byteOffset"] = -12; },
                        {"bufferViews[1].byteOffset", "-12", "from 0"}));
    EXPECT_TRUE(refused([](json& j) { j["accessors"][2]["byteOffset"] = -4; },
                        {"accessors[2].byteOffset", "-4", "from 0"}));
    EXPECT_TRUE(refused([](json& j) { j["accessors"][0]["bufferView"] = -1; },
                        {"accessors[0].bufferView", "-1", "from 0"}));
    EXPECT_TRUE(refused([](json& j) { j["meshes"][0]["primitives"][0]["indices"] = -1; },
                        {"meshes[0].primitives[0].indices", "-1", "from 0"}));
    EXPECT_TRUE(
        refused([](json& j) { j["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = -1; },
                {"meshes[0].primitives[0].attributes.NORMAL", "-1", "from 0"}));
    EXPECT_TRUE(refused([](json& j) { j["nodes"][0]["mesh"] = -1; }, {"nodes[0].mesh", "-1", ""}));
    EXPECT_TRUE(refused([](json& j) { j["scene"] = -1; }, {"scene", "-1", "from 0"}));
    EXPECT_TRUE(refused([](json& j) { j["accessors"][0]["bufferView"] = 1e10; },
                        {"accessors[0].bufferView", "1", "an integer"}));
}

TEST_F(GltfRules, PropertiesHaveTheirTypes) {
    EXPECT_TRUE(refused(
        [](json& j) {
            j["nodes"][0]["translation"] = {1, 2};
        },
        {"nodes[0].translation", "[1,2]", "3 numbers"}));
    EXPECT_TRUE(refused([](json& j) { j["nodes"][0]["matrix"] = "identity"; },
                        {"nodes[0].matrix", "identity", "16 numbers"}));
    EXPECT_TRUE(refused([](json& j) { j["nodes"] = json::object(); }, {"nodes", "{}", "array"}));
    EXPECT_TRUE(refused([](json& j) { j["nodes"][0] = 1; }, {"nodes[0]", "1", "an object"}));
    EXPECT_TRUE(refused([](json& j) { j["accessors"][0].erase("count"); },
                        {"accessors[0]", "no \"count\"", ""}));
    EXPECT_TRUE(refused([](json& j) { j["accessors"][0]["normalized"] = 1; },
                        {"accessors[0].normalized", "1", "true or false"}));
    EXPECT_TRUE(refused([](json& j) { j["meshes"][0]["weights"] = {"a"}; },
                        {"meshes[0].weights", "a", "numbers"}));
}

TEST_F(GltfRules, AttributesHaveTheirTypes) {
    const auto with = [&](const char* name, int type, bool normalized, const char* kind) {
        GltfBuilder gltf = square_gltf();
        const std::size_t components = kind[3] - '0';
        const bool bytes = type < 5122;
        const int accessor = gltf.add<std::uint8_t>(
            std::vector<std::uint8_t>(4 * (bytes ? 4 : 4 * components)), type, kind, 4);
        if (bytes) gltf.json["bufferViews"].back()["byteStride"] = 4;
        gltf.json["accessors"][accessor]["normalized"] = normalized;
        gltf.json["meshes"][0]["primitives"][0]["attributes"][name] = accessor;
        return loads(gltf);
    };
    EXPECT_TRUE(with("POSITION", 5121, true, "VEC3"));
    EXPECT_FALSE(with("POSITION", 5125, false, "VEC3"));
    EXPECT_FALSE(with("POSITION", 5126, false, "VEC4"));
    EXPECT_TRUE(with("NORMAL", 5120, true, "VEC3"));
    EXPECT_FALSE(with("NORMAL", 5120, false, "VEC3"));
    EXPECT_FALSE(with("NORMAL", 5121, true, "VEC3"));
    EXPECT_FALSE(with("TEXCOORD_0", 5126, false, "VEC3"));
    EXPECT_FALSE(with("TANGENT", 5126, false, "VEC4")) << "w is 0";
}

TEST_F(GltfRules, OnlyVertexAttributesHaveStrides) {
    EXPECT_TRUE(refused([](json& j) { j["bufferViews"][4]["byteStride"] = 4; },
                        {"bufferViews[4].byteStride", "4", "none"}));
    EXPECT_TRUE(accepted([](json& j) { j["bufferViews"][0]["byteStride"] = 12; }));
}

/// 3.6.2.4: what a GPU could not take as it is.
TEST_F(GltfRules, ElementsAreAligned) {
    const auto at = [&](int accessor, std::size_t in_view, std::size_t in_buffer) {
        GltfBuilder gltf = square_gltf();
        gltf.bytes += std::string(64, '\0');
        json& found = gltf.json["accessors"][accessor];
        json& view = gltf.json["bufferViews"][accessor];
        found["byteOffset"] = in_view;
        view["byteOffset"] = view["byteOffset"].get<std::size_t>() + in_buffer;
        view["byteLength"] = view["byteLength"].get<std::size_t>() + in_view;
        return loads(gltf);
    };
    constexpr int normals = 1, indices = 4;
    EXPECT_TRUE(at(normals, 0, 0));
    EXPECT_FALSE(at(normals, 2, 2)) << "aligned in the buffer, not in its view";
    EXPECT_FALSE(at(normals, 0, 2)) << "aligned in the view, not in the buffer";
    EXPECT_FALSE(at(indices, 1, 0));
    EXPECT_FALSE(at(indices, 0, 1));
    EXPECT_TRUE(at(indices, 2, 0));
    EXPECT_TRUE(at(indices, 0, 2)) << "they are shorts";
    EXPECT_TRUE(refused([](json& j) { j["bufferViews"][0]["byteStride"] = 13; },
                        {"", "byteStride", "glTF"}));
    GltfBuilder tight = square_gltf();
    const int bytes = tight.add(std::vector<std::int8_t>(12, 127), 5120, "VEC3", 4);
    tight.json["accessors"][bytes]["normalized"] = true;
    tight.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = bytes;
    EXPECT_FALSE(loads(tight)) << "three bytes per vertex";
}

/// 3.6.2.5: wrong bounds harm nothing here, and are said.
TEST_F(GltfRules, BoundsThatContradictTheElementsAreSaid) {
    const auto says = [&](int accessor, const json& least, const json& greatest) {
        GltfBuilder gltf = square_gltf();
        json& found = gltf.json["accessors"][accessor];
        found["min"] = least;
        found["max"] = greatest;
        const auto ignored = read_mesh_file(folder.write("m.glb", gltf.binary())).ignored;
        const std::string name = "min and max that contradict the elements of accessors[" +
                                 std::to_string(accessor) + "]";
        return ignored == std::vector<std::string>{name};
    };
    EXPECT_FALSE(says(0, {0, 0, 0}, {1, 1, 0}));
    EXPECT_TRUE(says(0, {0, 0, 0}, {1, 1, 1}));
    EXPECT_TRUE(says(0, {0, -1, 0}, {1, 1, 0}));
    EXPECT_TRUE(says(0, {0, 0, 0.5}, {1, 1, 0})) << "an element is out of them";
    EXPECT_TRUE(says(0, {0, 0}, {1, 1, 0}));
    EXPECT_TRUE(says(0, {0, 0, -1e300}, {1, 1, 0}));
    EXPECT_FALSE(says(4, json::array({0}), json::array({3})));
    EXPECT_TRUE(says(4, json::array({0}), json::array({4})));
    EXPECT_TRUE(refused([](json& j) { j["accessors"][0]["min"] = "none"; },
                        {"accessors[0].min", "none", "numbers"}));
    GltfBuilder gltf = square_gltf();
    const std::int8_t z = -127;
    const int normals = gltf.add(
        std::vector<std::int8_t>{0, 0, z, 0, 0, 0, z, 0, 0, 0, z, 0, 0, 0, z, 0}, 5120, "VEC3", 4);
    gltf.json["bufferViews"].back()["byteStride"] = 4;
    gltf.json["accessors"][normals]["normalized"] = true;
    gltf.json["accessors"][normals]["min"] = {0, 0, -127};
    gltf.json["accessors"][normals]["max"] = {0, 0, -127};
    gltf.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = normals;
    EXPECT_TRUE(read_mesh_file(folder.write("m.glb", gltf.binary())).ignored.empty())
        << "as stored, not as decoded";
    gltf.json["accessors"][normals]["min"] = {0, 0, -1};
    EXPECT_FALSE(read_mesh_file(folder.write("m.glb", gltf.binary())).ignored.empty());
}

TEST_F(GltfRules, SparseIndicesIncrease) {
    const auto with = [&](std::vector<std::uint16_t> at) {
        GltfBuilder gltf = square_gltf();
        const std::size_t count = at.size();
        const int indices = gltf.shorts(at);
        const int values = gltf.floats(std::vector<float>(3 * count, 1), "VEC3", 3);
        gltf.json["accessors"][0]["sparse"] = {
            {"count", count},
            {"indices",
             {{"bufferView", gltf.json["accessors"][indices]["bufferView"]},
              {"componentType", 5123}}},
            {"values", {{"bufferView", gltf.json["accessors"][values]["bufferView"]}}}};
        return loads(gltf);
    };
    EXPECT_TRUE(with({0, 3}));
    EXPECT_FALSE(with({3, 0}));
    EXPECT_FALSE(with({1, 1}));
    EXPECT_FALSE(with({0, 4}));
}

// ---- Meshes

TEST_F(GltfRules, TopologiesHaveTheirNumbers) {
    const auto with = [&](int mode, std::vector<std::uint16_t> indices) {
        GltfBuilder gltf = square_gltf();
        gltf.json["meshes"][0]["primitives"][0]["indices"] = gltf.shorts(indices);
        gltf.json["meshes"][0]["primitives"][0]["mode"] = mode;
        return loads(gltf);
    };
    EXPECT_TRUE(with(4, {0, 1, 2}));
    EXPECT_FALSE(with(4, {0, 1, 2, 3}));
    EXPECT_TRUE(with(5, {0, 1, 3, 2}));
    EXPECT_FALSE(with(5, {0, 1}));
    EXPECT_FALSE(with(6, {0, 1}));
    EXPECT_FALSE(with(7, {0, 1, 2}));
    EXPECT_FALSE(with(4, {0, 1, 65535})) << "restarts primitives";
}

TEST_F(GltfRules, MorphTargetsFit) {
    const auto with = [](const json& targets, const json& weights) {
        return [=](json& j) {
            j["meshes"][0]["primitives"][0]["targets"] = targets;
            j["meshes"][0]["weights"] = weights;
        };
    };
    const json one = {{"POSITION", 1}};
    EXPECT_TRUE(accepted(with(json::array({one}), json::array({1}))));
    EXPECT_TRUE(refused(with(json::array({one}), {1, 1}),
                        {"meshes[0].primitives[0].targets", "1", "one per weight: 2"}));
    EXPECT_TRUE(refused(with(json::array({{{"POSITION", 2}}}), json::array({1})),
                        {"accessors[2]", "another type", "3"}));
    EXPECT_TRUE(refused(with(json::array({{{"POSITION", 99}}}), json::array({1})),
                        {"accessors", "99", "one of the"}));
}

/// Of positions as of what comes after them.
TEST_F(GltfRules, MorphTargetsHaveAsManyElements) {
    for (const char* name : {"POSITION", "NORMAL", "TEXCOORD_0", "TANGENT"})
        for (const std::size_t count : {3u, 4u, 5u}) {
            const std::size_t components = name == std::string("TEXCOORD_0") ? 2 : 3;
            GltfBuilder gltf = square_gltf();
            const int moved = gltf.floats(std::vector<float>(count * components),
                                          components == 2 ? "VEC2" : "VEC3", components);
            json& mesh = gltf.json["meshes"][0];
            mesh["primitives"][0]["targets"] = json::array({{{name, moved}}});
            mesh["weights"] = json::array({1});
            if (count == 4)
                EXPECT_TRUE(loads(gltf)) << name;
            else
                EXPECT_TRUE(
                    complains([&] { load_mesh(folder.write("m.glb", gltf.binary())); },
                              {std::string("meshes[0].primitives[0].targets[0].") + name,
                               std::to_string(count) + " elements", "as many as positions: 4"}))
                    << name;
        }
}

TEST_F(GltfRules, SkinsFit) {
    const auto with = [&](const auto& change) {
        GltfBuilder gltf = square_gltf();
        const int joints = gltf.add<std::uint8_t>(std::vector<std::uint8_t>(16), 5121, "VEC4", 4);
        const int weights =
            gltf.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
        json& attributes = gltf.json["meshes"][0]["primitives"][0]["attributes"];
        attributes["JOINTS_0"] = joints;
        attributes["WEIGHTS_0"] = weights;
        gltf.json["nodes"][0]["skin"] = 0;
        gltf.json["skins"] = json::array({{{"joints", json::array({0})}}});
        change(gltf, attributes);
        return loads(gltf);
    };
    EXPECT_TRUE(with([](auto&, json&) {}));
    EXPECT_FALSE(with([](auto&, json& a) { a.erase("JOINTS_0"); }));
    EXPECT_FALSE(with([](auto&, json& a) { a.erase("JOINTS_0"), a.erase("WEIGHTS_0"); }));
    EXPECT_FALSE(with([](auto& gltf, json&) { gltf.json["skins"][0]["joints"] = {9}; }));
    EXPECT_FALSE(with([](auto& gltf, json&) { gltf.json["nodes"][0]["skin"] = 1; }));
    EXPECT_FALSE(with([](auto& gltf, json& a) {
        a["JOINTS_0"] =
            gltf.template add<std::uint8_t>(std::vector<std::uint8_t>(16, 1), 5121, "VEC4", 4);
    })) << "the skin has one joint";
    for (const float weight : {0.0f, -1.0f})
        EXPECT_FALSE(with([&](auto& gltf, json& a) {
            a["WEIGHTS_0"] = gltf.floats(std::vector<float>(16, weight), "VEC4", 4);
        })) << weight;
    EXPECT_FALSE(with([](auto& gltf, json&) {  // too few of another type
        gltf.json["skins"][0]["inverseBindMatrices"] = 0;
    }));
}

// ---- Nodes

TEST_F(GltfRules, NodesAreTrees) {
    const auto nodes = [](const json& list, const json& roots) {
        return [=](json& j) {
            j["nodes"] = list;
            j["scenes"][0]["nodes"] = roots;
        };
    };
    const json leaf = {{"mesh", 0}}, zero = json::array({0}), one = json::array({1});
    const auto parent = [](const json& children) { return json{{"children", children}}; };
    EXPECT_TRUE(accepted(nodes(json::array({parent(one), leaf}), zero)));
    EXPECT_TRUE(refused(nodes(json::array({parent(one), leaf}), one),
                        {"scenes[0].nodes", "node 1", "roots"}));
    EXPECT_TRUE(refused(nodes(json::array({leaf}), {0, 0}), {"scenes[0].nodes", "twice", "once"}));
    EXPECT_TRUE(refused(nodes(json::array({parent(one), leaf, parent(one)}), {0, 2}),
                        {"nodes[1]", "second way", "a tree"}));
    EXPECT_TRUE(refused(nodes(json::array({leaf, parent({2}), parent(one)}), zero),
                        {"nodes[1]", "below itself", "a tree"}));
    EXPECT_TRUE(refused(nodes(json::array({parent({7})}), zero), {"nodes[0].children", "7", ""}));
    EXPECT_TRUE(
        refused(nodes(json::array({leaf}), json::array({7})), {"scenes[0].nodes", "7", "below 1"}));
}

TEST_F(GltfRules, TransformsAreOfOneKind) {
    const json identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    EXPECT_TRUE(refused(
        [&](json& j) {
            j["nodes"][0]["matrix"] = identity;
            j["nodes"][0]["scale"] = {1, 1, 1};
        },
        {"nodes[0]", "both a matrix and a scale", "one"}));
    EXPECT_TRUE(refused(
        [](json& j) {
            j["nodes"][0]["rotation"] = {0, 0, 0, 0};
        },
        {"nodes[0].rotation", "length 0", "unit"}));
    EXPECT_TRUE(refused(
        [](json& j) {
            j["nodes"][0]["scale"] = {1e300, 1, 1};
        },
        {"meshes[0].primitives[0]", "infinite", "finite"}));
}

// ---- Buffers

TEST_F(GltfRules, BinaryChunksMayBeEmptyAndOthersFollow) {
    GltfBuilder gltf = square_gltf();
    folder.write("outer data.bin", gltf.bytes + "more than it says");
    json all = json::parse(gltf.text("outer%20data.bin"));
    const auto file = folder.write("m.glb", glb_of(all, {{"BIN", ""}}));
    EXPECT_EQ(load_mesh(file).triangles.size(), 2u);
    EXPECT_EQ(files_of_mesh(file).size(), 2u);
    EXPECT_EQ(load_mesh(folder.write("m.glb", glb_of(all, {}))).triangles.size(), 2u);
    all["buffers"][0].erase("uri");
    EXPECT_EQ(load_mesh(folder.write("m.glb", glb_of(all, {{"BIN", gltf.bytes}, {"ACME", "xxxx"}})))
                  .triangles.size(),
              2u);
    const auto refused = [&](const std::string& bytes, const Complaint& complaint) {
        return complains([&] { load_mesh(folder.write("m.glb", bytes)); }, complaint);
    };
    EXPECT_TRUE(refused(glb_of(all, {}), {"buffers[0]", "neither a uri nor", ""}));
    EXPECT_TRUE(
        refused(glb_of(all, {{"BIN", ""}}), {"buffers[0].byteLength", "", "at most the 0"}));
    EXPECT_TRUE(refused(glb_of(all, {{"ACME", gltf.bytes}}), {"buffers[0]", "neither", ""}));
    std::string older = glb_of(all, {{"BIN", gltf.bytes}});
    older[4] = 1;
    EXPECT_TRUE(refused(older, {"", "version 1", "2"}));
}

TEST_F(GltfRules, BuffersMayBeLongerAndNotShorter) {
    const GltfBuilder gltf = square_gltf();
    folder.write("b.bin", gltf.bytes + "x");
    EXPECT_EQ(load_mesh(folder.write("m.gltf", gltf.text("b.bin"))).triangles.size(), 2u);
    EXPECT_TRUE(complains(
        [&] {
            load_mesh(
                folder.write("m.gltf", gltf.text("data:application/octet-stream;base64,AAAA")));
        },
        {"buffers[0].byteLength", "", "at most the 3 bytes"}));
}

}  // namespace
}  // namespace quadrel
