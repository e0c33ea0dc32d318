#include "quadrel/scene/camera.hpp"

#include <cmath>

#include "quadrel/check.hpp"
#include "quadrel/num/functions.hpp"
#include "scene/degrees.hpp"

namespace quadrel {
namespace {

/// Clip z = scale * eye z + offset.
struct DepthRow {
    double scale, offset;
};

// Perspective: w = distance d = -z; wants depth(d) * d = scale * z + offset, depth(near) = start.
DepthRow perspective_depth(const DepthAndShift& lens, double start, double end) {
    const double n = lens.near, f = lens.far;
    if (std::isinf(f)) return {-end, (start - end) * n};
    return {(start * n - end * f) / (f - n), (start - end) * n * f / (f - n)};
}

DepthRow orthographic_depth(const DepthAndShift& lens, double start, double end) {
    const double n = lens.near, f = lens.far;
    return {(start - end) / (f - n), (start * f - end * n) / (f - n)};
}

// Depth at the near and at the far plane.
glm::dvec2 depth_ends(const DepthAndShift& lens, Conventions conventions) {
    const glm::dvec2 ends(conventions == Conventions::gl ? -1 : 0, 1);
    return lens.reversed_z ? glm::dvec2(ends.y, ends.x) : ends;
}

double clip_y_sign(Conventions conventions) { return conventions == Conventions::vulkan ? -1 : 1; }

}  // namespace

glm::mat4 view_matrix(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up) {
    const glm::dvec3 back = normalize(eye - target);
    const glm::dvec3 right = normalize(cross(up, back));
    const glm::dvec3 above = cross(back, right);
    glm::dmat4 view(1.0);
    const glm::dvec3 rows[3] = {right, above, back};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) view[column][row] = rows[row][column];
        view[3][row] = -dot(rows[row], eye);
    }
    return glm::mat4(view);
}

glm::mat4 perspective_matrix(double fov_y, double aspect, const DepthAndShift& lens,
                             Conventions conventions) {
    QUADREL_CHECK(fov_y > 0 && fov_y < 180, fov_y);
    const SinCos half = sin_cos_degrees(fov_y / 2);
    const double focal = half.cosine / half.sine;
    const glm::dvec2 ends = depth_ends(lens, conventions);
    const DepthRow depth = perspective_depth(lens, ends.x, ends.y);
    const double y = clip_y_sign(conventions);
    glm::dmat4 projection(0.0);
    projection[0][0] = focal / aspect;
    projection[1][1] = y * focal;
    projection[2] = glm::dvec4(-lens.shift.x, -y * lens.shift.y, depth.scale, -1);
    projection[3][2] = depth.offset;
    return glm::mat4(projection);
}

glm::mat4 orthographic_matrix(double height, double aspect, const DepthAndShift& lens,
                              Conventions conventions) {
    QUADREL_CHECK(std::isfinite(lens.far), lens.far);
    const glm::dvec2 ends = depth_ends(lens, conventions);
    const DepthRow depth = orthographic_depth(lens, ends.x, ends.y);
    const double y = clip_y_sign(conventions);
    glm::dmat4 projection(0.0);
    projection[0][0] = 2 / (height * aspect);
    projection[1][1] = y * (2 / height);
    projection[2][2] = depth.scale;
    projection[3] = glm::dvec4(lens.shift.x, y * lens.shift.y, depth.offset, 1);
    return glm::mat4(projection);
}

}  // namespace quadrel
