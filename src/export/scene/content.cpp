#include "export/scene/content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>

#include "export/direction_maps.hpp"
#include "export/scene/material_program.hpp"
#include "export/scene/shells.hpp"
#include "export/scene/webgpu.hpp"
#include "kernels/select.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/channels.hpp"
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

/// Whether a vertex program makes it.
bool is_of_program(const VertexAttribute& attribute) {
    return std::none_of(all_vertex_attributes().begin(), all_vertex_attributes().end(),
                        [&](const VertexAttribute& of) { return of.name == attribute.name; });
}

/// Whether its location depends on what else is read.
bool needs_place(const VertexAttribute& attribute) {
    return is_of_program(attribute) ||
           attribute.location >= static_cast<int>(most_vertex_attributes);
}

/// What some program reads: what all vertices have, then what vertex programs make, at the end.
std::vector<VertexAttribute> attributes_of(const ExportContent& content) {
    std::map<std::string, const ProgramName*> read;
    for (const ContentMaterial& material : content.materials)
        for (const ProgramName& attribute : material.program.attributes)
            read.emplace(attribute.name, &attribute);
    std::vector<VertexAttribute> all;
    for (const VertexAttribute& attribute : all_vertex_attributes())
        if (read.erase(attribute.name) != 0) all.push_back(attribute);
    for (const auto& [name, attribute] : read)
        all.push_back(
            {name, attribute->number, std::atoi(attribute->type.c_str()), 0,
             "the varying of that name, as Quadrel has it: what the vertex shader's function "
             "makes of the corner"});
    return all;
}

class Collector {
  public:
    Collector(ExportContent& content, const RenderPlan& plan) : content_(content), plan_(plan) {}

    void add(std::size_t material) {
        const Scene& scene = *content_.scene;
        const Material& of = scene.materials[material];
        const MaterialProgram& asked =
            *programs_.emplace_back(std::make_unique<MaterialProgram>(content_, plan_, material));
        ContentMaterial out{material, unique_word(of.name, names_), {}, {}, {}, {}, false, false};
        out.discards = of.discard_below >= 0 || clips(of);
        out.writes_depth = writes_depth(of);
        out.program = export_program(asked.request());
        out.stages = asked.stage_names();
        out.uniforms = material_values_by_name(of);
        for (const ProgramName& sampler : out.program.samplers) {
            out.samplers.push_back(bound(material, sampler, out.program.fragment, out.name));
            if (is_direction_map(static_cast<TextureSlot>(sampler.number)))
                add_table_numbers(
                    sampler.name,
                    *plan_.textures[material].owned[static_cast<std::size_t>(sampler.number)],
                    out.uniforms);
        }
        content_.materials.push_back(std::move(out));
    }

    void add_vertices() {
        std::vector<VertexAttribute> attributes = attributes_of(content_);
        if (std::any_of(attributes.begin(), attributes.end(), needs_place))
            attributes = place(std::move(attributes));
        const auto run = [&](std::size_t object, const VertexList& vertices) {
            return values_of(object, vertices);
        };
        content_.buffers = vertex_buffers(*content_.scene, shells(), attributes, run);
    }

  private:
    const SceneShells& shells() {
        if (!shells_) shells_.emplace(*content_.scene);
        return *shells_;
    }

    static void add_table_numbers(const std::string& map, const Texture& table,
                                  UniformValues& values) {
        const float* const numbers = table.level_texels(2, 0);
        values[map + "_depth"] = {numbers[0]};
        values[map + "_curvature"] = {numbers[1]};
    }

    /// Gives attributes the first locations, as many of them as there may be, and all programs with
    /// what they have.
    std::vector<VertexAttribute> place(std::vector<VertexAttribute> attributes) {
        if (attributes.size() > most_vertex_attributes) {
            if (!is_of_program(attributes[most_vertex_attributes]))
                throw UsageError(
                    fmt::format("export: vertices with {} attributes, expected at most {}: a scene "
                                "for shells and one for other objects",
                                attributes.size(), most_vertex_attributes));
            attributes.resize(most_vertex_attributes);
        }
        std::vector<const char*> names;
        for (std::size_t i = 0; i < attributes.size(); ++i) {
            attributes[i].location = static_cast<int>(i);
            names.push_back(attributes[i].name.c_str());
        }
        for (std::size_t i = 0; i < programs_.size(); ++i) {
            ProgramRequest request = programs_[i]->request();
            request.attributes = names.data();
            request.attribute_count = static_cast<std::int32_t>(names.size());
            content_.materials[i].program = export_program(request);
        }
        return attributes;
    }

