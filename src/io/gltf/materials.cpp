#include "io/gltf/materials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
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

    /// The member `key` of `object`, which lies at `path` in the material ("" for itself).
    double number(const json& object, const std::string& path, const char* key, double absent,
                  double most = 1) const {
        const json& value = member_of(object, key);
        return value.is_null() ? absent : checked(value, path + key, most);
    }
    double checked(const json& value, const std::string& path, double most = 1) const {
        if (!value.is_number() || !(value.get<double>() >= 0 && value.get<double>() <= most))
            file_.fail(key_ + "." + path, value.dump(),
                       most == 1 ? "a number in [0, 1]" : "a number >= 0");
        return value.get<double>();
    }
    /// A colour, or what stands for it where there is none.
    std::vector<double> numbers(const json& object, const std::string& path, const char* key,
                                std::vector<double> absent, double most = 1) const {
        const json& values = member_of(object, key);
        if (values.is_null()) return absent;
        if (!values.is_array() || values.size() != absent.size())
            file_.fail(key_ + "." + path + key, values.dump(),
                       fmt::format("{} numbers", absent.size()));
        for (std::size_t i = 0; i < absent.size(); ++i)
            absent[i] = checked(values[i], fmt::format("{}{}[{}]", path, key, i), most);
        return absent;
    }

    /// A scene's texture; nothing where it cannot be one, which is said then. `path` leads to it.
    std::optional<Json> texture(const json& described, const std::string& path, const char* what,
                                bool srgb) {
        const json& index = member_of(described, "index");
        const std::size_t count = member_of(file_.json, "textures").size();
        if (!index.is_number_unsigned() || index.get<std::size_t>() >= count)
            file_.fail(key_ + "." + path + ".index", index.is_null() ? "none" : index.dump(),
                       fmt::format("one of the file's {} textures", count));
        const auto uvs = texture_uvs(file_, described, key_, uv_set_);
        if (!uvs) {
            leave(what, "another set of texture coordinates");
            return std::nullopt;
        }
        if (!(*uvs == mesh_uvs_)) {
            leave(what, "another texture transform");
            return std::nullopt;
        }
        const json& found = element(file_.json, "textures", index);
        const json& uri =
            member_of(element(file_.json, "images", member_of(found, "source")), "uri");
        const auto image = uri.is_string() ? gltf_uri_path(uri.get<std::string>(), folder_)
                                           : std::optional<std::filesystem::path>();
        if (!image) {
            leave(what, "an image within the file");
            return std::nullopt;
        }
        std::error_code none;
        if (!std::filesystem::is_regular_file(*image, none)) {
            leave(what, "no file " + image->string());
            return std::nullopt;
        }
        return texture_of(*image, element(file_.json, "samplers", member_of(found, "sampler")),
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

    void read_base_colour() {
        base_ = numbers(metal_, metal_path, "baseColorFactor", {1, 1, 1, 1});
        const json& described = member_of(metal_, "baseColorTexture");
        if (!described.is_null())
            if (const auto found = texture(described, metal_path + "baseColorTexture",
                                           "map of the base colour", true)) {
                read_.keys["color"] = *found;
                take("map of the base colour");
            }
        if (member_of(metal_, "baseColorFactor").is_array()) take("base colour");
    }

    void read_normal() {
        const json& described = member_of(material_, "normalTexture");
        if (described.is_null()) return;
        const auto found = texture(described, "normalTexture", "normal", false);
        if (!found) return;
        const json& scale = member_of(described, "scale");
        if (!scale.is_null() && scale != json(1)) leave("scale of the normal", "none here");
        read_.keys["normal"] = *found;
        take("normal");
    }

    void read_emission() {
        const std::vector<double> factor = numbers(material_, "", "emissiveFactor", {0, 0, 0});
        const json& described = member_of(material_, "emissiveTexture");
        const bool white = factor == std::vector<double>{1, 1, 1};
        if (described.is_null()) {
            if (factor == std::vector<double>{0, 0, 0}) return;
            read_.keys["emission"] = {factor[0], factor[1], factor[2], 1};
            take("emission");
        } else if (!white) {
            leave("emission", "a texture with a factor");
        } else if (const auto found = texture(described, "emissiveTexture", "emission", true)) {
            read_.keys["emissive"] = *found;
            take("emission");
        }
    }

    /// A metal has no colour but that of its mirror, and all else a mirror without colour.
    void read_shading() {
        const double metal = number(metal_, metal_path, "metallicFactor", 1);
        const double rough = number(metal_, metal_path, "roughnessFactor", 1);
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
            // A texture's alpha times the factor's is what is compared; what nothing reaches is 2.
            constexpr double any = std::numeric_limits<double>::max();
            const double cutoff = number(material_, "", "alphaCutoff", 0.5, any);
            read_.keys["discard_below"] = cutoff == 0    ? 0
                                          : base_[3] > 0 ? std::min(cutoff / base_[3], 2.0)
                                                         : 2.0;
            take("its cut-off alpha");
        } else if (mode == json("BLEND")) {
            leave("blending", "nothing is blended");
        }
    }

    inline static const std::string metal_path = "pbrMetallicRoughness.";

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
