#include <limits>

#include "io/scene/read.hpp"
#include "quadrel/num/functions.hpp"
#include "quadrel/scene/camera.hpp"

namespace quadrel {
namespace {

enum class Lens { perspective, orthographic, matrices };
constexpr Word<Lens> lens_words[] = {{"perspective", Lens::perspective},
                                     {"orthographic", Lens::orthographic},
                                     {"matrices", Lens::matrices}};

glm::mat4 read_view(Fields& camera) {
    glm::vec3 eye(0, 0, 3), target(0, 0, 0), up(0, 1, 0);
    camera.read("eye", eye);
    camera.read("target", target);
    camera.read("up", up);
    const glm::dvec3 sight = glm::dvec3(target) - glm::dvec3(eye), above(up);
    if (dot(sight, sight) == 0)
        camera.value().fail("eye and target in the same place", "two places");
    const double aside = length(cross(sight, above));
    if (!(aside > 1e-9 * length(sight) * length(above)))
        camera.value().fail("\"up\" along the line of sight", "another direction");
    return view_matrix(eye, target, up);
}

double read_far(const SceneValue& value, Lens lens) {
    if (!value.json().is_string()) return value.number(above_zero);
    if (value.string() != "infinite" || lens != Lens::perspective)
        value.reject(lens == Lens::perspective ? "a number > 0 or \"infinite\"" : "a number > 0");
    return std::numeric_limits<double>::infinity();
}

DepthAndShift read_depth_and_shift(Fields& camera, Lens lens) {
    DepthAndShift out;
    camera.read("near", out.near, above_zero);
    if (camera.has("far")) out.far = read_far(camera.get("far"), lens);
    if (!(out.near < out.far)) {
        const std::string key = camera.has("near") ? "near" : "far";
        camera.get(key).reject("near < far (they are " + std::to_string(out.near) + " and " +
                               std::to_string(out.far) + ")");
    }
    if (camera.has("shift")) {
        const auto shift = camera.get("shift").numbers(2, 2);
        out.shift = {shift[0], shift[1]};
    }
    return out;
}

glm::dmat4 read_regular_matrix(const SceneValue& value) {
    const glm::dmat4 matrix = read_matrix(value);
    if (glm::determinant(matrix) == 0) value.fail("a singular matrix", "one with an inverse");
    return matrix;
}

}  // namespace

Camera read_camera(const SceneValue& value, const Scene& scene) {
    Fields fields(value);
    Camera camera;
    Lens lens = Lens::perspective;
    fields.read("type", lens, lens_words);
    fields.read("reversed_z", camera.reversed_z);
    if (lens == Lens::matrices) {
        camera.view = glm::mat4(read_regular_matrix(fields.get("view")));
        camera.projection = glm::mat4(read_regular_matrix(fields.get("projection")));
        fields.finish("a camera of matrices");
        return camera;
    }
    camera.view = read_view(fields);
    DepthAndShift depth = read_depth_and_shift(fields, lens);
    depth.reversed_z = camera.reversed_z;
    const double aspect = double(scene.width) / scene.height;
    if (lens == Lens::perspective) {
        double fov_y = 45;
        fields.read("fov_y", fov_y, {.low = 0, .high = 180, .open = true});
        camera.projection = perspective_matrix(fov_y, aspect, depth, scene.conventions);
        fields.finish("a perspective camera");
    } else {
        double height = 2;
        fields.read("height", height, above_zero);
        camera.projection = orthographic_matrix(height, aspect, depth, scene.conventions);
        fields.finish("an orthographic camera");
    }
    return camera;
}

}  // namespace quadrel
