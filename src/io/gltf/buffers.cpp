#include "io/gltf/buffers.hpp"

#include <charconv>

#include "file/read_file.hpp"

namespace quadrel {
namespace {

using Bytes = std::vector<unsigned char>;

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

std::filesystem::path path_of(const std::string& uri, const std::filesystem::path& folder) {
    return folder / decode_percent(uri);
}

class BufferLoader {
  public:
    BufferLoader(const GltfFile& file, const std::filesystem::path& folder,
                 std::optional<std::string_view> binary)
        : file_(file), folder_(folder), binary_(binary) {}

    /// Of at least `size` bytes.
    Bytes load(const nlohmann::json& buffer, std::size_t index) const {
        const std::string key = "buffers[" + std::to_string(index) + "]";
        Bytes bytes = source(buffer, index, key);
        const auto size = buffer.at("byteLength").get<std::size_t>();
        // What belongs to an extension alone has no bytes of its own.
        if (!buffer.contains("uri") && index > 0) return bytes;
        if (bytes.size() < size)
            file_.fail(key + ".byteLength", std::to_string(size),
                       "at most the " + std::to_string(bytes.size()) + " bytes that there are");
        bytes.resize(size);
        return bytes;
    }

  private:
    Bytes source(const nlohmann::json& buffer, std::size_t index, const std::string& key) const {
        if (buffer.contains("uri")) return from_uri(buffer["uri"].get<std::string>(), key);
        if (index > 0) return {};
        if (!binary_) file_.fail(key, "neither a uri nor a binary chunk", "one of them");
        return Bytes(binary_->begin(), binary_->end());
    }

    Bytes from_uri(const std::string& uri, const std::string& key) const {
        Bytes bytes;
        if (is_gltf_data(uri)) {
            bytes = gltf_data(uri);
            if (bytes.empty())
                file_.fail(key + ".uri", "data that is not base64",
                           "data:application/octet-stream;base64,...");
            return bytes;
        }
        const std::filesystem::path path = path_of(uri, folder_);
        if (const char* const reason = reason_not_to_read(path))
            file_.fail(key + ".uri", std::string(reason) + ": " + path.string(), "a file");
        const std::string text = read_whole_file(path);
        return Bytes(text.begin(), text.end());
    }

    const GltfFile& file_;
    const std::filesystem::path& folder_;
    std::optional<std::string_view> binary_;
};

}  // namespace

void load_gltf_buffers(GltfFile& file, const nlohmann::json& json,
                       const std::filesystem::path& folder,
                       std::optional<std::string_view> binary) {
    if (!json.contains("buffers")) return;
    const BufferLoader loader(file, folder, binary);
    for (std::size_t i = 0; i < json["buffers"].size(); ++i) {
        tinygltf::Buffer buffer;
        buffer.data = loader.load(json["buffers"][i], i);
        file.model.buffers.push_back(std::move(buffer));
    }
}

bool is_gltf_data(const std::string& uri) { return uri.starts_with("data:"); }

std::vector<unsigned char> gltf_data(const std::string& uri) {
    // The library knows a list of types, which does not matter here.
    constexpr const char* known = "data:application/octet-stream;base64,";
    const std::size_t comma = uri.find(";base64,");
    std::vector<unsigned char> bytes;
    std::string type;
    if (comma == std::string::npos ||
        !tinygltf::DecodeDataURI(&bytes, type, known + uri.substr(comma + 8), 0, false))
        return {};
    return bytes;
}

std::optional<std::filesystem::path> gltf_uri_path(const std::string& uri,
                                                   const std::filesystem::path& folder) {
    if (is_gltf_data(uri)) return std::nullopt;
    return path_of(uri, folder);
}

std::vector<std::filesystem::path> gltf_buffer_paths(const nlohmann::json& json,
                                                     const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    if (!json.contains("buffers")) return files;
    for (const auto& buffer : json["buffers"]) {
        const std::string uri = buffer.value("uri", "");
        if (!uri.empty() && !is_gltf_data(uri)) files.push_back(path_of(uri, folder));
    }
    return files;
}

}  // namespace quadrel
