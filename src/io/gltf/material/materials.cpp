#include "io/gltf/material/materials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <span>

#include "io/gltf/buffers.hpp"
#include "io/gltf/material/choice.hpp"
#include "io/gltf/material/images.hpp"
#include "io/gltf/material/members.hpp"
#include "io/gltf/material/uvs.hpp"
#include "io/gltf/nodes.hpp"
#include "io/gltf/open.hpp"

namespace quadrel {
namespace {

using nlohmann::json;

/// Of the default material's reflectance of ambient light.
constexpr double ambient_share = 0.1;

/// Materials of the triangles that are drawn, -1 being none, and whether any of them has the set of
/// texture coordinates.
std::map<int, bool> drawn_materials(const GltfFile& file, const MeshFileOptions& options) {
    std::map<int, bool> materials;
    const std::string set = fmt::format("TEXCOORD_{}", options.uv_set);
    const GltfNodes nodes = lay_out_nodes(file);
    for (const int node : nodes.drawn) {
        const int mesh = file.model.nodes[static_cast<std::size_t>(node)].mesh;
        for (const auto& primitive : file.model.meshes[static_cast<std::size_t>(mesh)].primitives)
            if (primitive.mode >= TINYGLTF_MODE_TRIANGLES)
                materials[primitive.material] |= primitive.attributes.count(set) > 0;
    }
    if (options.material) {
        const int chosen = gltf_material(file, *options.material);
        std::erase_if(materials, [&](const auto& entry) { return entry.first != chosen; });
    }
    return materials;
}

/// A number that glTF gives a meaning, and a scene's word for it.
struct Code {
    int number;
    const char* word;
};

// glTF 2.0, 5.26.
constexpr Code wrap_codes[] = {
    {10497, "repeat"}, {33071, "clamp-to-edge"}, {33648, "mirrored-repeat"}};
constexpr Code mag_codes[] = {{9728, "nearest"}, {9729, "linear"}};
constexpr Code min_codes[] = {{9728, "nearest"},
                              {9729, "linear"},
                              {9984, "nearest-mipmap-nearest"},
                              {9985, "linear-mipmap-nearest"},
                              {9986, "nearest-mipmap-linear"},
                              {9987, "linear-mipmap-linear"}};

/// "9728 (nearest), 9729 (linear)".
std::string codes_text(std::span<const Code> codes) {
    std::vector<std::string> texts;
    for (const auto& [number, word] : codes) texts.push_back(fmt::format("{} ({})", number, word));
    return fmt::format("{}", fmt::join(texts, ", "));
}

class MaterialReader {
  public:
    /// `has_uvs`: whether the mesh has the set of texture coordinates.
    MaterialReader(const GltfFile& file, int index, int uv_set, bool has_uvs)
        : file_(file),
          path_(file.name),
          key_(fmt::format("materials[{}]", index)),
          material_(element(file.json, "materials", static_cast<unsigned>(index))),
          metal_(member_of(material_, "pbrMetallicRoughness")),
          mesh_uvs_(material_uvs(file, index, uv_set).transform),
          uv_set_(uv_set),
          has_uvs_(has_uvs) {
        read_.number = index;
        read_.name = gltf_material_name(file, index);
    }

    GltfMaterial read() {
        read_base_colour();
        read_normal();
        read_emission();
        read_shading();
        read_sides();
        return std::move(read_);
    }

  private:
    void take(const char* what, const char* key) { read_.words.push_back({what, key}); }
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
        if (!has_uvs_) {
            leave(what, "no texture coordinates");
            return std::nullopt;
        }
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
        std::optional<Json> text = image_text(image_of(found), what);
        if (!text) return std::nullopt;
        if (srgb) (*text)["colour_space"] = "srgb";
        add_sampler(member_of(found, "sampler"),
                    fmt::format("textures[{}].sampler", index.get<std::size_t>()), *text);
        return text;
    }

    /// That of the format which all know, else that of WebP, which some exporters give alone.
    const json& image_of(const json& found) const {
        const json& source = member_of(found, "source");
        const json& webp =
            member_of(member_of(member_of(found, "extensions"), "EXT_texture_webp"), "source");
        return element(file_.json, "images", source.is_null() ? webp : source);
    }

