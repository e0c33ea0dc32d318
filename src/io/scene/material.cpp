#include "io/scene/read.hpp"
#include "quadrel/scene/presets.hpp"
#include "quadrel/scene/transform.hpp"
#include "text/not_finite.hpp"

namespace quadrel {
namespace {

constexpr Word<Cull> cull_words[] = {
    {"none", Cull::none}, {"back", Cull::back}, {"front", Cull::front}};
constexpr const char* texture_slots[] = {
    "color",    "height",          "gloss",           "emissive", "normal",  "layers", "layers_2",
    "layers_3", "layer_normals_x", "layer_normals_y", "color_2",  "color_3", "color_4"};

void read_parameters(Fields& fields, StageChoice& stage) {
    for (const std::string& name : fields.rest()) {
        const SceneValue value = fields.value().member(name);
        if (value.json().is_string() && !spells_not_finite(value.string()))
            stage.parameters[name] = value.string();
        else
            stage.parameters[name] = value.number();
    }
}

// A stage's id, or an object of its id and parameters; where there is none, `stage` stays.
void read_stage(Fields& fields, const std::string& key, StageChoice& stage) {
    if (stage.id.empty()) stage.key = join_key(fields.value().path(), key);
    if (!fields.has(key)) return;
    stage = {};
    stage.key = join_key(fields.value().path(), key);
    const SceneValue value = fields.get(key);
    if (value.json().is_string()) {
        stage.id = value.string();
    } else if (value.json().is_object()) {
        Fields members(value);
        members.read("id", stage.id);
        read_parameters(members, stage);
    } else {
        value.reject("a stage's id, or an object {\"id\": ..., parameters}");
    }
}

/// Squares of what is so deep, and sums of them, are still floats.
constexpr Range depth_range{.low = 0, .high = 1e12};

// A length in world units, or the thickness of the relief and the size of a tile, both in one unit.
void read_depth(Fields& relief, Material& material) {
    if (!relief.has("depth") || !relief.get("depth").json().is_object())
        return relief.read("depth", material.depth, depth_range);
    Fields fields(relief.get("depth"));
    const double thickness = fields.get("thickness").number(not_negative);
    const double tile = fields.get("tile").number(above_zero);
    fields.finish("a depth");
    if (thickness / tile > depth_range.high)
        relief.get("depth").reject("a thickness of at most 1e12 tiles");
    material.depth = static_cast<float>(thickness / tile);
    material.depth_in_tiles = true;
}

void read_fade(Fields& relief, Material& material) {
    if (!relief.has("grazing_fade")) return;
    const auto angles = relief.get("grazing_fade").numbers(2, 2);
    if (!(angles[0] >= 0 && angles[0] < angles[1] && angles[1] <= 90))
        relief.get("grazing_fade").reject("two angles in degrees, 0 <= from < to <= 90");
    material.fade_from = angles[0];
    material.fade_to = angles[1];
}

// What the relief's own keys then replace.
void read_preset(Fields& relief, Material& material) {
    if (!relief.has("preset")) return;
    const SceneValue value = relief.get("preset");
    const Preset* preset = find_preset(value.string());
    if (!preset) {
        std::vector<std::string> names;
        for (const Preset& known : all_presets()) names.push_back(known.name);
        value.reject("the name of a preset: " + one_of(value.string(), names));
    }
    apply_preset(*preset, value.path(), material);
}

void read_relief(const SceneValue& value, Material& material) {
    Fields relief(value);
    read_preset(relief, material);
    read_stage(relief, "frame", material.frame);
    read_stage(relief, "trace", material.trace);
    read_stage(relief, "clip", material.clip);
    read_stage(relief, "frag_depth", material.frag_depth);
    read_stage(relief, "surface", material.surface);
    read_stage(relief, "shadow", material.shadow);
    read_stage(relief, "occlusion", material.occlusion);
    read_depth(relief, material);
    read_fade(relief, material);
    relief.read("seat", material.seat, unit_interval);
    read_parameters(relief, material.trace);
}

void read_colours(Fields& fields, Material& material) {
    fields.read("ambient", material.ambient, not_negative);
    fields.read("diffuse", material.diffuse, not_negative);
    fields.read("specular", material.specular, not_negative);
    fields.read("emission", material.emission, not_negative);
    fields.read("shininess", material.shininess, not_negative);
}

bool is_noise(const Fields& fields) {
    if (!fields.has("height")) return false;
    const Json& height = fields.value().json()["height"];
    return height.is_object() && height.contains("noise");
}

// {"noise": {...}} and nothing else, in place of a height map.
NoiseHeights read_noise(const SceneValue& value) {
    Fields height(value), fields(height.get("noise"));
    NoiseHeights noise;
    constexpr Range frequencies{.low = 1.0 / 4096, .high = NoiseHeights::max_frequency};
    fields.read("frequency", noise.frequency, frequencies);
    if (fields.has("octaves"))
        noise.octaves = fields.get("octaves").integer(1, NoiseHeights::max_octaves);
    fields.finish("noise");
    height.finish("a height of noise");
    return noise;
}

void read_maps(Fields& fields, const TextureTable& textures, Hardware hardware,
               Material& material) {
    const bool noise = is_noise(fields);
    if (noise) material.noise = read_noise(fields.get("height"));
    for (const std::string slot : texture_slots)
        if (fields.has(slot) && !(noise && slot == "height"))
            material.textures[slot] = read_slot(fields.get(slot), textures, hardware);
}

}  // namespace

glm::mat4 read_texture_matrix(const SceneValue& value) {
    if (value.json().is_array()) return glm::mat4(read_matrix(value));
    Fields fields(value);
    glm::dvec2 scale(1, 1), offset(0, 0);
    double degrees = 0;
    if (fields.has("scale")) {
        const auto factors = fields.get("scale").numbers(2, 2);
        scale = {factors[0], factors[1]};
    }
    fields.read("rotate", degrees);
    if (fields.has("offset")) {
        const auto shift = fields.get("offset").numbers(2, 2);
        offset = {shift[0], shift[1]};
    }
    fields.finish("a texture matrix");
    return glm::mat4(translation({offset, 0}) * rotation(degrees, {0, 0, 1}) * scaling({scale, 1}));
}

TextureReference read_slot(const SceneValue& value, const TextureTable& textures,
                           Hardware hardware) {
    if (value.json().is_object()) return read_texture(value, hardware);
    const std::string name = value.string();
    const auto found = textures.find(name);
    if (found != textures.end()) return found->second;
    std::vector<std::string> known;
    for (const auto& [known_name, texture] : textures) known.push_back(known_name);
    value.reject("the name of a texture: " + one_of(name, known));
}

Material read_material(const SceneValue& value, const std::string& name,
                       const TextureTable& textures, Hardware hardware) {
    Fields fields(value);
    Material material;
    material.name = name;
    material.key = value.path();
    read_maps(fields, textures, hardware, material);
    if (fields.has("relief")) read_relief(fields.get("relief"), material);
    read_stage(fields, "shade", material.shade);
    read_colours(fields, material);
    if (fields.has("texture_matrix"))
        material.texture_matrix = read_texture_matrix(fields.get("texture_matrix"));
    fields.read("cull", material.cull, cull_words);
    fields.read("discard_below", material.discard_below);
    fields.finish("a material");
    return material;
}

}  // namespace quadrel
