#include "io/gltf_open.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>

#include "io/read_file.hpp"

namespace quadrel {
namespace {

std::string one_line(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

bool skip_image(tinygltf::Image*, const int, std::string*, std::string*, int, int,
                const unsigned char*, int, void*) {
    return true;
}

// Only files: tinygltf would wait for a pipe, and take a directory for a file of 2^63 bytes.
bool file_exists(const std::string& name, void*) { return reason_not_to_read(name) == nullptr; }

std::string same_path(const std::string& name, void*) { return name; }

bool read_file(std::vector<unsigned char>* out, std::string*, const std::string& name, void*) {
    const std::string bytes = read_whole_file(name);
    out->assign(bytes.begin(), bytes.end());
    return true;
}

bool is_binary(std::string_view bytes) { return bytes.starts_with("glTF"); }

// Of a binary file, the chunk that begins 20 bytes after its start (glTF 2.0, 4.4).
std::string_view json_of(std::string_view bytes) {
    if (!is_binary(bytes)) return bytes;
    if (bytes.size() < 20) return {};
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, sizeof length);
    return bytes.substr(20, length);
}

// tinygltf calls itself once a level.
void check_nesting(const GltfFile& file, std::string_view json) {
    constexpr int most = 100;
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        if (json[i] == '"') in_string = !in_string;
        if (in_string && json[i] == '\\') ++i;
        if (in_string) continue;
        if (json[i] == '[' || json[i] == '{') ++depth;
        if (json[i] == ']' || json[i] == '}') --depth;
        if (depth > most)
            file.fail("", "more than " + std::to_string(most) + " nested brackets", "glTF 2.0");
    }
}

bool parse(const std::string& bytes, const std::string& folder, tinygltf::Model& model,
           std::string& error) {
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(skip_image, nullptr);
    loader.SetFsCallbacks({file_exists, same_path, read_file, nullptr, nullptr});
    const auto size = static_cast<unsigned int>(bytes.size());
    std::string warning;
    if (!is_binary(bytes))
        return loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, folder);
    const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
    return loader.LoadBinaryFromMemory(&model, &error, &warning, data, size, folder);
}
// Extensions of materials and lights may be ignored; others change what the buffers mean.
void check_extensions(const GltfFile& file) {
    for (const std::string& name : file.model.extensionsRequired) {
        const bool harmless = name.rfind("KHR_materials_", 0) == 0 ||
                              name == "KHR_mesh_quantization" || name == "KHR_lights_punctual" ||
                              name == "KHR_texture_transform";
        if (!harmless)
            file.fail("extensionsRequired", "the extension " + name, "none that encodes meshes");
    }
}

std::string decode_percent(const std::string& uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned char code = 0;
        const char* digits = uri.data() + i + 1;
        const bool escaped = uri[i] == '%' && i + 2 < uri.size() &&
                             std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
        if (escaped) {
            text += static_cast<char>(code);
            i += 2;
        } else {
            text += uri[i];
        }
    }
    return text;
}

}  // namespace

GltfFile open_gltf(const std::filesystem::path& path) {
    GltfFile file{path.string(), {}};
    const std::string bytes = read_whole_file(path);
    if (bytes.size() > 0x7fffffff)
        file.fail("", std::to_string(bytes.size()) + " bytes", "less than 2^31");
    check_nesting(file, json_of(bytes));
    std::string error;
    bool read = false;
    try {
        read = parse(bytes, path.parent_path().string(), file.model, error);
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& failure) {
        error = failure.what();
    }
    if (!read || !error.empty())
        file.fail("", error.empty() ? "something unreadable" : one_line(error), "glTF 2.0");
    check_extensions(file);
    return file;
}

std::vector<std::filesystem::path> gltf_buffer_files(const std::filesystem::path& path) {
    std::vector<std::filesystem::path> files;
    for (const auto& buffer : open_gltf(path).model.buffers)
        if (!buffer.uri.empty() && buffer.uri.rfind("data:", 0) != 0)
            files.push_back(path.parent_path() / decode_percent(buffer.uri));
    return files;
}

}  // namespace quadrel
