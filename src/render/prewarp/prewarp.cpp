#include "render/prewarp/prewarp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "quadrel/error.hpp"
#include "render/draw/geometry.hpp"
#include "render/draw/vertex_stage.hpp"
#include "render/prewarp/warp.hpp"
#include "scene/billboard.hpp"
#include "text/hash.hpp"

namespace quadrel {
namespace {

constexpr std::int64_t most_texels = std::int64_t(1) << 24;
/// How far a vertex may be from the plane, in the size of what is drawn, and its UV from the
/// plane's, in that of all UV: some ulp of float.
constexpr double tolerance = 1e-4;

class Refusal {
  public:
    Refusal(const Scene& scene, const Material& material) : scene_(scene), material_(material) {}

    [[noreturn]] void operator()(const std::string& found, const std::string& expected) const {
        const std::string key =
            material_.key.empty() ? "materials." + material_.name : material_.key;
        throw InputError(scene_.file.string(), key + ".relief.trace",
                         "relief-prewarp with " + found, expected);
    }

  private:
    const Scene& scene_;
    const Material& material_;
};

/// A plane in eye space, with UV: at `origin` that is `uv`, and elsewhere its gradients say.
struct TexturedPlane {
    glm::dvec3 origin, normal, grad_u, grad_v;
    glm::dvec2 uv;

    glm::dvec2 uv_at(const glm::dvec3& p) const {
        return uv + glm::dvec2(dot(grad_u, p - origin), dot(grad_v, p - origin));
    }
};

/// Nothing where a triangle has no area, or its UV none.
std::optional<TexturedPlane> plane_of(const std::array<glm::dvec3, 3>& p,
                                      const std::array<glm::dvec2, 3>& uv) {
    const glm::dvec3 e1 = p[1] - p[0], e2 = p[2] - p[0], n = cross(e1, e2);
    const double area = dot(n, n);
    const glm::dvec2 d1 = uv[1] - uv[0], d2 = uv[2] - uv[0];
    if (!(area > 0) || d1.x * d2.y == d1.y * d2.x) return std::nullopt;
    const glm::dvec3 a = cross(e2, n) / area, b = cross(n, e1) / area;
    return TexturedPlane{p[0], n / std::sqrt(area), a * d1.x + b * d2.x, a * d1.y + b * d2.y,
                         uv[0]};
}

/// All triangles of a material, which must be of one plane.
struct MaterialPlane {
    std::optional<TexturedPlane> plane;
    std::vector<glm::dvec3> points;  ///< vertices of triangles
    std::vector<glm::dvec2> uvs;

