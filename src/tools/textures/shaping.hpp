// Small functions that shape profiles and mix values.
#pragma once

#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace quadrel::textures {

template <class T>
T mix(T a, T b, double t) {
    return a * (1 - t) + b * t;
}
inline double saturate(double x) { return x < 0 ? 0 : x > 1 ? 1 : x; }
inline double smoothstep(double edge0, double edge1, double x) {
    const double t = saturate((x - edge0) / (edge1 - edge0));
    return t * t * (3 - 2 * t);
}
/// A quarter circle from (0, 0), upright there, to (1, 1), level there; constant outside.
inline double quarter_circle(double x) {
    const double t = 1 - saturate(x);
    return std::sqrt(1 - t * t);
}
inline double length(glm::dvec2 v) { return std::sqrt(v.x * v.x + v.y * v.y); }
inline double dot(glm::dvec2 a, glm::dvec2 b) { return a.x * b.x + a.y * b.y; }
inline double dot(glm::dvec3 a, glm::dvec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline glm::dvec3 normalize(glm::dvec3 v) { return v * (1 / std::sqrt(dot(v, v))); }

/// Signed distance to a rectangle with rounded corners, centred on the origin; negative inside.
inline double rounded_rectangle(glm::dvec2 p, glm::dvec2 half_size, double radius) {
    const double qx = std::fabs(p.x) - half_size.x + radius;
    const double qy = std::fabs(p.y) - half_size.y + radius;
    const double outside = length({qx > 0 ? qx : 0, qy > 0 ? qy : 0});
    const double inside = qx > qy ? qx : qy;
    return outside + (inside < 0 ? inside : 0) - radius;
}

/// The smaller of two values, rounded off where they are within `radius` of each other.
inline double smooth_min(double a, double b, double radius) {
    const double h = saturate(0.5 + 0.5 * (b - a) / radius);
    return mix(b, a, h) - radius * h * (1 - h);
}

}  // namespace quadrel::textures
