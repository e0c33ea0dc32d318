#include "render/plan/shell_check.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include "quadrel/error.hpp"
#include "quadrel/relief/registry.hpp"
#include "quadrel/relief/shell/stages.hpp"
#include "render/draw/shell.hpp"
#include "render/plan/plan.hpp"
#include "render/registry/added_stages.hpp"
#include "render/registry/is_listed.hpp"

namespace quadrel {
namespace {

std::string id_or_default(const Material& material, const StageChoice& choice,
                          std::string_view room) {
    if (!choice.id.empty()) return choice.id;
    return std::string(default_stage(room, height_source(material)));
}

/// Whether a normal is made with the face's, which in a shell is that of a tetrahedron's side.
/// Those of normal maps ask it for the side that is seen, and nothing more.
bool takes_face_normal(std::string_view surface) {
    const StageInfo* stage = find_stage(surface);
    return stage != nullptr && std::ranges::count(stage->inputs, Value::Ng) > 0 &&
           !surface.starts_with("normal-map");
}

/// Says what is wrong with a material, key by key.
class Refusal {
  public:
    Refusal(const Scene& scene, const Material& material)
        : scene_(scene), key_(material.key.empty() ? "materials." + material.name : material.key) {}

    [[noreturn]] void at(const std::string& key, const std::string& found,
                         const std::string& expected) const {
        throw InputError(scene_.file.string(), key_ + "." + key, found, expected);
    }
    [[noreturn]] void at(const StageChoice& choice, const char* room, const std::string& found,
                         const std::string& expected) const {
        const std::string key = choice.key.empty() ? key_ + ".relief." + room : choice.key;
        throw InputError(scene_.file.string(), key, found, expected);
    }

  private:
    const Scene& scene_;
    std::string key_;
};

}  // namespace

bool is_of_shells(std::string_view stage) { return is_listed(ShellStages(), stage); }

void check_shell(const Scene& scene, const Material& material) {
    const Refusal refuse(scene, material);
    const std::string trace = id_or_default(material, material.trace, "trace");
    const std::string surface = id_or_default(material, material.surface, "surface");
    const bool shell = draws_shell(material);
    if (is_of_shells(trace) != shell)
        refuse.at(material.trace, "trace", trace,
                  shell ? "a search of shells, prism-exact or prism-pom: the frame is frame-shell"
                        : "\"frame\": \"frame-shell\" beside it, or a search of heights");
    if (!shell) return;
    if (material.depth_in_tiles)
        refuse.at("relief.depth", "a depth in tiles", "world units, of which frame-shell is built");
    if (material.fade_from < material.fade_to)
        refuse.at("relief.grazing_fade", "a depth that fades", "none: frame-shell has one depth");
    if (material.cull == Cull::front)
        refuse.at("cull", "front", "none or back: frame-shell is drawn by where rays enter");
    if (material.clip.id == "clip-path")
        refuse.at(material.clip, "clip", "clip-path",
                  "none or clip-uv: rays of frame-shell do not begin at its top");
    if (takes_face_normal(surface))
        refuse.at(material.surface, "surface", surface,
                  "one that does without the face's normal, such as h2n-sobel: the faces of "
                  "frame-shell are not the mesh's");
    for (const Object& object : scene.objects)
        if (&scene.materials[object.material] == &material &&
            scene.meshes[object.mesh].normals.empty())
            refuse.at(material.frame, "frame", "frame-shell on a mesh without vertex normals",
                      "normals, along which a shell is built");
}

}  // namespace quadrel
