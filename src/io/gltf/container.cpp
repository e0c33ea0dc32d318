#include "io/gltf/container.hpp"

#include <cctype>
#include <cstdint>
#include <cstring>

#include "quadrel/error.hpp"

namespace quadrel {
namespace {

constexpr std::uint32_t json_type = 0x4E4F534A, binary_type = 0x004E4942;

class ChunkReader {
  public:
    ChunkReader(const std::string& name, std::string_view bytes) : name_(name), rest_(bytes) {}

    [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
        throw InputError(name_, "", found, expected);
    }

    std::uint32_t word() {
        if (rest_.size() < 4) fail("an end within the container", "glTF 2.0");
        std::uint32_t value = 0;
        std::memcpy(&value, rest_.data(), sizeof value);
        rest_.remove_prefix(sizeof value);
        return value;
    }

    void limit(std::size_t size) { rest_ = rest_.substr(0, size); }
    bool at_end() const { return rest_.empty(); }
    std::size_t size() const { return rest_.size(); }

    std::pair<std::uint32_t, std::string_view> chunk() {
        const std::uint32_t length = word(), type = word();
        if (length > rest_.size())
            fail("a chunk of " + std::to_string(length) + " bytes where " +
                     std::to_string(rest_.size()) + " are left",
                 "glTF 2.0");
        const std::string_view data = rest_.substr(0, length);
        rest_.remove_prefix(length);
        return {type, data};
    }

  private:
    const std::string& name_;
    std::string_view rest_;
};

}  // namespace

bool is_gltf_file(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension == ".gltf" || extension == ".glb";
}

GltfContainer open_gltf_container(const std::string& name, std::string_view bytes) {
    if (!bytes.starts_with("glTF")) return {bytes, std::nullopt};
    ChunkReader reader(name, bytes.substr(4));
    const std::uint32_t version = reader.word();
    if (version != 2)
        reader.fail("a container of version " + std::to_string(version), "2, as of glTF 2.0");
    const std::uint32_t length = reader.word();
    if (length > bytes.size() || length < 12)
        reader.fail("a container of " + std::to_string(length) + " bytes in a file of " +
                        std::to_string(bytes.size()),
                    "glTF 2.0");
    reader.limit(length - 12);
    const auto [type, json] = reader.chunk();
    if (type != json_type) reader.fail("a first chunk of another type", "glTF 2.0: JSON");
    GltfContainer container{json, std::nullopt};
    if (reader.at_end()) return container;
    const auto [second, binary] = reader.chunk();
    if (second == binary_type) container.binary = binary;
    return container;
}

}  // namespace quadrel
