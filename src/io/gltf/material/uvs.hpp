// Which texture coordinates a primitive's material means (KHR_texture_transform).
#pragma once

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "io/gltf/accessor.hpp"

namespace quadrel {

/// uv' = linear uv + offset.
struct UvTransform {
    glm::dmat2 linear{1.0};
    glm::dvec2 offset{0.0};

    bool operator==(const UvTransform& other) const {
        return linear == other.linear && offset == other.offset;
    }
    /// Whether tangents along u and v stay such.
    bool keeps_directions() const {
        return linear[0].y == 0 && linear[1].x == 0 && linear[0].x > 0 && linear[1].y > 0;
    }
};

/// What a material says about a set of texture coordinates.
struct MaterialUvs {
    UvTransform transform;
    bool has_tangents = true;    ///< the set is that of the normal texture, which tangents are for
    bool others_differ = false;  ///< a second texture that reads the set has another transform
};

/// Of `material` (an index, or -1) for TEXCOORD_`set`: the transform of the first texture that
/// reads the set, of base colour, normal, occlusion, emission, metal and roughness, and those of
/// extensions. A mesh has one set of coordinates for all. Throws InputError.
MaterialUvs material_uvs(const GltfFile& file, int material, int set);

/// Of one texture's description at `key`, if it reads the set. Throws InputError.
std::optional<UvTransform> texture_uvs(const GltfFile& file, const nlohmann::json& texture,
                                       const std::string& key, int set);

}  // namespace quadrel
