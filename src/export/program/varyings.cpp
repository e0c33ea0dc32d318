#include "export/program/varyings.hpp"

#include <algorithm>
#include <iterator>

namespace quadrel::recorded {

const Varying* find_varying(const std::string& name) {
    static constexpr Varying all[] = {
        {"P", Type::vec3, false, "position", "eye_position"},
        {"vertex_normal", Type::vec3, false, "normal", "eye_normal"},
        {"uv", Type::vec2, false, "texture_coordinates", "mapped_coordinates"},
        {"Ng", Type::vec3, true, "face_normal", "face_normal"},
        {"vertex_tangent", Type::vec3, false, "tangent", "tangent"},
        {"tangent_sign", Type::real, false, "handedness", "handedness"},
        {"vertex_bitangent", Type::vec3, false, "bitangent", "bitangent"},
        {"quadric", Type::vec2, false, "curvature", "curvature"},
        {"face_J_u", Type::vec3, true, "gradient_u", "gradient_u"},
        {"face_J_v", Type::vec3, true, "gradient_v", "gradient_v"},
        {"corner_weights", Type::vec3, false, "face_weights", "face_weights"},
        {"shell_depth", Type::real, false, "face_depth", "face_depth"},
        {"shell_row", Type::real, true, "face_row", "face_row"},
        {"strip_nv", Type::vec3, false, "emitted_nv", "emitted_nv"},
        {"strip_tv", Type::vec3, false, "emitted_tv", "emitted_tv"},
        {"strip_bv", Type::vec3, false, "emitted_bv", "emitted_bv"},
        {"strip_height", Type::real, false, "emitted_height", "emitted_height"},
        {"strip_side", Type::real, false, "emitted_side", "emitted_side"},
    };
    const auto* const found = std::find_if(std::begin(all), std::end(all),
                                           [&](const Varying& of) { return of.name == name; });
    return found != std::end(all) ? found : nullptr;
}

const std::vector<Named>& vertex_attributes() {
    static const std::vector<Named> all = {{"position", Type::vec3},
                                           {"normal", Type::vec3},
                                           {"texture_coordinates", Type::vec2},
                                           {"face_normal", Type::vec3},
                                           {"tangent", Type::vec3},
                                           {"handedness", Type::real},
                                           {"bitangent", Type::vec3},
                                           {"gradient_u", Type::vec3},
                                           {"gradient_v", Type::vec3},
                                           {"eye_position", Type::vec3},
                                           {"clip_position", Type::vec4},
                                           {"eye_normal", Type::vec3},
                                           {"mapped_coordinates", Type::vec2},
                                           {"curvature", Type::vec2},
                                           {"face_weights", Type::vec3},
                                           {"face_depth", Type::real},
                                           {"face_row", Type::real},
                                           {"emitted_nv", Type::vec3},
                                           {"emitted_tv", Type::vec3},
                                           {"emitted_bv", Type::vec3},
                                           {"emitted_height", Type::real},
                                           {"emitted_side", Type::real}};
    return all;
}

int location_of(const std::string& attribute) {
    const auto& all = vertex_attributes();
    const auto place = std::find_if(all.begin(), all.end(),
                                    [&](const Named& of) { return of.name == attribute; }) -
                       all.begin();
    // There are 16 places: some are those of tangents, gradients and curvatures, which frames of
    // shells do not read.
    static constexpr int of_shells[] = {13, 14, 15, 4, 5, 6, 7, 8};
    const auto others = static_cast<std::ptrdiff_t>(all.size() - std::size(of_shells));
    return place < others ? static_cast<int>(place) : of_shells[place - others];
}

}  // namespace quadrel::recorded
