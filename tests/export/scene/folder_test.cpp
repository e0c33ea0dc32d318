// An exported folder as a whole: its index, equal bytes, and what stands where it is to go.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

#include "export/scene/export_scene.hpp"
#include "export/scene/small_scenes.hpp"
#include "io/document/json.hpp"
#include "quadrel/error.hpp"

namespace quadrel::export_tests {
namespace {

namespace fs = std::filesystem;
using testing_films::file_bytes;
using testing_films::TemporaryFolder;
using testing_films::write_bytes;

/// Files below a folder, with their bytes.
std::map<std::string, std::string> contents(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            files[entry.path().lexically_relative(folder).generic_string()] =
                file_bytes(entry.path());
    return files;
}

Json manifest_in(const fs::path& folder) {
    return Json::parse(file_bytes(folder / "manifest.json"));
}

std::size_t texel_bytes(const Json& texture) {
    const std::map<std::string, std::size_t> sizes{
        {"unorm8", 1}, {"srgb8", 1}, {"unorm16", 2}, {"half", 2}, {"float", 4}};
    const std::size_t faces = texture["kind"] == "cube" ? 6 : texture.value("layers", 1);
    return sizes.at(texture["format"]) * texture["channels"].get<std::size_t>() * faces;
}

void add_uniforms(const Json& list, std::vector<Json>& all) {
    for (const Json& uniform : list) all.push_back(uniform);
}

std::vector<Json> uniforms_of(const Json& manifest) {
    std::vector<Json> all;
    add_uniforms(manifest["uniforms"], all);
    for (const char* list : {"materials", "draws"})
        for (const Json& entry : manifest[list]) add_uniforms(entry["uniforms"], all);
    return all;
}

/// What is wrong with an index, by the files that there are; empty if nothing is.
std::string defect(const Json& manifest, const std::map<std::string, std::string>& files) {
    std::set<std::string> named;
    for (const Json& file : manifest["files"]) named.insert(file.get<std::string>());
    for (const auto& [name, bytes] : files)
        if (named.erase(name) == 0) return name + " is not named";
    if (!named.empty()) return *named.begin() + " is missing";
    const auto size = [&](const Json& name) { return files.at(name.get<std::string>()).size(); };
    for (const Json& texture : manifest["textures"])
        for (const Json& level : texture["levels"])
            if (size(level["bytes"]) != texel_bytes(texture) * level["width"].get<std::size_t>() *
                                            level["height"].get<std::size_t>())
                return level["bytes"].get<std::string>() + " has another size";
    const Json& vertices = manifest["vertex_buffer"];
    if (size(vertices["file"]) !=
        vertices["stride"].get<std::size_t>() * vertices["count"].get<std::size_t>())
        return "vertices have another size";
    if (size(manifest["index_buffer"]["file"]) !=
        4 * manifest["index_buffer"]["count"].get<std::size_t>())
        return "indices have another size";
    for (const Json& uniform : uniforms_of(manifest))
        for (std::size_t i = 0; i < uniform["values"].size(); ++i)
            if (std::strtof(uniform["hex"][i].get<std::string>().c_str(), nullptr) !=
                static_cast<float>(uniform["values"][i].get<double>()))
                return uniform["name"].get<std::string>() + " has two values";
    return "";
}

std::set<std::string> channel_names_of(const Json& manifest) {
    std::set<std::string> names;
    for (const Json& pass : manifest["passes"])
        for (const Json& target : pass["targets"])
            for (const Json& channel : target["channels"])
                if (!channel.is_null()) names.insert(channel["name"].get<std::string>());
    return names;
}

TEST(SceneFolder, IndexAndFilesAgree) {
    const SmallScenes scenes;
    for (const char* name : {"thesis-quad", "sampler-cube", "rows/sphere-3d", "rows/pyramid"}) {
        const TemporaryFolder folder;
        export_scene(scenes.load(name), {}, folder / "out");
        const Json manifest = manifest_in(folder / "out");
        const auto files = contents(folder / "out");
        EXPECT_EQ(defect(manifest, files), "") << name;
        // What is drawn there is what the shaders write.
        const ExrFile expected = read_exr(folder / "out" / "expected.exr");
        std::set<std::string> planes;
        for (const Plane& plane : expected.film.planes) planes.insert(plane.name);
        EXPECT_EQ(planes, channel_names_of(manifest)) << name;
    }
}

TEST(SceneFolder, PlantedDefectsOfAnIndexAreFound) {
    const SmallScenes scenes;
    const TemporaryFolder folder;
    export_scene(scenes.load("thesis-quad"), {}, folder / "out");
    const Json right = manifest_in(folder / "out");
    auto files = contents(folder / "out");
    Json wrong = right;
    wrong["textures"][0]["levels"][1]["width"] = 16;
    EXPECT_NE(defect(wrong, files), "");
    wrong = right;
    wrong["files"].erase(0);
    EXPECT_NE(defect(wrong, files), "");
    wrong = right;
    wrong["uniforms"][0]["values"][0] = 17;
    EXPECT_NE(defect(wrong, files), "");
    wrong = right;
    wrong["vertex_buffer"]["stride"] = 12;
    EXPECT_NE(defect(wrong, files), "");
    files.erase("indices.bin");
    EXPECT_NE(defect(right, files), "");
}

TEST(SceneFolder, TwiceTheSameBytes) {
    const SmallScenes scenes;
    const TemporaryFolder folder;
    for (const char* name : {"first", "second"})
        export_scene(scenes.load("bricks-45"), {}, folder / name);
    EXPECT_EQ(contents(folder / "first"), contents(folder / "second"));
    EXPECT_EQ(folder.count(), 2u);  // nothing else is left
}

bool refuses(const fs::path& folder) {
    try {
        check_export_folder(folder);
    } catch (const UsageError&) {
        return true;
    }
    return false;
}

TEST(SceneFolder, TakesThePlaceOfAnExportAndOfNothingElse) {
    const SmallScenes scenes;
    const TemporaryFolder folder;
    EXPECT_FALSE(refuses(folder / "new"));
    fs::create_directory(folder / "empty");
    EXPECT_FALSE(refuses(folder / "empty"));
    write_bytes(folder / "file", "text");
    EXPECT_TRUE(refuses(folder / "file"));
    fs::create_directory(folder / "full");
    write_bytes(folder / "full" / "letter.txt", "text");
    EXPECT_TRUE(refuses(folder / "full"));
    write_bytes(folder / "full" / "manifest.json", "{}");
    EXPECT_TRUE(refuses(folder / "full"));

    const fs::path out = folder / "empty";
    export_scene(scenes.load("thesis-quad"), {}, out);
    const auto before = contents(out);
    EXPECT_FALSE(refuses(out));
    export_scene(scenes.load("text-plate"), {}, out);
    EXPECT_EQ(manifest_in(out)["scene"]["file"], "text-plate.json");
    EXPECT_EQ(defect(manifest_in(out), contents(out)), "");  // nothing of the other scene is left
    EXPECT_NE(contents(out), before);
    write_bytes(out / "mine.exr", "picture");
    EXPECT_TRUE(refuses(out));
}

TEST(SceneFolder, LeavesWhatWasThereWhereItFails) {
    const SmallScenes scenes;
    const TemporaryFolder folder;
    export_scene(scenes.load("thesis-quad"), {}, folder / "out");
    const auto before = contents(folder / "out");
    EXPECT_THROW(export_scene(scenes.load("rows/shadow-oracle"), {}, folder / "out"), UsageError);
    EXPECT_EQ(contents(folder / "out"), before);
    EXPECT_THROW(export_scene(scenes.load("thesis-quad"), {}, folder / "missing" / "out"),
                 OutputError);
    EXPECT_EQ(folder.count(), 1u);
}

TEST(SceneFolder, SaysHowToDraw) {
    const SmallScenes scenes;
    const TemporaryFolder folder;
    struct Row {
        const char *scene, *origin, *depth, *row, *face;
    };
    for (const Row& row : {Row{"thesis-quad", "lower-left", "negative-one-to-one", "bottom", "ccw"},
                           Row{"conventions-vulkan", "lower-left", "zero-to-one", "top", "cw"},
                           Row{"conventions-d3d", "upper-left", "zero-to-one", "top", "ccw"}}) {
        export_scene(scenes.load(row.scene), {}, folder / "out");
        const Json state = manifest_in(folder / "out")["state"];
        EXPECT_EQ(state["clip_origin"], row.origin) << row.scene;
        EXPECT_EQ(state["clip_depth"], row.depth) << row.scene;
        EXPECT_EQ(state["first_row"], row.row) << row.scene;
        EXPECT_EQ(state["front_face"], row.face) << row.scene;
    }
}

/// Where the channels of a vector lie; -1 where they do not lie in one target, one after the other.
int place_of_vector(const Json& manifest, const std::vector<std::string>& names) {
    for (const Json& pass : manifest["passes"])
        for (const Json& target : pass["targets"]) {
            const Json& channels = target["channels"];
            for (std::size_t first = 0; first + names.size() <= channels.size(); ++first) {
                std::size_t same = 0;
                while (same < names.size() && !channels[first + same].is_null() &&
                       channels[first + same]["name"] == names[same])
                    ++same;
                if (same == names.size()) return static_cast<int>(first);
            }
        }
    return -1;
}

TEST(SceneFolder, VectorsLieInOneTarget) {
    const SmallScenes scenes;
    const TemporaryFolder folder;
    export_scene(scenes.load("thesis-quad"), {}, folder / "out");
    const Json manifest = manifest_in(folder / "out");
    using Names = std::vector<std::string>;
    for (const Names& names :
         {Names{"uv.U", "uv.V"}, Names{"hit.P.X", "hit.P.Y", "hit.P.Z"}, Names{"hit.U", "hit.V"},
          Names{"N.X", "N.Y", "N.Z"}, Names{"R", "G", "B"}, Names{"K.U", "K.V"}})
        EXPECT_GE(place_of_vector(manifest, names), 0) << names[0];
    EXPECT_EQ(place_of_vector(manifest, {"uv.V", "uv.U"}), -1);
}

TEST(SceneFolder, ChannelsAreThoseThatAreAskedFor) {
    const SmallScenes scenes;
    const TemporaryFolder folder;
    SceneExport options;
    options.channels = {"hit.s", "K", "A"};
    export_scene(scenes.load("thesis-quad"), options, folder / "out");
    const Json manifest = manifest_in(folder / "out");
    EXPECT_EQ(channel_names_of(manifest), (std::set<std::string>{"hit.s", "K.U", "K.V", "A"}));
    EXPECT_EQ(manifest["materials"][0]["samplers"].size(), 1u);  // no colour is asked for
    for (const char* const name :
         {"id.object", "exact.dUVdx.U", "lod.rho", "shadow.3.visibility"}) {
        options.channels = {name};
        EXPECT_THROW(export_scene(scenes.load("thesis-quad"), options, folder / "no"), UsageError)
            << name;
    }
}

}  // namespace
}  // namespace quadrel::export_tests
