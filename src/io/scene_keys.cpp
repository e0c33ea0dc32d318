#include "io/scene_keys.hpp"

namespace quadrel {
namespace {

constexpr SceneKey keys[] = {
    {"scene", "quadrel"},
    {"scene", "size"},
    {"scene", "samples"},
    {"scene", "shade_at"},
    {"scene", "conventions"},
    {"scene", "hardware"},
    {"scene", "derivatives"},
    {"scene", "background"},
    {"scene", "camera", Below::object, "camera"},
    {"scene", "textures", Below::names, "texture"},
    {"scene", "material", Below::object, "material"},
    {"scene", "materials", Below::names, "material"},
    {"scene", "meshes", Below::names, "mesh"},
    {"scene", "objects", Below::list, "object"},
    {"scene", "lights", Below::list, "light"},
    {"scene", "environment", Below::object, "environment"},

    {"camera", "type"},
    {"camera", "fov_y"},
    {"camera", "height"},
    {"camera", "eye"},
    {"camera", "target"},
    {"camera", "up"},
    {"camera", "near"},
    {"camera", "far"},
    {"camera", "reversed_z"},
    {"camera", "shift"},
    {"camera", "view"},
    {"camera", "projection"},

    {"texture", "file"},
    {"texture", "swizzle"},
    {"texture", "colour_space"},
    {"texture", "format"},
    {"texture", "mip"},
    {"texture", "flip_v"},
    {"texture", "allow_nan"},
    {"texture", "wrap"},
    {"texture", "mag"},
    {"texture", "min"},
    {"texture", "border"},
    {"texture", "lod_bias"},
    {"texture", "lod_min"},
    {"texture", "lod_max"},
    {"texture", "noise", Below::object, "noise"},

    {"noise", "frequency"},
    {"noise", "octaves"},

    {"material", "color", Below::object, "texture"},
    {"material", "height", Below::object, "texture"},
    {"material", "gloss", Below::object, "texture"},
    {"material", "emissive", Below::object, "texture"},
    {"material", "normal", Below::object, "texture"},
    {"material", "relief", Below::object, "relief"},
    {"material", "shade", Below::object, "stage"},
    {"material", "ambient"},
    {"material", "diffuse"},
    {"material", "specular"},
    {"material", "emission"},
    {"material", "shininess"},
    {"material", "texture_matrix", Below::object, "texture_matrix"},
    {"material", "cull"},
    {"material", "discard_below"},

    {"relief", "preset"},
    {"relief", "frame", Below::object, "stage"},
    {"relief", "trace", Below::object, "stage"},
    {"relief", "clip", Below::object, "stage"},
    {"relief", "frag_depth", Below::object, "stage"},
    {"relief", "surface", Below::object, "stage"},
    {"relief", "shadow", Below::object, "stage"},
    {"relief", "occlusion", Below::object, "stage"},
    {"relief", "depth", Below::object, "depth"},
    {"relief", "grazing_fade"},
    {"relief", "seat"},

    {"depth", "thickness"},
    {"depth", "tile"},

    {"stage", "id"},

    {"texture_matrix", "scale"},
    {"texture_matrix", "rotate"},
    {"texture_matrix", "offset"},

    {"mesh", "shape"},
    {"mesh", "file"},
    {"mesh", "size"},
    {"mesh", "subdivide"},
    {"mesh", "radius"},
    {"mesh", "slices"},
    {"mesh", "stacks"},
    {"mesh", "inner_radius"},
    {"mesh", "outer_radius"},
    {"mesh", "sides"},
    {"mesh", "rings"},
    {"mesh", "tessellation"},
    {"mesh", "normals"},
    {"mesh", "flip_v"},
    {"mesh", "uv_set"},
    {"mesh", "refine", Below::object, "refine"},

    {"refine", "by"},
    {"refine", "levels"},

    {"object", "name"},
    {"object", "mesh", Below::object, "mesh"},
    {"object", "material"},
    {"object", "transform", Below::list, "transform"},
    {"object", "visible"},

    {"transform", "translate"},
    {"transform", "rotate"},
    {"transform", "axis"},
    {"transform", "scale"},

    {"light", "type"},
    {"light", "space"},
    {"light", "position"},
    {"light", "direction_to_light"},
    {"light", "ambient"},
    {"light", "diffuse"},
    {"light", "specular"},
    {"light", "intensity"},
    {"light", "attenuation"},

    {"environment", "faces"},
    {"environment", "colour_space"},
    {"environment", "format"},
    {"environment", "mip"},
    {"environment", "wrap"},
    {"environment", "mag"},
    {"environment", "min"},
    {"environment", "border"},
    {"environment", "lod_bias"},
    {"environment", "lod_min"},
    {"environment", "lod_max"},
};

}  // namespace

std::span<const SceneKey> scene_keys() { return keys; }

const SceneKey* find_scene_key(std::string_view section, std::string_view key) {
    for (const SceneKey& row : keys)
        if (row.section == section && row.key == key) return &row;
    return nullptr;
}

std::vector<std::string_view> keys_of_section(std::string_view section) {
    std::vector<std::string_view> found;
    for (const SceneKey& row : keys)
        if (row.section == section) found.push_back(row.key);
    return found;
}

bool takes_parameters(std::string_view section) {
    return section == "relief" || section == "stage";
}

}  // namespace quadrel
