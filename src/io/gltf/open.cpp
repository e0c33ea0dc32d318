#include "io/gltf/open.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "file/input_record.hpp"
#include "file/read_file.hpp"
#include "io/gltf/asset.hpp"
#include "io/gltf/buffers.hpp"
#include "io/gltf/container.hpp"
#include "io/gltf/material/members.hpp"
#include "io/gltf/schema.hpp"
#include "text/not_finite.hpp"

namespace quadrel {
namespace {

using nlohmann::json;

std::string one_line(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

// Others are calls within calls.
void check_nesting(const GltfFile& file, std::string_view text) {
    constexpr int most = 100;
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '"') in_string = !in_string;
        if (in_string && text[i] == '\\') ++i;
        if (in_string) continue;
        if (text[i] == '[' || text[i] == '{') ++depth;
        if (text[i] == ']' || text[i] == '}') --depth;
        if (depth > most)
            file.fail("", "more than " + std::to_string(most) + " nested brackets", "glTF 2.0");
    }
}

json parse(const GltfFile& file, std::string_view text) {
    check_nesting(file, text);
    try {
        json root = json::parse(text);
        if (!root.is_object()) file.fail("", "JSON that is no object", "glTF 2.0");
        return root;
    } catch (const json::parse_error& error) {
        const auto word = word_around(text, error.byte == 0 ? 0 : error.byte - 1);
        if (spells_not_finite(word))
            file.fail("", fmt::format("{} in byte {}", word, error.byte), "finite numbers");
        file.fail("", one_line(error.what()), "glTF 2.0");
    } catch (const json::exception& error) {
        file.fail("", one_line(error.what()), "glTF 2.0");
    }
}

std::vector<tinygltf::Skin> skins_of(const json& checked) {
    std::vector<tinygltf::Skin> skins;
    for (const json& described : checked.value("skins", json::array())) {
        tinygltf::Skin& skin = skins.emplace_back();
        skin.inverseBindMatrices = described.value("inverseBindMatrices", -1);
        skin.joints = described["joints"].get<std::vector<int>>();
    }
    return skins;
}

// tinygltf drops what it finds malformed, refuses what geometry does not need, and reads buffers
// and images by itself: it gets what is checked already, and only what meshes are made of. It also
// wants inverse bind matrices, which are optional, and a buffer view for indices, which may be
// sparse instead.
void fill_model(GltfFile& file, json checked) {
    const std::vector<tinygltf::Skin> skins = skins_of(checked);
    for (const char* part : {"buffers", "materials", "skins"}) checked.erase(part);
    std::vector<std::vector<int>> indices;
    for (json& mesh : checked.value("meshes", json::array())) {
        indices.emplace_back();
        for (json& primitive : mesh["primitives"])
            indices.back().push_back(primitive.value("indices", -1));
    }
    if (checked.contains("meshes"))
        for (json& mesh : checked["meshes"])
            for (json& primitive : mesh["primitives"]) primitive.erase("indices");
    const std::string text = checked.dump();
    tinygltf::TinyGLTF loader;
    std::string error, warning;
    const bool read = loader.LoadASCIIFromString(&file.model, &error, &warning, text.data(),
                                                 static_cast<unsigned>(text.size()), "");
    if (!read || !error.empty())
        file.fail("", error.empty() ? "something unreadable" : one_line(error), "glTF 2.0");
    file.model.skins = skins;
    for (std::size_t i = 0; i < indices.size(); ++i)
        for (std::size_t k = 0; k < indices[i].size(); ++k)
            file.model.meshes.at(i).primitives.at(k).indices = indices[i][k];
}

struct Parts {
    GltfFile file;
    json checked;
    std::string bytes;
    std::optional<std::string_view> binary;  ///< within `bytes`
};

/// Of buffers within the text stays that they are such.
void drop_bytes(json& root) {
    const auto buffers = root.find("buffers");
    if (buffers == root.end()) return;
    for (json& buffer : *buffers)
        if (buffer.contains("uri") && is_gltf_data(buffer["uri"].get<std::string>()))
            buffer["uri"] = "data:";
}

/// Files that belong to it are inputs of whatever reads it, images that nothing is made of as well.
void note_images(const json& root, const std::filesystem::path& folder) {
    for (const json& image : member_of(root, "images"))
        if (const json& uri = member_of(image, "uri"); uri.is_string())
            if (const auto file = gltf_uri_path(uri.get<std::string>(), folder)) note_input(*file);
}

void read_parts(const std::filesystem::path& path, Parts& parts) {
    parts.file.name = path.string();
    parts.bytes = read_whole_file(path);
    if (parts.bytes.size() > 0x7fffffff)
        parts.file.fail("", std::to_string(parts.bytes.size()) + " bytes", "less than 2^31");
    const GltfContainer container = open_gltf_container(parts.file.name, parts.bytes);
    parts.binary = container.binary;
    parts.file.json = parse(parts.file, container.json);
    check_gltf_version(parts.file.name, parts.file.json);
    check_gltf_extensions(parts.file.name, parts.file.json);
    parts.checked = checked_gltf(parts.file.name, parts.file.json);
    note_images(parts.file.json, path.parent_path());
}

}  // namespace

GltfFile open_gltf(const std::filesystem::path& path) {
    Parts parts;
    read_parts(path, parts);
    fill_model(parts.file, parts.checked);
    load_gltf_buffers(parts.file, parts.checked, path.parent_path(), parts.binary);
    drop_bytes(parts.file.json);
    return std::move(parts.file);
}

json parse_gltf_json(const std::string& name, std::string_view text) {
    GltfFile file;
    file.name = name;
    return parse(file, text);
}

std::vector<std::filesystem::path> gltf_buffer_files(const std::filesystem::path& path) {
    Parts parts;
    read_parts(path, parts);
    return gltf_buffer_paths(parts.checked, path.parent_path());
}

}  // namespace quadrel
