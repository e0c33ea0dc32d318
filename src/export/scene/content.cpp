#include "export/scene/content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "export/scene/shells.hpp"
#include "export/scene/webgpu.hpp"
#include "kernels/select.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/channels.hpp"
#include "render/draw/geometry.hpp"
#include "render/draw/shell.hpp"
#include "render/plan/prepared.hpp"

namespace quadrel {
namespace {

constexpr const char* cube_faces[] = {"px", "nx", "py", "ny", "pz", "nz"};

/// Letters, digits and underscores of a name that people gave, which no other has.
std::string unique_word(const std::string& name, std::set<std::string>& taken) {
    std::string word;
    for (const char c : name) word += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    if (word.empty()) word = "material";
    std::string result = word;
    for (int i = 2; !taken.insert(result).second; ++i) result = fmt::format("{}_{}", word, i);
    return result;
}

std::vector<bool> drawn_materials(const Scene& scene) {
    std::vector<bool> drawn(scene.materials.size(), false);
    for (const Object& object : scene.objects)
        if (object.visible) drawn[object.material] = true;
    return drawn;
}

RenderOptions render_options(const SceneExport& options, const ExportContent& content) {
    RenderOptions render;
    for (const ExportedChannel& channel : content.channels) render.channels.push_back(channel.name);
    render.threads = options.threads;
    render.progress = options.progress;
    render.baking = options.baking;
    render.not_kept = options.not_kept;
    render.baking_limit = options.baking_limit;
    return render;
}

/// The plan with the textures of the materials that are drawn, each with all of its levels.
PreparedRender planned(const Scene& scene, const RenderOptions& options) {
    PreparedRender prepared =
        plan_render(scene, options, select_kernels(options.number, options.isa));
    for (TexelsRead& read : prepared.plan.texels_read) read = TexelsRead();
    load_plan_textures(scene, drawn_materials(scene), prepared.plan,
                       {options.baking, options.not_kept, options.baking_limit}, 0);
    return prepared;
}

/// What decides over fragments comes first in a plan of its own; a program has all stages once.
std::vector<const PlannedStage*> stages_of(const Scene& scene, const RenderPlan& plan,
                                           std::size_t material, std::vector<PlannedStage>& all) {
    std::vector<const PlannedStage*> needed;
    all = material_stages(scene, scene.materials[material]);
    const auto is_planned = [&](const MaterialPlan& of, const PlannedStage& stage) {
        return std::any_of(of.stages.begin(), of.stages.end(), [&](const PlannedStage& other) {
            return other.info == stage.info && other.light == stage.light;
        });
    };
    for (const PlannedStage& stage : all)
        if (is_planned(plan.materials[material], stage) ||
            is_planned(plan.discard[material], stage))
            needed.push_back(&stage);
    return needed;
}

class Collector {
  public:
    Collector(ExportContent& content, const RenderPlan& plan) : content_(content), plan_(plan) {}

    void add(std::size_t material) {
        const Scene& scene = *content_.scene;
        const Material& of = scene.materials[material];
        ContentMaterial out{material, unique_word(of.name, names_), {}, {}, {}, false, false};
        out.discards = of.discard_below >= 0 || clips(of);
        out.writes_depth = writes_depth(of);
        out.program = program(material, out);
        for (const ProgramName& sampler : out.program.samplers)
            out.samplers.push_back(bound(material, sampler, out.program.fragment, out.name));
        content_.materials.push_back(std::move(out));
    }