    NamedFloats values_of(std::size_t object, const VertexList& vertices) const {
        const Object& of = content_.scene->objects[object];
        UniformValues uniforms = frame_values_by_name(content_.frame);
        uniforms.merge(object_values_by_name(*content_.scene, of));
        const auto program =
            std::find_if(programs_.begin(), programs_.end(),
                         [&](const auto& asked) { return asked->material() == of.material; });
        return vertex_program_values((*program)->request(), vertices, uniforms);
    }

    ContentSampler bound(std::size_t material, const ProgramName& sampler,
                         const std::string& fragment, const std::string& material_name) {
        if (sampler.name == "shell_table") return bound_shells(sampler);
        const auto slot = static_cast<std::size_t>(sampler.number);
        const MaterialTextures& textures = plan_.textures[material];
        const bool is_table = is_direction_map(static_cast<TextureSlot>(slot));
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
        if (is_table) {  // its texels are fetched
            out.state = {};
            out.state.mag = out.state.min = Filter::nearest;
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
        out.texture =
            texture(textures.owned[slot], shape, material_name + "_" + sampler.name,
                    layout(*textures.owned[slot], content_.language), is_table ? 1 : view.levels);
        return out;
    }

    /// One table for all materials, whose texels are fetched.
    ContentSampler bound_shells(const ProgramName& sampler) {
        if (shell_table_ == nullptr) shell_table_ = shells().table();
        ContentSampler out{sampler.name, 0, {}};
        out.state.mag = out.state.min = Filter::nearest;
        out.state.mip = MipFilter::none;
        out.state.wrap_u = out.state.wrap_v = Wrap::clamp_to_edge;
        out.texture = texture(shell_table_, TextureShape::flat, sampler.name,
                              texel_layout(*shell_table_, content_.language), 1);
        return out;
    }

    std::size_t texture(const std::shared_ptr<const Texture>& texture, TextureShape shape,
                        std::string name, const TexelLayout& layout, int levels) {
        auto& all = content_.textures;
        for (std::size_t i = 0; i < all.size(); ++i)
            if (all[i].texture == texture && all[i].shape == shape &&
                all[i].layout.channels == layout.channels)
                return i;
        if (const std::size_t at = name.rfind("_nearest"); at != std::string::npos) name.resize(at);
        all.push_back({unique_word(name, texture_names_), texture, shape, layout, levels});
        return all.size() - 1;
    }

    ExportContent& content_;
    const RenderPlan& plan_;
    std::vector<std::unique_ptr<MaterialProgram>> programs_;  ///< one a material
    std::set<std::string> names_, texture_names_;
    std::optional<SceneShells> shells_;  ///< once they are asked for
    std::shared_ptr<const Texture> shell_table_;
};

/// All that follows from what is prepared.
void gather(ExportContent& content) {
    const RenderPlan& plan = content.prepared->plan;
    content.frame = plan.frame;
    Collector collector(content, plan);
    const std::vector<bool> drawn = drawn_materials(*content.scene);
    for (std::size_t m = 0; m < drawn.size(); ++m)
        if (drawn[m]) collector.add(m);
    collector.add_vertices();
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

LevelSide ContentTexture::side(int level) const {
    return side_of_level(first_levels(texture->view(), levels), level);
}

int ContentTexture::rows(int level) const {
    return side(level).height * (shape == TextureShape::flat ? texture->view().faces : 1);
}

bool ContentTexture::is_padded() const {
    return !has_mip_sizes(first_levels(texture->view(), levels));
}

std::string ContentTexture::bytes(int level, const TexelLayout& of) const {
    return level_bytes(*texture, level, of, side(level));
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