    /// Where the image is, in the words of a texture.
    std::optional<Json> image_text(const json& image, const char* what) {
        if (!image.is_object()) {
            leave(what, "no image of a known format");
            return std::nullopt;
        }
        if (is_within_gltf(file_.json, image)) {
            const auto& images = file_.json["images"];
            const auto number = &image - &images[0];
            return Json{{"file", std::filesystem::absolute(path_).string()}, {"part", number}};
        }
        const json& uri = member_of(image, "uri");
        if (!uri.is_string()) {
            leave(what, "an image in a buffer of its own file");
            return std::nullopt;
        }
        const auto file = gltf_uri_path(uri.get<std::string>(), path_.parent_path());
        std::error_code none;
        if (!std::filesystem::is_regular_file(*file, none)) {
            const auto number = &image - &file_.json["images"][0];
            file_.fail(
                fmt::format("images[{}].uri", number), "no file " + file->string(),
                fmt::format("the image of the {}, or \"materials\": false in the mesh", what));
        }
        return Json{{"file", std::filesystem::absolute(*file).string()}};
    }

    /// The scene's word for what a sampler has at `key`; null where it has nothing.
    const char* sampler_word(const json& sampler, const std::string& path, const char* key,
                             std::span<const Code> codes) const {
        const json& value = member_of(sampler, key);
        if (value.is_null()) return nullptr;
        for (const auto& [number, word] : codes)
            if (value == number) return word;
        file_.fail(path + "." + key, value.dump(), codes_text(codes));
    }

    /// `index` is that of a sampler, or nothing, and stands at `key`.
    void add_sampler(const json& index, const std::string& key, Json& text) const {
        if (index.is_null()) return;
        const std::size_t count = member_of(file_.json, "samplers").size();
        if (!index.is_number_unsigned() || index.get<std::size_t>() >= count)
            file_.fail(key, index.dump(), fmt::format("one of the file's {} samplers", count));
        const json& sampler = element(file_.json, "samplers", index);
        const std::string path = fmt::format("samplers[{}]", index.get<std::size_t>());
        const auto word = [&](const char* name, std::span<const Code> codes) {
            return sampler_word(sampler, path, name, codes);
        };
        const char *const u = word("wrapS", wrap_codes), *const v = word("wrapT", wrap_codes);
        text["wrap"] = {u ? u : "repeat", v ? v : "repeat"};
        if (const char* const mag = word("magFilter", mag_codes)) text["mag"] = mag;
        if (const char* const min = word("minFilter", min_codes)) text["min"] = min;
    }

    void read_base_colour() {
        base_ = numbers(metal_, metal_path, "baseColorFactor", {1, 1, 1, 1});
        const json& described = member_of(metal_, "baseColorTexture");
        if (!described.is_null())
            if (const auto found = texture(described, metal_path + "baseColorTexture",
                                           "map of the base colour", true)) {
                read_.keys["color"] = *found;
                take("map of the base colour", "color");
            }
        if (member_of(metal_, "baseColorFactor").is_array()) take("base colour", "diffuse");
    }

    void read_normal() {
        const json& described = member_of(material_, "normalTexture");
        if (described.is_null()) return;
        const auto found = texture(described, "normalTexture", "normal", false);
        if (!found) return;
        const json& scale = member_of(described, "scale");
        if (!scale.is_null() && scale != json(1)) leave("scale of the normal", "none here");
        read_.keys["normal"] = *found;
        take("normal", "normal");
    }

    void read_emission() {
        const std::vector<double> factor = numbers(material_, "", "emissiveFactor", {0, 0, 0});
        if (factor == std::vector<double>{0, 0, 0}) return;
        const json& described = member_of(material_, "emissiveTexture");
        const bool white = factor == std::vector<double>{1, 1, 1};
        if (described.is_null()) {
            read_.keys["emission"] = {factor[0], factor[1], factor[2], 1};
            take("emission", "emission");
        } else if (!white) {
            leave("emission", "a texture with a factor");
        } else if (const auto found = texture(described, "emissiveTexture", "emission", true)) {
            read_.keys["emissive"] = *found;
            take("emission", "emissive");
        }
    }

