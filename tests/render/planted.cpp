#include "render/planted.hpp"

#include <glm/matrix.hpp>

#include "quadrel/error.hpp"

namespace quadrel::render_tests {
namespace {

constexpr std::uint32_t infinity = 0x7f800000u, nothing = 0xffffffffu;

std::uint32_t bits_of(float x) { return std::bit_cast<std::uint32_t>(x); }

/// Calls body(bits, pixel) for the named planes, or for all.
template <class Body>
void change(Film& film, const std::vector<std::string>& names, const Body& body) {
    for (Plane& plane : film.planes)
        if (names.empty() || std::find(names.begin(), names.end(), plane.name) != names.end())
            for (std::size_t i = 0; i < plane.bits.size(); ++i) body(plane.bits[i], i);
}

/// The scene rendered with other channels.
Film also(const Scene& scene, RenderOptions options, const std::vector<std::string>& channels) {
    options.channels = channels;
    return render(scene, options);
}

void flip_winding(Scene& scene) {
    for (const Object& object : scene.objects)
        if (glm::determinant(glm::mat3(object.transform)) < 0)
            for (auto& t : scene.meshes[object.mesh].triangles) std::swap(t[1], t[2]);
}

void smooth(Scene& scene) {
    for (Mesh& mesh : scene.meshes)
        if (mesh.normals.empty())
            for (const glm::vec3& p : mesh.positions)
                mesh.normals.push_back(p / (std::abs(p.x) + std::abs(p.y) + std::abs(p.z) + 1e-3f));
}

/// Moves the far plane of a gl projection to infinity.
void forget_far_plane(Scene& scene) {
    glm::mat4& m = scene.camera.projection;
    const float near = m[3][2] / (m[2][2] - 1);
    m[2][2] = -1;
    m[3][2] = -2 * near;
}

void damage_materials(Planted error, Scene& scene) {
    for (Material& material : scene.materials) {
        if (error == Planted::nothing_discarded) material.discard_below = -1;
        if (error == Planted::nothing_culled) material.cull = Cull::none;
        if (error == Planted::depth_zero_moves && material.depth == 0) material.depth = 1.0f / 1024;
    }
}

void damage_scene(Planted error, Scene& scene) {
    damage_materials(error, scene);
    if (error == Planted::one_sample) scene.samples = 1;
    if (error == Planted::centre_for_centroid) scene.centroid = false;
    if (error == Planted::mirror_turns_inside_out) flip_winding(scene);
    if (error == Planted::flat_as_smooth) smooth(scene);
    if (error == Planted::reversed_z_less) scene.camera.reversed_z = false;
    if (error == Planted::far_plane_ignored) forget_far_plane(scene);
    if (error == Planted::later_wins_ties) std::reverse(scene.objects.begin(), scene.objects.end());
}

/// Whether a run with these options has the error that depends on how it is run.
bool shows(Planted error, const Scene& scene, const RenderOptions& options) {
    switch (error) {
        case Planted::one_bit:
            return true;
        case Planted::isa_rounds:
            return options.isa != "scalar";
        case Planted::tile_seam:
            return options.tile < 64;
        case Planted::window_corner:
            return options.window.has_value();
        case Planted::thread_dependent:
            return options.threads > 1;
        case Planted::neighbour_bleeds:
            return std::count_if(scene.objects.begin(), scene.objects.end(),
                                 [](const Object& o) { return o.visible; }) > 1;
        default:
            return false;
    }
}

void damage_multisampling(Planted error, const Scene& scene, const RenderOptions& options,
                          Film& film) {
    if (error == Planted::background_left_out) {
        const Film a = also(scene, options, {"A"});
        change(film, {"R"}, [&](std::uint32_t& bits, std::size_t i) {
            const float cover = a.planes[0].as_float(i);
            const float x = std::bit_cast<float>(bits);
            if (cover > 0) bits = bits_of((x - scene.background.r * (1 - cover)) / cover);
        });
    }
    if (error == Planted::farthest_z) {
        Scene behind = scene;
        behind.objects[0].visible = false;
        const Film z = also(behind, options, {"Z"});
        change(film, {"Z"}, [&](std::uint32_t& bits, std::size_t i) {
            if (z.planes[0].bits[i] != infinity) bits = z.planes[0].bits[i];
        });
    }
    if (error == Planted::fragment_of_centre) {
        Scene single = scene;
        single.samples = 1;
        const Film centre = render(single, options);
        for (Plane& plane : film.planes)
            if (plane.name.size() > 1) plane = *centre.find(plane.name);
    }
}

void damage_discard(Planted error, const Scene& scene, const RenderOptions& options, Film& film) {
    const Film own = also(scene, options, {"id.object", "quad.coverage"});
    if (error == Planted::discarded_writes_depth) {
        Scene solid = scene;
        damage_materials(Planted::nothing_discarded, solid);
        const Film all = also(solid, options, {"id.object"});
        change(film, {"id.object"}, [&](std::uint32_t& bits, std::size_t i) {
            if (all.planes[0].bits[i] != own.planes[0].bits[i]) bits = nothing;
        });
    }
    if (error == Planted::discarded_helpers)
        change(film, {"dUVdx.U", "dUVdx.V"}, [&](std::uint32_t& bits, std::size_t i) {
            if (own.planes[1].bits[i] != 15) bits = 0;
        });
}

void turn_upside_down(Film& film) {
    for (Plane& plane : film.planes) {
        const std::vector<std::uint32_t> rows = plane.bits;
        const std::size_t width = static_cast<std::size_t>(film.window.width());
        for (std::size_t i = 0; i < rows.size(); ++i)
            plane.bits[i] = rows[rows.size() - width - i / width * width + i % width];
    }
}

void damage_conventions(Planted error, const Scene& scene, Film& film) {
    if (scene.conventions == Conventions::gl) return;
    if (error == Planted::picture_upside_down) turn_upside_down(film);
    if (error == Planted::derivatives_of_image)
        change(film, {"dUVdy.U", "dUVdy.V", "dPdy.X", "dPdy.Y", "dPdy.Z"},
               [](std::uint32_t& bits, std::size_t) { bits ^= bits & 0x7fffffffu ? 1u << 31 : 0; });
}

void damage_values(Planted error, const RenderOptions& options, Film& film) {
    const auto replace = [&](const char* name, std::uint32_t from, std::uint32_t to) {
        change(film, {name}, [&](std::uint32_t& b, std::size_t) { b = b == from ? to : b; });
    };
    if (error == Planted::uncovered_is_black) change(film, {"R"}, [](auto& b, auto) { b = 0; });
    if (error == Planted::uncovered_z_zero) replace("Z", infinity, 0);
    if (error == Planted::uncovered_object_zero) replace("id.object", nothing, 0);
    if (error == Planted::viewer_at_origin)
        change(film, {"K.U"}, [](auto& b, auto i) { b += static_cast<std::uint32_t>(i) << 12; });
    if (error == Planted::needs_forgotten && options.channels.size() == 1)
        change(film, {"hit.P.X", "shadow.visibility"}, [](auto& b, auto) { b = 0; });
    if (error == Planted::nan_payload)
        change(film, {}, [](auto& b, auto) { b |= b == canonical_nan ? 1u : 0u; });
}

}  // namespace

Film render_with(Planted error, Scene scene, RenderOptions options) {
    if (error == Planted::anything_goes) {
        try {
            return render(scene, options);
        } catch (const std::runtime_error&) {
            return {};
        }
    }
    if (error == Planted::float_as_double) options.number = "float";
    damage_scene(error, scene);
    Film film = render(scene, options);
    if (shows(error, scene, options)) film.planes[0].bits[film.planes[0].bits.size() / 2] ^= 1;
    damage_multisampling(error, scene, options, film);
    if (error == Planted::discarded_writes_depth || error == Planted::discarded_helpers)
        damage_discard(error, scene, options, film);
    damage_conventions(error, scene, film);
    damage_values(error, options, film);
    return film;
}

}  // namespace quadrel::render_tests