  private:
    Program program(std::size_t material, ContentMaterial& out) {
        const Scene& scene = *content_.scene;
        const Material& of = scene.materials[material];
        std::vector<PlannedStage> all;
        std::vector<StageUse> uses;
        for (const PlannedStage* stage : stages_of(scene, plan_, material, all)) {
            uses.push_back({stage->info->text.id, stage->params.data(), std::max(stage->light, 0)});
            std::string name = fmt::format("{}/{}", stage->info->text.room, stage->info->text.id);
            if (stage->light >= 0) name += fmt::format(" (light {})", stage->light);
            out.stages.push_back(name);
        }
        // Without bounds of heights, by which steps are left out.
        const MaterialUniforms uniforms = material_uniforms(of);
        ProgramRequest request{};
        request.language = content_.language.c_str();
        request.material = of.name.c_str();
        request.stages = uses.data();
        request.stage_count = static_cast<std::int32_t>(uses.size());
        request.frame = &content_.frame;
        request.uniforms = &uniforms;
        for (int slot = 0; slot < texture_slot_count; ++slot)
            request.textures[slot] = plan_.textures[material].bound(slot);
        request.passes = content_.passes.data();
        request.pass_count = static_cast<std::int32_t>(content_.passes.size());
        request.discard_below = of.discard_below;
        request.clips = clips(of);
        request.writes_depth = out.writes_depth;
        for (const Object& object : scene.objects)
            request.has_flat_meshes |= object.visible && object.material == material &&
                                       scene.meshes[object.mesh].normals.empty();
        request.centroid = scene.centroid && scene.samples > 1;
        request.draws_shells = draws_shell(of);
        return export_program(request);
    }

    ContentSampler bound(std::size_t material, const ProgramName& sampler,
                         const std::string& fragment, const std::string& material_name) {
        if (sampler.name == "shell_table") return bound_shells(sampler);
        const auto slot = static_cast<std::size_t>(sampler.number);
        const MaterialTextures& textures = plan_.textures[material];
        ContentSampler out{sampler.name, 0, textures.sampled[slot].sampler};
        if (sampler.name.ends_with("_nearest")) out.state.mag = out.state.min = Filter::nearest;
        if (static_cast<TextureSlot>(slot) >= first_baked_slot) {
            // Look-ups of baked maps are always bilinear, in one level.
            const SamplerState heights = out.state;
            out.state = {};
            out.state.wrap_u = heights.wrap_u;
            out.state.wrap_v = heights.wrap_v;
            std::copy_n(heights.border, 4, out.state.border);
            out.state.mip = MipFilter::none;
        }
        const TextureShape shape = sampler.type == "samplerCube"      ? TextureShape::cube
                                   : sampler.type == "sampler2DArray" ? TextureShape::layers
                                                                      : TextureShape::flat;
        const TextureView& view = textures.owned[slot]->view();
        const bool asks_sizes =
            fragment.find("textureSize(" + sampler.name + ",") != std::string::npos ||
            fragment.find("texture_size(" + sampler.name + ",") != std::string::npos ||
            fragment.find("textureDimensions(" + sampler.name + ",") != std::string::npos;
        if (asks_sizes && !has_mip_sizes(view))
            throw UsageError(
                fmt::format("export: {}: asks for the sizes of the {}x{} map {}, whose levels are "
                            "rounded up as no GPU's are",
                            material_name, view.width[0], view.height[0], sampler.name));
        const auto layout =
            is_layers(static_cast<TextureSlot>(slot)) ? depth_layers_layout : texel_layout;
        if (content_.language == "wgsl" && reads_by_sampler(fragment, sampler.name))
            check_webgpu_sampler(out.state, material_name + ": " + sampler.name);
        out.texture = texture(textures.owned[slot], shape, material_name + "_" + sampler.name,
                              layout(*textures.owned[slot], content_.language));
        return out;
    }

    /// One table for all materials, whose texels are fetched.
    ContentSampler bound_shells(const ProgramName& sampler) {
        if (shell_table_ == nullptr) shell_table_ = SceneShells(*content_.scene).table();
        ContentSampler out{sampler.name, 0, {}};
        out.state.mag = out.state.min = Filter::nearest;
        out.state.mip = MipFilter::none;
        out.state.wrap_u = out.state.wrap_v = Wrap::clamp_to_edge;
        out.texture = texture(shell_table_, TextureShape::flat, sampler.name,
                              texel_layout(*shell_table_, content_.language));
        return out;
    }

