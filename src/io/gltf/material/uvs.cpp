#include "io/gltf/material/uvs.hpp"

#include <cmath>
#include <optional>

#include "scene/degrees.hpp"

namespace quadrel {
namespace {

using nlohmann::json;

constexpr double degrees_per_radian = 57.295779513082323;

const json* member(const json& object, const char* key) {
    const auto found = object.is_object() ? object.find(key) : object.end();
    return object.is_object() && found != object.end() ? &*found : nullptr;
}

/// Looks at a texture's description, and where it stands.
class TextureReader {
  public:
    TextureReader(const GltfFile& file, int set) : file_(file), set_(set) {}

    /// The transform, if the texture reads the set.
    std::optional<UvTransform> transform(const json& texture, const std::string& key) const {
        const json* const extensions = member(texture, "extensions");
        const json* const extension =
            extensions ? member(*extensions, "KHR_texture_transform") : nullptr;
        if (coordinates(texture, extension, key) != set_) return std::nullopt;
        return extension ? read(*extension, key) : UvTransform{};
    }

    double coordinates(const json& texture, const json* extension, const std::string& key) const {
        const json* set = extension ? member(*extension, "texCoord") : nullptr;
        if (!set) set = member(texture, "texCoord");
        return set ? number(*set, key + ".texCoord") : 0;
    }

  private:
    double number(const json& value, const std::string& key) const {
        if (!value.is_number()) file_.fail(key, value.dump(), "a number");
        return value.get<double>();
    }

    glm::dvec2 pair(const json& extension, const char* name, const glm::dvec2& none,
                    const std::string& key) const {
        const json* const value = member(extension, name);
        if (!value) return none;
        const std::string place = key + ".extensions.KHR_texture_transform." + name;
        if (!value->is_array() || value->size() != 2) file_.fail(place, value->dump(), "2 numbers");
        return {number((*value)[0], place), number((*value)[1], place)};
    }

    // Translation times rotation times scale. Rotation turns counter-clockwise as a picture shows
    // UV, v downwards: the text, the examples and all implementations agree on that; the listing in
    // the extension's specification turns the other way (github.com/KhronosGroup/glTF, issue 1563).
    UvTransform read(const json& extension, const std::string& key) const {
        const glm::dvec2 scale = pair(extension, "scale", {1, 1}, key);
        const json* const rotation = member(extension, "rotation");
        const double angle = rotation ? number(*rotation, key + ".rotation") : 0;
        const auto [sine, cosine] = sin_cos_degrees(angle * degrees_per_radian);
        UvTransform transform;
        transform.linear[0] = glm::dvec2(cosine, -sine) * scale.x;
        transform.linear[1] = glm::dvec2(sine, cosine) * scale.y;
        transform.offset = pair(extension, "offset", {0, 0}, key);
        return transform;
    }

    const GltfFile& file_;
    int set_;
};

/// The first texture with a transform below `value`, whatever extension describes it.
std::optional<UvTransform> in_extensions(const TextureReader& reader, const json& value,
                                         const std::string& key) {
    if (!value.is_structured()) return std::nullopt;
    if (member(value, "index") && member(value, "extensions")) return reader.transform(value, key);
    for (const auto& [name, below] : value.items())
        if (const auto found = in_extensions(reader, below, key + "." + name)) return found;
    return std::nullopt;
}

const json* core_texture(const json& material, const char* group, const char* name) {
    const json* const place = *group ? member(material, group) : &material;
    return place ? member(*place, name) : nullptr;
}

}  // namespace

MaterialUvs material_uvs(const GltfFile& file, int material, int set) {
    MaterialUvs uvs;
    const json* const list = member(file.json, "materials");
    if (material < 0) {
        uvs.has_tangents = set == 0;
        return uvs;
    }
    const std::string key = "materials[" + std::to_string(material) + "]";
    if (!list || static_cast<std::size_t>(material) >= list->size())
        file.fail(key, "a reference to it", "one that there is");
    const json& found = (*list)[static_cast<std::size_t>(material)];
    const TextureReader reader(file, set);
    const json* const normal = member(found, "normalTexture");
    uvs.has_tangents = normal ? reader.transform(*normal, key).has_value() : set == 0;
    constexpr const char* metal = "pbrMetallicRoughness";
    constexpr const char* order[][2] = {{metal, "baseColorTexture"},
                                        {"", "normalTexture"},
                                        {"", "occlusionTexture"},
                                        {"", "emissiveTexture"},
                                        {metal, "metallicRoughnessTexture"}};
    std::optional<UvTransform> first;
    for (const auto& [group, name] : order)
        if (const json* const texture = core_texture(found, group, name))
            if (const auto transform = reader.transform(*texture, key + "." + name)) {
                uvs.others_differ = uvs.others_differ || (first && !(*transform == *first));
                if (!first) first = transform;
            }
    const json* const extensions = member(found, "extensions");
    if (!first && extensions) first = in_extensions(reader, *extensions, key);
    uvs.transform = first.value_or(UvTransform{});
    return uvs;
}

std::optional<UvTransform> texture_uvs(const GltfFile& file, const nlohmann::json& texture,
                                       const std::string& key, int set) {
    return TextureReader(file, set).transform(texture, key);
}

}  // namespace quadrel
