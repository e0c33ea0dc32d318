#include "file/read_file.hpp"
#include "io/scene/read.hpp"
#include "quadrel/scene/hardware_sampler.hpp"
#include "texture/swizzle.hpp"
#include "texture/texel_format.hpp"

namespace quadrel {
namespace {

constexpr Word<bool> colour_space_words[] = {{"linear", false}, {"srgb", true}};
constexpr Word<MipRule> mip_words[] = {
    {"none", MipRule::none}, {"box", MipRule::box}, {"area", MipRule::area}};
constexpr Word<Wrap> wrap_words[] = {{"repeat", Wrap::repeat},
                                     {"mirrored-repeat", Wrap::mirrored_repeat},
                                     {"clamp-to-edge", Wrap::clamp_to_edge},
                                     {"clamp-to-border", Wrap::clamp_to_border},
                                     {"mirror-once", Wrap::mirror_once}};
constexpr Word<Filter> mag_words[] = {{"nearest", Filter::nearest}, {"linear", Filter::linear}};
constexpr Word<std::pair<Filter, MipFilter>> min_words[] = {
    {"nearest", {Filter::nearest, MipFilter::none}},
    {"linear", {Filter::linear, MipFilter::none}},
    {"nearest-mipmap-nearest", {Filter::nearest, MipFilter::nearest}},
    {"linear-mipmap-nearest", {Filter::linear, MipFilter::nearest}},
    {"nearest-mipmap-linear", {Filter::nearest, MipFilter::linear}},
    {"linear-mipmap-linear", {Filter::linear, MipFilter::linear}}};

void read_wrap(const SceneValue& value, SamplerState& sampler) {
    if (!value.json().is_array()) {
        sampler.wrap_u = sampler.wrap_v = value.word(wrap_words);
        return;
    }
    if (value.json().size() != 2) value.reject("one wrap mode, or an array of 2: for u and for v");
    sampler.wrap_u = value.element(0).word(wrap_words);
    sampler.wrap_v = value.element(1).word(wrap_words);
}

void read_sampler(Fields& fields, Hardware hardware, SamplerState& sampler) {
    if (fields.has("wrap")) read_wrap(fields.get("wrap"), sampler);
    fields.read("mag", sampler.mag, mag_words);
    std::pair<Filter, MipFilter> min(sampler.min, sampler.mip);
    fields.read("min", min, min_words);
    sampler.min = min.first;
    sampler.mip = min.second;
    glm::vec4 border(0, 0, 0, 0);
    fields.read("border", border);
    for (int i = 0; i < 4; ++i) sampler.border[i] = border[i];
    fields.read("lod_bias", sampler.lod_bias);
    fields.read("lod_min", sampler.lod_min);
    fields.read("lod_max", sampler.lod_max);
    if (sampler.lod_min > sampler.lod_max)
        fields.value().fail("lod_min above lod_max", "lod_min <= lod_max");
    sampler = on_hardware(sampler, hardware_model(hardware));
}

/// A part is named, or counted from 0.
void read_selection(Fields& fields, ImageSelection& selection) {
    if (fields.has("layer")) {
        fields.read("layer", selection.layer);
        if (selection.layer.empty()) fields.get("layer").reject("the name of a layer");
    }
    if (!fields.has("part")) return;
    const SceneValue part = fields.get("part");
    const Json& json = part.json();
    if (json.is_string())
        selection.part = part.string();
    else if (json.is_number_integer() && json.get<double>() >= 0)
        selection.part = json.dump();
    if (selection.part.empty()) part.reject("the name of a part, or its number from 0");
}

/// A face of an environment: a file, or an object with the image that is meant.
std::filesystem::path read_face(const SceneValue& value, ImageSelection& selection) {
    if (!value.json().is_object()) return read_path(value);
    Fields fields(value);
    read_selection(fields, selection);
    const std::filesystem::path file = read_path(fields.get("file"));
    fields.finish("a face");
    return file;
}

// One to four of r g b a 0 1 and 1-r 1-g 1-b 1-a.
bool is_swizzle(std::string_view text) {
    int channels = 0;
    while (!text.empty()) {
        constexpr std::string_view letters = "rgba", plain = "rgba01";
        if (text.size() >= 3 && text.substr(0, 2) == "1-" && letters.find(text[2]) != letters.npos)
            text.remove_prefix(3);
        else if (plain.find(text[0]) != plain.npos)
            text.remove_prefix(1);
        else
            return false;
        ++channels;
    }
    return channels >= 1 && channels <= 4;
}

}  // namespace

std::filesystem::path read_path(const SceneValue& value) {
    const std::filesystem::path path =
        value.document().file.parent_path() / std::filesystem::path(value.string());
    if (const char* reason = reason_not_to_read(path))
        value.fail(reason + (" (" + path.string() + ")"), "a file");
    return path;
}

TextureReference read_texture(const SceneValue& value, Hardware hardware) {
    Fields fields(value);
    TextureReference texture;
    texture.key = value.path();
    texture.file = read_path(fields.get("file"));
    read_selection(fields, texture.selection);
    fields.read("swizzle", texture.swizzle);
    if (!texture.swizzle.empty() && texture.swizzle != alpha_or_first &&
        !is_swizzle(texture.swizzle))
        value.member("swizzle").reject(
            "1 to 4 of r g b a 0 1 1-r 1-g 1-b 1-a, without blanks, or alpha-or-first");
    fields.read("colour_space", texture.srgb, colour_space_words);
    if (fields.has("format")) texture.format = fields.get("format").word(named_formats);
    fields.read("mip", texture.mip_rule, mip_words);
    fields.read("flip_v", texture.flip_v);
    fields.read("allow_nan", texture.allow_nan);
    read_sampler(fields, hardware, texture.sampler);
    fields.finish("a texture");
    return texture;
}

Environment read_environment(const SceneValue& value, Hardware hardware) {
    Fields fields(value);
    Environment environment;
    environment.key = value.path();
    const SceneValue faces = fields.get("faces");
    if (!faces.json().is_array() || faces.json().size() != 6)
        faces.reject("an array of 6 files: +X -X +Y -Y +Z -Z");
    for (std::size_t i = 0; i < 6; ++i)
        environment.faces[i] = read_face(faces.element(i), environment.selections[i]);
    fields.read("colour_space", environment.srgb, colour_space_words);
    if (fields.has("format")) environment.format = fields.get("format").word(named_formats);
    fields.read("mip", environment.mip_rule, mip_words);
    read_sampler(fields, hardware, environment.sampler);
    fields.finish("an environment");
    return environment;
}

}  // namespace quadrel
