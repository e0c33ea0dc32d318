#include "render/changes/image_inputs.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "render/plan/prepared.hpp"
#include "render/registry/added_stages.hpp"

namespace quadrel {
namespace {

using Sorted = nlohmann::json;

/// The scene as it is hashed, with names in the places of what they name.
class ResolvedScene {
  public:
    explicit ResolvedScene(const Scene& scene) : root_(Sorted::parse(scene.canonical)) {}

    /// Without what is told apart by objects.
    Sorted rest() const {
        Sorted rest = root_;
        for (const char* const key : {"material", "materials", "textures", "meshes", "objects"})
            rest.erase(key);
        return rest;
    }

    Sorted material(const std::string& name) const {
        const Sorted materials = root_.value("materials", Sorted::object());
        return materials.contains(name) ? materials[name]
                                        : root_.value("material", Sorted::object());
    }

    /// A texture's name as the texture.
    Sorted texture(const Sorted& text) const { return named(text, "textures"); }

    Sorted object(std::size_t index) const {
        const Sorted objects = root_.value("objects", Sorted::array());
        Sorted object = index < objects.size() ? objects[index] : Sorted::object();
        object["mesh"] = named(object.value("mesh", Sorted()), "meshes");
        Sorted& mesh = object["mesh"];
        if (mesh.is_object() && mesh.contains("displace") && mesh["displace"].contains("height"))
            mesh["displace"]["height"] = texture(mesh["displace"]["height"]);
        return object;
    }

  private:
    Sorted named(const Sorted& text, const char* list) const {
        const Sorted names = root_.value(list, Sorted::object());
        return text.is_string() && names.contains(text) ? names[text.get<std::string>()] : text;
    }

