#include "embree/rays.hpp"

#include <algorithm>
#include <cmath>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

namespace quadrel::peers {
namespace {

/// Object space to the relief's.
class ToRelief {
  public:
    explicit ToRelief(const Scene& scene) {
        const Mesh& mesh = scene.meshes.at(scene.objects.at(0).mesh);
        const glm::dmat4 to_texture(scene.materials.at(0).texture_matrix);
        const auto corner = [&](std::size_t i) {
            return glm::dvec2(to_texture * glm::dvec4(mesh.uvs.at(i), 0, 1));
        };
        // Edges of a triangle span both planes.
        const auto& t = mesh.triangles.at(0);
        const glm::dvec2 a(mesh.positions.at(t[0])), b(mesh.positions.at(t[1])),
            c(mesh.positions.at(t[2]));
        const glm::dmat2 edges(b - a, c - a);
        const glm::dmat2 uv_edges(corner(t[1]) - corner(t[0]), corner(t[2]) - corner(t[0]));
        linear_ = uv_edges * inverse(edges);
        offset_ = corner(t[0]) - linear_ * a;
    }

    glm::dvec3 vector(const glm::dvec3& v) const { return {linear_ * glm::dvec2(v), v.z}; }
    glm::dvec3 point(const glm::dvec3& p) const { return {linear_ * glm::dvec2(p) + offset_, p.z}; }

  private:
    glm::dmat2 linear_;
    glm::dvec2 offset_;
};

/// Pixels of a frame in blocks of 4x4.
template <class Visit>
void for_each_in_blocks(int width, int height, const Visit& visit) {
    for (int y = 0; y < height; y += 4)
        for (int x = 0; x < width; x += 4)
            for (int i = 0; i < 16; ++i) visit(x + i % 4, y + i / 4);
}

}  // namespace

Rays rays_of(const Scene& scene) {
    const glm::dmat4 projection(scene.camera.projection);
    const glm::dmat4 to_object =
        inverse(glm::dmat4(scene.camera.view) * glm::dmat4(scene.objects.at(0).transform));
    const ToRelief to_relief(scene);
    const glm::dvec3 eye = to_relief.point(glm::dvec3(to_object[3]));
    Rays rays;
    rays.light = to_relief.point(
        glm::dvec3(to_object * glm::dvec4(glm::dvec3(scene.lights.at(0).position), 1)));
    for_each_in_blocks(scene.width, scene.height, [&](int x, int y) {
        const glm::dvec2 ndc((x + 0.5) / scene.width * 2 - 1, 1 - (y + 0.5) / scene.height * 2);
        const glm::dvec4 through(ndc.x / projection[0][0], ndc.y / projection[1][1], -1, 0);
        glm::dvec3 d = to_relief.vector(glm::dvec3(to_object * through));
        d = d / -d.z;
        const glm::dvec3 start = eye + d * eye.z;
        for (int i = 0; i < 3; ++i) {
            const double tile = i < 2 ? std::floor(start[i]) : 0;
            rays.origin[static_cast<std::size_t>(i)].push_back(
                i < 2 ? static_cast<float>(start[i] - tile) : 0.0f);
            rays.direction[static_cast<std::size_t>(i)].push_back(static_cast<float>(d[i]));
            if (i < 2) rays.tile[static_cast<std::size_t>(i)].push_back(static_cast<float>(tile));
        }
        rays.pixel.push_back(static_cast<std::size_t>(y) * static_cast<std::size_t>(scene.width) +
                             static_cast<std::size_t>(x));
    });
    return rays;
}

Part crossed(const Rays& rays, double depth) {
    Part part;
    for (std::size_t i = 0; i < rays.pixel.size(); ++i)
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const int a = static_cast<int>(axis);
            const double shift = depth * rays.direction[axis][i];
            const double at = rays.origin[axis][i] + rays.tile[axis][i];
            const double up = depth * (rays.light[a] - at) / rays.light.z;
            part.low[a] = std::min(part.low[a], std::min(0.0, shift) + std::min(0.0, up));
            part.high[a] = std::max(part.high[a], 1 + std::max(0.0, shift) + std::max(0.0, up));
        }
    return part;
}

}  // namespace quadrel::peers
