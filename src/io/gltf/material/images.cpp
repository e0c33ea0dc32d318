#include "io/gltf/material/images.hpp"

#include <fmt/format.h>

#include "io/gltf/buffers.hpp"
#include "io/gltf/container.hpp"
#include "io/gltf/material/members.hpp"
#include "io/gltf/open.hpp"
#include "quadrel/error.hpp"

namespace quadrel {
namespace {

using nlohmann::json;

/// A uri of data, or none: the container's.
bool is_inside(const json& uri) {
    return uri.is_null() || (uri.is_string() && is_gltf_data(uri.get<std::string>()));
}

class ImageReader {
  public:
    ImageReader(const std::string& file, const std::string& key, std::string_view bytes)
        : file_(file),
          key_(key),
          container_(open_gltf_container(file, bytes)),
          root_(parse_gltf_json(file, container_.json)) {}

    std::vector<unsigned char> read(const std::string& part) const {
        const json& image = chosen(part);
        if (!is_within_gltf(root_, image))
            fail("an image of the glTF file that lies in a file of its own", "that file");
        if (const json& uri = member_of(image, "uri"); uri.is_string())
            return decoded(uri.get<std::string>());
        return viewed(element(root_, "bufferViews", member_of(image, "bufferView")));
    }

  private:
    [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
        throw InputError(file_, key_, found, expected);
    }

    const json& chosen(const std::string& part) const {
        const json& images = member_of(root_, "images");
        const std::size_t count = images.is_array() ? images.size() : 0;
        if (part.empty() && count == 1) return images[0];
        for (std::size_t i = 0; i < count && !part.empty(); ++i)
            if (member_of(images[i], "name") == json(part)) return images[i];
        for (std::size_t i = 0; i < count; ++i)
            if (std::to_string(i) == part) return images[i];
        fail(part.empty() ? fmt::format("a glTF file of {} images", count)
                          : fmt::format("no image \"{}\"", part),
             fmt::format("the \"part\" that is meant: a name, or a number below {}", count));
    }

    std::vector<unsigned char> decoded(const std::string& uri) const {
        std::vector<unsigned char> bytes = gltf_data(uri);
        if (bytes.empty()) fail("an image whose data are not base64", "base64");
        return bytes;
    }

    std::size_t number(const json& object, const char* name) const {
        const json& value = member_of(object, name);
        if (value.is_null()) return 0;
        if (!value.is_number_unsigned()) fail("an image in a damaged buffer view", "glTF 2.0");
        return value.get<std::size_t>();
    }

    std::vector<unsigned char> viewed(const json& view) const {
        const json& buffer = element(root_, "buffers", member_of(view, "buffer"));
        const std::size_t from = number(view, "byteOffset"), size = number(view, "byteLength");
        const json& uri = member_of(buffer, "uri");
        std::vector<unsigned char> bytes;
        if (uri.is_string())
            bytes = decoded(uri.get<std::string>());
        else if (container_.binary)
            bytes.assign(container_.binary->begin(), container_.binary->end());
        if (size == 0 || from > bytes.size() || size > bytes.size() - from)
            fail(fmt::format("an image in the bytes {} to {} of a buffer of {}", from, from + size,
                             bytes.size()),
                 "bytes that there are");
        return {bytes.begin() + static_cast<std::ptrdiff_t>(from),
                bytes.begin() + static_cast<std::ptrdiff_t>(from + size)};
    }

    const std::string &file_, &key_;
    GltfContainer container_;
    json root_;
};

}  // namespace

bool is_within_gltf(const json& root, const json& image) {
    const json& uri = member_of(image, "uri");
    if (uri.is_string()) return is_gltf_data(uri.get<std::string>());
    const json& view = element(root, "bufferViews", member_of(image, "bufferView"));
    const json& buffer = element(root, "buffers", member_of(view, "buffer"));
    return buffer.is_object() && is_inside(member_of(buffer, "uri"));
}

std::vector<unsigned char> read_gltf_image(const std::string& file, std::string_view bytes,
                                           const std::string& part, const std::string& key) {
    return ImageReader(file, key, bytes).read(part);
}

}  // namespace quadrel