    Sorted root_;
};

/// Rooms whose stages are planned for a material.
std::set<std::string> planned_rooms(const RenderPlan& plan, std::size_t material) {
    std::set<std::string> rooms;
    for (const MaterialPlan* const part : plans_that_load(plan, material))
        for (const PlannedStage& stage : part->stages) rooms.insert(stage.info->text.room);
    return rooms;
}

bool is_lit(const std::set<std::string>& rooms) {
    return rooms.contains("shade") || rooms.contains("shadow") || rooms.contains("occlusion");
}

void drop_unplanned_stages(const std::set<std::string>& rooms, Sorted& material) {
    if (!is_lit(rooms))
        for (const char* const key :
             {"shade", "ambient", "diffuse", "specular", "emission", "shininess"})
            material.erase(key);
    if (!material.contains("relief") || !material["relief"].is_object()) return;
    for (const std::string key :
         {"frame", "trace", "clip", "frag_depth", "surface", "shadow", "occlusion"}) {
        std::string room = key;
        std::replace(room.begin(), room.end(), '_', '-');
        if (!rooms.contains(room)) material["relief"].erase(key);
    }
}

void drop_unread_textures(const ResolvedScene& scene, const SlotSet& read, Sorted& material) {
    for (int i = 0; i < texture_slot_count; ++i) {
        const std::string key(slot_name(static_cast<TextureSlot>(i)));
        if (!material.contains(key)) continue;
        if (read[static_cast<std::size_t>(i)])
            material[key] = scene.texture(material[key]);
        else
            material[key] = "unread";  // that there is one decides over default stages
    }
}

/// What is baked of the heights or layers needs these.
SlotSet with_sources(SlotSet read) {
    for (int i = static_cast<int>(first_baked_slot); i < texture_slot_count; ++i)
        if (read[static_cast<std::size_t>(i)])
            read.set(static_cast<std::size_t>(source_of(static_cast<TextureSlot>(i))));
    return read;
}

std::string shading_of(const ResolvedScene& scene, const RenderPlan& plan, std::size_t index,
                       const std::string& name) {
    Sorted material = scene.material(name);
    SlotSet read = with_sources(slots_read(plan, index));
    if (plan.materials[index].needs_height) read.set(static_cast<std::size_t>(TextureSlot::height));
    drop_unread_textures(scene, read, material);
    drop_unplanned_stages(planned_rooms(plan, index), material);
    Sorted stages = Sorted::array();
    for (const MaterialPlan* const part : plans_that_load(plan, index))
        for (const PlannedStage& stage : part->stages) stages.push_back(stage.info->text.id);
    return Sorted{material, stages}.dump();
}

void include(const Window& pixels, std::optional<Window>& in) {
    if (!in) {
        in = pixels;
        return;
    }
    in = Window{std::min(in->x0, pixels.x0), std::min(in->y0, pixels.y0),
                std::max(in->x1, pixels.x1), std::max(in->y1, pixels.y1)};
}

void find_bounds(const PreparedRender& prepared, std::vector<ObjectInputs>& objects) {
    const Scene& scene = *prepared.scene;
    const Viewport viewport{scene.width, scene.height, scene.conventions};
    for (const DrawnTriangle& triangle : prepared.geometry.triangles) {
        const PixelRect image = flip_rect(viewport, triangle.screen.bounds);
        const Window seen = intersection({image.x0, image.y0, image.x1, image.y1}, prepared.window);
        if (seen.width() > 0 && seen.height() > 0) include(seen, objects[triangle.object].bounds);
    }
}

/// Lights and surroundings count only where something is lit.
std::string everywhere(const ResolvedScene& scene, const PreparedRender& prepared,
                       const RenderOptions& options) {
    Sorted rest = scene.rest();
    bool lit = false;
    for (std::size_t m = 0; m < prepared.plan.materials.size(); ++m)
        lit |= is_lit(planned_rooms(prepared.plan, m));
    if (!lit)
        for (const char* const key : {"lights", "environment"}) rest.erase(key);
    // Samples of integrals lie anywhere in their pixels.
    if (options.integral) rest["scene"] = prepared.scene->canonical;
    return rest.dump();
}

bool differ(const ObjectInputs& a, const ObjectInputs& b) {
    return a.own != b.own || a.shading != b.shading;
}

void add_unique(const std::string& text, std::vector<std::string>& to) {
    if (std::find(to.begin(), to.end(), text) == to.end()) to.push_back(text);
}

}  // namespace

ImageInputs image_inputs(const Scene& scene, const RenderOptions& options) {
    const PreparedRender prepared = plan_render(scene, options, select_kernels(options));
    const ResolvedScene resolved(scene);
    ImageInputs inputs;
    inputs.window = prepared.window;
    inputs.everywhere = everywhere(resolved, prepared, options);
    std::size_t before = 0;  // triangles of earlier objects: order and numbers of those that follow
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        const std::string& material = scene.materials[object.material].name;
        inputs.objects.push_back({object.name, material, Sorted{resolved.object(i), before}.dump(),
                                  shading_of(resolved, prepared.plan, object.material, material),
                                  std::nullopt});
        before += scene.meshes[object.mesh].triangles.size();
    }
    find_bounds(prepared, inputs.objects);
    return inputs;
}

ImageChange change_between(const ImageInputs& before, const ImageInputs& after) {
    ImageChange change;
    if (before.everywhere != after.everywhere || before.window != after.window) {
        change.what.push_back("the whole scene");
        change.pixels = after.window;
        return change;
    }
    const std::size_t most = std::max(before.objects.size(), after.objects.size());
    for (std::size_t i = 0; i < most; ++i) {
        const ObjectInputs* const old = i < before.objects.size() ? &before.objects[i] : nullptr;
        const ObjectInputs* const now = i < after.objects.size() ? &after.objects[i] : nullptr;
        if (old != nullptr && now != nullptr && !differ(*old, *now)) continue;
        for (const ObjectInputs* const object : {old, now})
            if (object != nullptr && object->bounds) include(*object->bounds, change.pixels);
        const bool same_place = old != nullptr && now != nullptr && old->own == now->own;
        const ObjectInputs& named = now != nullptr ? *now : *old;
        add_unique(
            same_place ? "material \"" + named.material + "\"" : "object \"" + named.name + "\"",
            change.what);
    }
    return change;
}

}  // namespace quadrel
