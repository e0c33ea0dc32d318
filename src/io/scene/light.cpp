#include "io/scene/read.hpp"
#include "quadrel/num/functions.hpp"

namespace quadrel {
namespace {

constexpr Word<Light::Kind> kind_words[] = {{"point", Light::Kind::point},
                                            {"directional", Light::Kind::directional}};
constexpr Word<Light::Space> space_words[] = {{"eye", Light::Space::eye},
                                              {"world", Light::Space::world}};

void read_place(Fields& fields, Light& light) {
    if (light.kind == Light::Kind::point) {
        fields.read("position", light.position);
        return;
    }
    const SceneValue direction = fields.get("direction_to_light");
    light.position = direction.vector3();
    if (length(glm::dvec3(light.position)) == 0) direction.reject("a direction of some length");
}

void read_attenuation(const SceneValue& value, Light& light) {
    const auto terms = value.numbers(3, 3, not_negative);
    if (terms[0] + terms[1] + terms[2] == 0) value.reject("a term above 0");
    light.constant_attenuation = static_cast<float>(terms[0]);
    light.linear_attenuation = static_cast<float>(terms[1]);
    light.quadratic_attenuation = static_cast<float>(terms[2]);
}

}  // namespace

Light read_light(const SceneValue& value) {
    Fields fields(value);
    Light light;
    fields.read("type", light.kind, kind_words);
    fields.read("space", light.space, space_words);
    read_place(fields, light);
    fields.read("ambient", light.ambient, not_negative);
    fields.read("diffuse", light.diffuse, not_negative);
    fields.read("specular", light.specular, not_negative);
    fields.read("intensity", light.intensity, not_negative);
    if (light.kind == Light::Kind::point && fields.has("attenuation"))
        read_attenuation(fields.get("attenuation"), light);
    fields.finish(light.kind == Light::Kind::point ? "a point light" : "a directional light");
    return light;
}

}  // namespace quadrel
