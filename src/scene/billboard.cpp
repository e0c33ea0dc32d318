#include "scene/billboard.hpp"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "quadrel/error.hpp"
#include "quadrel/scene/shapes.hpp"

namespace quadrel {
namespace {

glm::dvec3 unit_vector(const glm::dvec3& v) { return v / std::sqrt(dot(v, v)); }

std::string key_of(const Scene& scene, const Object& object) {
    return fmt::format("objects[{}]", &object - scene.objects.data());
}

/// Whether a matrix turns, mirrors and scales all lengths alike, within what floats keep.
bool keeps_angles(const glm::dmat3& m) {
    const double size = dot(m[0], m[0]);
    constexpr double tolerance = 1e-5;
    for (int i = 0; i < 3; ++i)
        if (!(std::abs(dot(m[i], m[i]) - size) <= tolerance * size) ||
            !(std::abs(dot(m[i], m[(i + 1) % 3])) <= tolerance * size))
            return false;
    return size > 0;
}

/// Where the eye is seen from the object's origin, in object space.
struct View {
    glm::dvec3 towards, up;  ///< unit; `up` is the camera's
    double distance;         ///< infinite of a parallel projection
};

View view_of(const Scene& scene, const Object& object) {
    const glm::dmat4 model_view(scene.camera.view * object.transform);
    const glm::dmat4 to_object = inverse(model_view);
    const glm::dvec4 centre = centre_of_projection(scene.camera.projection);
    View view;
    const glm::dvec3 eye(to_object * centre);
    if (centre.w == 0) {
        // Eye space looks down -z.
        view.towards = unit_vector(centre.z < 0 ? -eye : eye);
        view.distance = std::numeric_limits<double>::infinity();
    } else {
        view.towards = unit_vector(eye / centre.w);
        view.distance = length(eye / centre.w);
    }
    view.up = unit_vector(glm::dvec3(to_object * glm::dvec4(0, 1, 0, 0)));
    // Straight above the eye another direction does as well.
    if (length(cross(view.up, view.towards)) < 1e-6)
        view.up = unit_vector(glm::dvec3(to_object * glm::dvec4(0, 0, 1, 0)));
    return view;
}

/// The square of +-reach along right and up, as seen from `towards`.
Mesh card_of(const Billboard& board, double reach, const glm::dvec3& right, const glm::dvec3& up,
             const glm::dvec3& towards) {
    Mesh card;
    for (const glm::dvec2& corner :
         {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)}) {
        const glm::dvec2 at = corner * reach;
        card.positions.emplace_back(right * at.x + up * at.y);
        card.normals.emplace_back(towards);
        card.uvs.emplace_back(at / board.size + 0.5);
    }
    card.triangles = {{0, 1, 2}, {0, 2, 3}};
    card.billboard = board;
    return card;
}

}  // namespace

glm::dvec4 centre_of_projection(const glm::mat4& projection) {
    const auto row = [&](int r) {
        return glm::dvec4(projection[0][r], projection[1][r], projection[2][r], projection[3][r]);
    };
    const glm::dvec4 x = row(0), y = row(1), w = row(3);
    // The generalised cross product of three rows, by cofactors.
    const auto minor = [&](int i, int j, int k) {
        return x[i] * (y[j] * w[k] - y[k] * w[j]) - x[j] * (y[i] * w[k] - y[k] * w[i]) +
               x[k] * (y[i] * w[j] - y[j] * w[i]);
    };
    return {minor(1, 2, 3), -minor(0, 2, 3), minor(0, 1, 3), -minor(0, 1, 2)};
}

const Mesh& drawn_mesh(const Scene& scene, const Object& object, Mesh& card) {
    const Mesh& mesh = scene.meshes[object.mesh];
    if (!mesh.billboard) return mesh;
    const Billboard& board = *mesh.billboard;
    if (!keeps_angles(glm::dmat3(glm::dmat4(scene.camera.view * object.transform))))
        throw InputError(scene.file.string(), key_of(scene, object) + ".transform",
                         "a transform that stretches or shears a billboard",
                         "one that turns, moves and scales all axes alike");
    const View view = view_of(scene, object);
    if (!(view.distance > board.radius))
        throw InputError(scene.file.string(), key_of(scene, object),
                         fmt::format("a billboard {:g} of its units from the eye", view.distance),
                         fmt::format("more than its radius, {:g}", board.radius));
    // Seen from there, the sphere covers this much of the plane through its middle.
    const double part = board.radius / view.distance;
    const double reach = board.radius / std::sqrt(1 - part * part);
    const glm::dvec3 right = unit_vector(cross(view.up, view.towards)),
                     up = cross(view.towards, right);
    card = card_of(board, reach, right, up, view.towards);
    card.name = mesh.name;
    return card;
}

Mesh make_billboard(double size, double radius) {
    const Billboard board{size, radius};
    Mesh mesh = card_of(board, radius, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    mesh.name = "billboard";
    return mesh;
}

}  // namespace quadrel