    void add(const Mesh& mesh, const ShadedVertices& vertices) {
        for (const auto& triangle : mesh.triangles) {
            std::array<glm::dvec3, 3> p;
            std::array<glm::dvec2, 3> uv;
            for (std::size_t v = 0; v < 3; ++v) {
                p[v] = glm::dvec3(vertices.eye[triangle[v]]);
                uv[v] = glm::dvec2(vertices.uv[triangle[v]]);
            }
            if (!plane) plane = plane_of(p, uv);
            points.insert(points.end(), p.begin(), p.end());
            uvs.insert(uvs.end(), uv.begin(), uv.end());
        }
    }
    bool is_one() const {
        double size = 0, uv_size = 1;
        for (const glm::dvec3& p : points) size = std::max(size, length(p - plane->origin));
        for (const glm::dvec2& uv : uvs) uv_size = std::max(uv_size, length(uv - plane->uv));
        for (std::size_t i = 0; i < points.size(); ++i)
            if (!(std::abs(dot(points[i] - plane->origin, plane->normal)) <= tolerance * size) ||
                !(length(uvs[i] - plane->uv_at(points[i])) <= tolerance * uv_size))
                return false;
        return true;
    }
};

MaterialPlane plane_of_material(const Scene& scene, std::size_t material, const Refusal& refuse) {
    MaterialPlane found;
    for (const Object& object : scene.objects) {
        if (!object.visible || object.material != material) continue;
        Mesh card;
        const Mesh& mesh = drawn_mesh(scene, object, card);
        found.add(mesh, shade_vertices(mesh, scene.camera, scene.camera.view * object.transform,
                                       scene.materials[material].texture_matrix));
    }
    if (!found.plane) refuse("polygons without area, or UV without", "a plane with UV");
    if (!found.is_one())
        refuse("polygons of several planes or UV maps",
               "one plane with one affine UV: other polygons take a material of their own");
    return found;
}

/// The eye over the side of the plane that it sees.
EyeOverPlane eye_over(const TexturedPlane& plane, const FrameUniforms& frame) {
    const glm::dvec3 eye(frame.eye[0], frame.eye[1], frame.eye[2]);
    EyeOverPlane over;
    over.at_infinity = frame.orthographic != 0;
    const glm::dvec3 from = over.at_infinity ? eye : eye - plane.origin;
    over.height = std::abs(dot(from, plane.normal));
    over.u = dot(plane.grad_u, from) + (over.at_infinity ? 0 : plane.uv.x);
    over.v = dot(plane.grad_v, from) + (over.at_infinity ? 0 : plane.uv.y);
    return over;
}

/// The texels that a range of coordinates touches.
TexelRange texels_of(double low, double high, int texels, const Refusal& refuse) {
    const double first = std::floor(low * texels), end = std::ceil(high * texels);
    if (!(std::max(std::abs(first), std::abs(end)) < double(most_texels)))
        refuse(fmt::format("UV from {} to {}", low, high), "UV nearer to 0");
    return {static_cast<int>(first), std::max(static_cast<int>(end), static_cast<int>(first) + 1)};
}

double world_depth(const Material& material, const TexturedPlane& plane) {
    const double depth = static_cast<double>(material.depth);
    if (!material.depth_in_tiles) return depth;
    return depth / std::sqrt(length(cross(plane.grad_u, plane.grad_v)));
}

}  // namespace

std::shared_ptr<const Texture> prewarp_for_view(const Scene& scene, std::size_t material,
                                                const Texture& height, const SamplerState& sampler,
                                                TextureCache& cache) {
    const Material& of = scene.materials[material];
    const Refusal refuse(scene, of);
    if (of.fade_from < of.fade_to) refuse("grazing_fade", "one depth of all of its relief");
    const MaterialPlane found = plane_of_material(scene, material, refuse);
    glm::dvec2 low = found.uvs[0], high = low;
    for (const glm::dvec2& uv : found.uvs) {
        low = min(low, uv);
        high = max(high, uv);
    }
    const HeightPlane heights(height, sampler);
    PrewarpRequest request;
    request.eye = eye_over(*found.plane, frame_uniforms(scene, scene_hardware(scene)));
    request.columns = texels_of(low.x, high.x, heights.width, refuse);
    request.rows = texels_of(low.y, high.y, heights.height, refuse);
    request.depth = world_depth(of, *found.plane);
    request.seat = static_cast<double>(of.seat);
    const std::int64_t texels = std::int64_t(request.columns.count()) * request.rows.count();
    if (texels > most_texels)
        refuse(fmt::format("polygons over {} texels", texels),
               fmt::format("at most {}", most_texels));
    const std::string id =
        sha256_hex(fmt::format("prewarp {} {} {} {} {} {} {} {} {} {} {} {} {} {}", height.id(),
                               static_cast<int>(sampler.wrap_u), static_cast<int>(sampler.wrap_v),
                               sampler.border[0], request.eye.u, request.eye.v, request.eye.height,
                               request.eye.at_infinity, request.columns.first, request.columns.end,
                               request.rows.first, request.rows.end, request.depth, request.seat));
    const std::string name = fmt::format("prewarp of {} {}", scene.file.string(), of.name);
    if (auto kept = cache.kept(name); kept && kept->id() == id) return kept;
    auto warped = prewarp(heights, request, id);
    cache.keep(name, warped);
    return warped;
}

}  // namespace quadrel
