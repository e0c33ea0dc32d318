#include "io/gltf/materials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "io/gltf/buffers.hpp"
#include "io/gltf/nodes.hpp"
#include "io/gltf/open.hpp"
#include "io/gltf/uvs.hpp"

namespace quadrel {
namespace {

using nlohmann::json;

/// Reflectance of what is no metal, at normal incidence (glTF 2.0, B.2).
constexpr double dielectric = 0.04;
/// Of the default material's reflectance of ambient light.
constexpr double ambient_share = 0.1;

const json& member_of(const json& object, const char* key) {
    static const json none;
    if (!object.is_object()) return none;
    const auto found = object.find(key);
    return found == object.end() ? none : *found;
}

const json& element(const json& root, const char* list, const json& index) {
    static const json none;
    const json& all = member_of(root, list);
    if (!all.is_array() || !index.is_number_unsigned()) return none;
    const auto i = index.get<std::size_t>();
    return i < all.size() ? all[i] : none;
}

double number_or(const json& value, double absent) {
    return value.is_number() ? value.get<double>() : absent;
}

/// Materials of the triangles that are drawn; -1 for none.
std::set<int> drawn_materials(const GltfFile& file) {
    std::set<int> materials;
    const GltfNodes nodes = lay_out_nodes(file);
    for (const int node : nodes.drawn) {
        const int mesh = file.model.nodes[static_cast<std::size_t>(node)].mesh;
        for (const auto& primitive : file.model.meshes[static_cast<std::size_t>(mesh)].primitives)
            if (primitive.mode >= TINYGLTF_MODE_TRIANGLES) materials.insert(primitive.material);
    }
    return materials;
}

const char* wrap_word(const json& code) {
    if (code == 33071) return "clamp-to-edge";
    return code == 33648 ? "mirrored-repeat" : "repeat";
}

/// Null for what the file leaves open.
const char* filter_word(const json& code) {
    constexpr std::pair<int, const char*> words[] = {{9728, "nearest"},
                                                     {9729, "linear"},
                                                     {9984, "nearest-mipmap-nearest"},
                                                     {9985, "linear-mipmap-nearest"},
                                                     {9986, "nearest-mipmap-linear"},
                                                     {9987, "linear-mipmap-linear"}};
    for (const auto& [known, word] : words)
        if (code == known) return word;
    return nullptr;
}

class MaterialReader {
  public:
    MaterialReader(const GltfFile& file, std::filesystem::path folder, int index, int uv_set)
        : file_(file),
          folder_(std::move(folder)),
          key_(fmt::format("materials[{}]", index)),
          material_(element(file.json, "materials", static_cast<unsigned>(index))),
          metal_(member_of(material_, "pbrMetallicRoughness")),
          mesh_uvs_(material_uvs(file, index, uv_set).transform),
          uv_set_(uv_set) {
        read_.name = member_of(material_, "name").is_string()
                         ? member_of(material_, "name").get<std::string>()
                         : key_;
    }

    GltfMaterial read() {
        read_base_colour();
        read_normal();
        read_emission();
        read_shading();
        read_sides();
        if (!member_of(material_, "occlusionTexture").is_null())
            leave("occlusion", "no map of it is read");
        return std::move(read_);
    }

  private:
    void take(const char* what) { read_.taken.emplace_back(what); }
    void leave(const char* what, const std::string& why) {
        read_.left.push_back(fmt::format("{} ({})", what, why));
    }

    /// A scene's texture; nothing where it cannot be one, which is said then.
    std::optional<Json> texture(const json& described, const char* what, bool srgb) {
        const auto uvs = texture_uvs(file_, described, key_, uv_set_);
        if (!uvs) {
            leave(what, "another set of texture coordinates");
            return std::nullopt;
        }
        if (!(*uvs == mesh_uvs_)) {
            leave(what, "another texture transform");
            return std::nullopt;
        }
        const json& found = element(file_.json, "textures", member_of(described, "index"));
        const json& uri =
            member_of(element(file_.json, "images", member_of(found, "source")), "uri");
        const auto path = uri.is_string() ? gltf_uri_path(uri.get<std::string>(), folder_)
                                          : std::optional<std::filesystem::path>();
        if (!path) {
            leave(what, "an image within the file");
            return std::nullopt;
        }
        std::error_code none;
        if (!std::filesystem::is_regular_file(*path, none)) {
            leave(what, "no file " + path->string());
            return std::nullopt;
        }
        return texture_of(*path, element(file_.json, "samplers", member_of(found, "sampler")),
                          srgb);
    }

