#include "render/prepare/geometry_cache.hpp"

#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

#include "render/draw/shell.hpp"
#include "text/hash.hpp"

namespace quadrel {
namespace {

/// A hash of values that have no padding.
class Key {
  public:
    template <class T>
    Key& add(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        hash_.update({reinterpret_cast<const char*>(&value), sizeof value});
        return *this;
    }

    template <class T>
    Key& add_all(const std::vector<T>& values) {
        add(values.size());
        hash_.update({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
        return *this;
    }

    Key& add_text(std::string_view text) {
        add(text.size());
        hash_.update(text);
        return *this;
    }

    std::string text() { return hash_.hex(); }

  private:
    Sha256 hash_;
};

void add_mesh(const Mesh& mesh, Key& key) {
    key.add_all(mesh.positions).add_all(mesh.normals).add_all(mesh.uvs);
    key.add_all(mesh.tangents).add_all(mesh.triangles);
    key.add(mesh.billboard.has_value());
    if (mesh.billboard) key.add(mesh.billboard->size).add(mesh.billboard->radius);
}

}  // namespace

std::string geometry_key(const Scene& scene, const HardwareModel& hardware,
                         const GeometryParts& parts) {
    Key key;
    key.add(scene.width).add(scene.height).add(scene.samples).add(scene.conventions);
    key.add(hardware.subpixel_bits).add(hardware.snap_rounding).add(hardware.interpolation);
    key.add(parts.frames).add(parts.vertices).add(parts.quadrics).add(parts.all_triangles);
    key.add(scene.camera.view).add(scene.camera.projection).add(scene.camera.reversed_z);
    key.add(scene.meshes.size());
    for (const Mesh& mesh : scene.meshes) add_mesh(mesh, key);
    key.add(scene.materials.size());
    for (const Material& material : scene.materials) {
        key.add(material.texture_matrix).add(material.cull).add_text(material.frame.id);
        if (draws_shell(material))
            key.add(material.depth).add(material.seat).add(walks_shell(material));
    }
    key.add(scene.objects.size());
    for (const Object& object : scene.objects)
        key.add(object.mesh).add(object.material).add(object.transform).add(object.visible);
    return key.text();
}

Geometry GeometryCache::take(const Scene& scene, const HardwareModel& hardware,
                             const GeometryParts& parts) {
    taken_ = geometry_key(scene, hardware, parts);
    if (!std::exchange(key_, "").compare(taken_)) return std::move(geometry_);
    ++assembled_;
    return assemble_geometry(scene, hardware, parts);
}

void GeometryCache::give_back(Geometry geometry) {
    geometry_ = std::move(geometry);
    key_ = std::exchange(taken_, "");
}

}  // namespace quadrel