    std::size_t texture(const std::shared_ptr<const Texture>& texture, TextureShape shape,
                        std::string name, const TexelLayout& layout) {
        auto& all = content_.textures;
        for (std::size_t i = 0; i < all.size(); ++i)
            if (all[i].texture == texture && all[i].shape == shape &&
                all[i].layout.channels == layout.channels)
                return i;
        if (const std::size_t at = name.rfind("_nearest"); at != std::string::npos) name.resize(at);
        all.push_back({unique_word(name, texture_names_), texture, shape, layout});
        return all.size() - 1;
    }

    ExportContent& content_;
    const RenderPlan& plan_;
    std::set<std::string> names_, texture_names_;
    std::shared_ptr<const Texture> shell_table_;
};

std::vector<std::string> attributes_of(const ExportContent& content) {
    std::vector<std::string> names;
    for (const ContentMaterial& material : content.materials)
        for (const ProgramName& attribute : material.program.attributes)
            names.push_back(attribute.name);
    return names;
}

/// Those of shells share theirs with tangents, gradients and curvatures.
void check_locations(const VertexBuffers& buffers) {
    std::map<int, const char*> known;
    for (const VertexAttribute& attribute : buffers.attributes) {
        const auto [first, is_new] = known.emplace(attribute.location, attribute.name);
        if (!is_new)
            throw UsageError(fmt::format(
                "export: vertices with both {} and {}, expected one of them: a scene for shells "
                "and one for other objects",
                first->second, attribute.name));
    }
}

/// All that follows from what is prepared.
void gather(ExportContent& content) {
    const RenderPlan& plan = content.prepared->plan;
    content.frame = plan.frame;
    Collector collector(content, plan);
    const std::vector<bool> drawn = drawn_materials(*content.scene);
    for (std::size_t m = 0; m < drawn.size(); ++m)
        if (drawn[m]) collector.add(m);
    content.buffers = vertex_buffers(*content.scene, attributes_of(content));
    check_locations(content.buffers);
}

}  // namespace

std::string ContentTexture::bytes_file(int level) const {
    return fmt::format("textures/{}.{}.bin", name, level);
}

std::string ContentTexture::exr_file(int level, int face) const {
    if (texture->view().faces == 1) return fmt::format("textures/{}.{}.exr", name, level);
    if (shape == TextureShape::cube)
        return fmt::format("textures/{}.{}.{}.exr", name, level, cube_faces[face]);
    return fmt::format("textures/{}.{}.{:03}.exr", name, level, face);
}

int ContentTexture::rows(int level) const {
    const TextureView& view = texture->view();
    return side_of_level(view, level).height * (shape == TextureShape::flat ? view.faces : 1);
}

std::string ContentMaterial::vertex_file(const std::string& language) const {
    const bool has_stages = language == "hlsl" || language == "wgsl";
    return name + (has_stages ? "_vertex." + language : ".vert");
}

std::string ContentMaterial::fragment_file(const std::string& language) const {
    const bool has_stages = language == "hlsl" || language == "wgsl";
    return name + (has_stages ? "_fragment." + language : ".frag");
}

ExportContent export_content(const Scene& scene, const SceneExport& options) {
    if (options.language == "wgsl") check_webgpu_scene(scene);
    ExportContent content{&scene, options.language, {}, {}, {}, {}, {}, {}, {}, {}, {}};
    const std::vector<std::string> names = options.channels.empty()
                                               ? exportable_channels(scene, options.language)
                                               : expand_channels(options.channels);
    content.channels = exported_channels(scene, names);
    content.passes = passes_of(content.channels, targets_at_once(options.language));
    const RenderOptions render = render_options(options, content);
    content.prepared = std::make_shared<const PreparedRender>(planned(scene, render));
    gather(content);
    if (options.reference) content.expected = quadrel::render(scene, render);
    for (const auto& [name, value] : render_attributes(scene, render))
        content.expected_attributes[name] = value;
    return content;
}

ExportContent content_in(const ExportContent& content, const std::string& language) {
    ExportContent other{content.scene,
                        language,
                        content.channels,
                        {},
                        {},
                        {},
                        {},
                        {},
                        {},
                        content.expected_attributes,
                        content.prepared};
    other.passes = passes_of(other.channels, targets_at_once(language));
    gather(other);
    return other;
}

}  // namespace quadrel