    static Json texture_of(const std::filesystem::path& path, const json& sampler, bool srgb) {
        Json text = {{"file", std::filesystem::absolute(path).string()}};
        if (srgb) text["colour_space"] = "srgb";
        const char *const u = wrap_word(member_of(sampler, "wrapS")), *const v =
                                                                          wrap_word(member_of(
                                                                              sampler, "wrapT"));
        text["wrap"] = {u, v};
        if (const char* const mag = filter_word(member_of(sampler, "magFilter"))) text["mag"] = mag;
        if (const char* const min = filter_word(member_of(sampler, "minFilter"))) text["min"] = min;
        return text;
    }

    static std::vector<double> numbers_or(const json& values, std::vector<double> absent) {
        if (!values.is_array() || values.size() != absent.size()) return absent;
        for (std::size_t i = 0; i < absent.size(); ++i) absent[i] = number_or(values[i], absent[i]);
        return absent;
    }

    void read_base_colour() {
        base_ = numbers_or(member_of(metal_, "baseColorFactor"), {1, 1, 1, 1});
        const json& described = member_of(metal_, "baseColorTexture");
        if (!described.is_null())
            if (const auto found = texture(described, "base colour", true)) {
                read_.keys["color"] = *found;
                take("base colour");
                return;
            }
        if (member_of(metal_, "baseColorFactor").is_array()) take("base colour");
    }

    void read_normal() {
        const json& described = member_of(material_, "normalTexture");
        if (described.is_null()) return;
        const auto found = texture(described, "normal", false);
        if (!found) return;
        if (number_or(member_of(described, "scale"), 1) != 1)
            leave("scale of the normal", "none here");
        read_.keys["normal"] = *found;
        take("normal");
    }

    void read_emission() {
        const std::vector<double> factor =
            numbers_or(member_of(material_, "emissiveFactor"), {0, 0, 0});
        const json& described = member_of(material_, "emissiveTexture");
        const bool white = factor == std::vector<double>{1, 1, 1};
        if (described.is_null()) {
            if (factor == std::vector<double>{0, 0, 0}) return;
            read_.keys["emission"] = {factor[0], factor[1], factor[2], 1};
            take("emission");
        } else if (!white) {
            leave("emission", "a texture with a factor");
        } else if (const auto found = texture(described, "emission", true)) {
            read_.keys["emissive"] = *found;
            take("emission");
        }
    }

    /// A metal has no colour but that of its mirror, and all else a mirror without colour.
    void read_shading() {
        const double metal = number_or(member_of(metal_, "metallicFactor"), 1);
        const double rough = number_or(member_of(metal_, "roughnessFactor"), 1);
        const bool mapped = !member_of(metal_, "metallicRoughnessTexture").is_null();
        if (mapped) leave("map of roughness and metalness", "shading has none");
        const double metalness = mapped ? 0 : metal;
        Json diffuse, specular, ambient;
        for (std::size_t i = 0; i < 3; ++i) {
            diffuse.push_back(base_[i] * (1 - metalness));
            ambient.push_back(ambient_share * base_[i]);
            specular.push_back(dielectric * (1 - metalness) + base_[i] * metalness);
        }
        for (Json* const colour : {&diffuse, &specular, &ambient}) colour->push_back(1);
        read_.keys["diffuse"] = diffuse;
        read_.keys["specular"] = specular;
        read_.keys["ambient"] = ambient;
        constexpr double least_slope = 0.001;
        read_.keys["shade"] = {{"id", "shade-cook-torrance"},
                               {"roughness", std::max(rough * rough, least_slope)}};
        take("roughness");
        if (!mapped) take("metalness");
    }

    void read_sides() {
        if (member_of(material_, "doubleSided") != json(true)) {
            read_.keys["cull"] = "back";
            take("its one side");
        }
        const json& mode = member_of(material_, "alphaMode");
        if (mode == json("MASK")) {
            read_.keys["discard_below"] = number_or(member_of(material_, "alphaCutoff"), 0.5);
            take("its cut-off alpha");
        } else if (mode == json("BLEND")) {
            leave("blending", "nothing is blended");
        }
    }

    const GltfFile& file_;
    std::filesystem::path folder_;
    std::string key_;
    const json &material_, &metal_;
    UvTransform mesh_uvs_;
    int uv_set_;
    std::vector<double> base_;
    GltfMaterial read_;
};

}  // namespace

GltfMaterial read_gltf_material(const std::filesystem::path& path, int uv_set) {
    const GltfFile file = open_gltf(path);
    const std::set<int> materials = drawn_materials(file);
    GltfMaterial none;
    none.keys = Json::object();
    if (materials.empty() || materials == std::set<int>{-1}) return none;
    if (materials.size() > 1) {
        none.name = fmt::format("{} materials", materials.size());
        none.left.emplace_back("all of them (one can be taken)");
        return none;
    }
    return MaterialReader(file, path.parent_path(), *materials.begin(), uv_set).read();
}

}  // namespace quadrel