    void read_shading() {
        Json diffuse, ambient;
        for (std::size_t i = 0; i < 3; ++i) {
            diffuse.push_back(base_[i]);
            ambient.push_back(ambient_share * base_[i]);
        }
        for (Json* const colour : {&diffuse, &ambient}) colour->push_back(1);
        read_.keys["diffuse"] = diffuse;
        read_.keys["ambient"] = ambient;
        Json shade = {{"id", "shade-metallic-roughness"},
                      {"roughness", number(metal_, metal_path, "roughnessFactor", 1)},
                      {"metalness", number(metal_, metal_path, "metallicFactor", 1)}};
        read_gloss(shade);
        read_.keys["shade"] = shade;
        take("roughness", "shade");
        take("metalness", "shade");
    }

    /// Occlusion, roughness and metalness are channels of one map, as files mostly have them; a
    /// second image for occlusion finds no place.
    void read_gloss(Json& shade) {
        const json& rough = member_of(metal_, "metallicRoughnessTexture");
        const json& occlusion = member_of(material_, "occlusionTexture");
        std::optional<Json> gloss, dims;
        if (!rough.is_null())
            gloss = texture(rough, metal_path + "metallicRoughnessTexture",
                            "map of roughness and metalness", false);
        if (!occlusion.is_null()) dims = texture(occlusion, "occlusionTexture", "occlusion", false);
        if (gloss) take("map of roughness and metalness", "gloss");
        if (gloss && dims && *gloss != *dims) {
            leave("occlusion", "another image than that of roughness");
            dims.reset();
        }
        if (dims) {
            take("occlusion", "gloss");
            shade["occlusion_strength"] = number(occlusion, "occlusionTexture.", "strength", 1);
        }
        if (!gloss && !dims) return;
        read_.keys["gloss"] = gloss ? *gloss : *dims;
        read_.keys["gloss"]["swizzle"] = !gloss ? "r11" : dims ? "rgb" : "1gb";
    }

    void read_sides() {
        const json& both = member_of(material_, "doubleSided");
        if (!both.is_null() && !both.is_boolean())
            file_.fail(key_ + ".doubleSided", both.dump(), "true or false");
        if (both != json(true)) {
            read_.keys["cull"] = "back";
            take("its one side", "cull");
        }
        const json& mode = member_of(material_, "alphaMode");
        if (!mode.is_null() && mode != json("OPAQUE") && mode != json("MASK") &&
            mode != json("BLEND"))
            file_.fail(key_ + ".alphaMode", mode.dump(), R"("OPAQUE", "MASK" or "BLEND")");
        if (mode == json("MASK")) {
            // A texture's alpha times the factor's is what is compared; what nothing reaches is 2.
            constexpr double any = std::numeric_limits<double>::max();
            const double cutoff = number(material_, "", "alphaCutoff", 0.5, any);
            read_.keys["discard_below"] = cutoff == 0    ? 0
                                          : base_[3] > 0 ? std::min(cutoff / base_[3], 2.0)
                                                         : 2.0;
            take("its cut-off alpha", "discard_below");
        } else if (mode == json("BLEND")) {
            leave("blending", "nothing is blended");
        }
    }

    inline static const std::string metal_path = "pbrMetallicRoughness.";

    const GltfFile& file_;
    std::filesystem::path path_;
    std::string key_;
    const json &material_, &metal_;
    UvTransform mesh_uvs_;
    int uv_set_;
    bool has_uvs_;
    std::vector<double> base_;
    GltfMaterial read_;
};

}  // namespace

std::vector<GltfMaterial> read_gltf_materials(const std::filesystem::path& path,
                                              const MeshFileOptions& options) {
    const GltfFile file = open_gltf(path);
    std::vector<GltfMaterial> all;
    for (const auto& [number, has_uvs] : drawn_materials(file, options)) {
        if (number >= 0)
            all.push_back(MaterialReader(file, number, options.uv_set, has_uvs).read());
        else
            all.emplace_back().name = gltf_material_name(file, number);
    }
    return all;
}

}  // namespace quadrel
