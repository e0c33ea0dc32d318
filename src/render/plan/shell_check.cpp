#include "render/plan/shell_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

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

/// The searches that go with a frame of shells; none for other frames.
std::vector<std::string_view> searches_of_frame(std::string_view frame) {
    if (frame == "frame-shell") return {"prism-exact", "prism-pom"};
    if (frame == "frame-prism") return {"prism-gs"};
    if (frame == "frame-prism@published") return {"prism-gs@published"};
    return {};
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

std::string_view frame_of_search(std::string_view trace) {
    for (const std::string_view frame : {"frame-shell", "frame-prism", "frame-prism@published"})
        if (std::ranges::count(searches_of_frame(frame), trace) != 0) return frame;
    return "";
}

namespace {

/// What is of shells, and frame and search, go together.
void check_belongings(const Material& material, const Refusal& refuse) {
    const std::string trace = id_or_default(material, material.trace, "trace");
    const std::string shadow = id_or_default(material, material.shadow, "shadow");
    if (is_of_shells(shadow) && shell_kind(material) != ShellKind::tetrahedra)
        refuse.at(material.shadow, "shadow", shadow,
                  "\"frame\": \"frame-shell\" beside it, whose tetrahedra it goes through");
    const std::vector<std::string_view> searches = searches_of_frame(material.frame.id);
    if (is_of_shells(trace) && !draws_shell(material))
        refuse.at(material.trace, "trace", trace,
                  fmt::format("\"frame\": \"{}\" beside it, or a search of heights",
                              frame_of_search(trace)));
    if (draws_shell(material) && std::ranges::count(searches, trace) == 0)
        refuse.at(material.trace, "trace", trace,
                  fmt::format("a search of shells, {}: the frame is {}",
                              fmt::join(searches, " or "), material.frame.id));
}

/// What a shell cannot be, or be drawn by.
void check_restrictions(const Material& material, const Refusal& refuse) {
    const std::string surface = id_or_default(material, material.surface, "surface");
    if (shell_kind(material) == ShellKind::strips && material.seat != 0)
        refuse.at("relief.seat", fmt::format("{}", material.seat),
                  "0: frame-prism@published has the mesh at the relief's bottom");
    if (material.depth_in_tiles)
        refuse.at("relief.depth", "a depth in tiles", "world units, of which shells are built");
    if (material.fade_from < material.fade_to)
        refuse.at("relief.grazing_fade", "a depth that fades", "none: shells have one depth");
    if (material.cull == Cull::front)
        refuse.at("cull", "front", "none or back: shells are drawn by where rays enter");
    if (material.clip.id == "clip-path")
        refuse.at(material.clip, "clip", "clip-path",
                  "none or clip-uv: rays of shells do not begin at their tops");
    if (takes_face_normal(surface))
        refuse.at(material.surface, "surface", surface,
                  "one that does without the face's normal, such as h2n-sobel: the faces of "
                  "shells are not the mesh's");
}

}  // namespace

void check_shell(const Scene& scene, const Material& material) {
    const Refusal refuse(scene, material);
    check_belongings(material, refuse);
    if (!draws_shell(material)) return;
    check_restrictions(material, refuse);
    for (const Object& object : scene.objects)
        if (&scene.materials[object.material] == &material &&
            scene.meshes[object.mesh].normals.empty())
            refuse.at(material.frame, "frame",
                      material.frame.id + " on a mesh without vertex normals",
                      "normals, along which a shell is built");
}

}  // namespace quadrel
