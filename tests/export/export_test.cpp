// Exported functions against the stages that they were made of, bit for bit.
#include <gtest/gtest.h>

#include <bit>
#include <span>

#include "export/exported.hpp"
#include "export/fragments.hpp"
#include "export/glsl.hpp"
#include "export/shell_rows.hpp"
#include "export/vertex_runs.hpp"
#include "quadrel/relief/registry.hpp"
#include "render/plan/shell_check.hpp"

namespace quadrel::export_tests {
namespace {

/// A part of a batch; what is odd among the inputs comes in each.
constexpr int compared_lanes = 32;

class Comparison {
  public:
    explicit Comparison(std::uint64_t seed)
        : random_(seed),
          material_(recorded::plain_material()),
          maps_(random_, true),
          frame_(random_frame(random_)),
          triangles_(random_),
          shells_(random_) {
        fill_inputs(inputs_, random_);
        set_uniforms();
    }

    /// What differs first; empty if nothing does.
    std::string difference(const ExportedFunction& function,
                           std::span<const EditedParameter> edits = {}) {
        bind_maps(function.uses_neighbours && function.has_branches);
        run_stage_itself(*find_stage(function.id), edits);
        for (int lane = 0; lane < compared_lanes; lane += 4) run_quad(function, lane);
        return compared();
    }

  private:
    /// Level 0 alone where a level may follow from neighbours that have left a loop.
    void bind_maps(bool finest_alone) {
        for (int slot = 0; slot < texture_slot_count; ++slot) {
            bound_[slot] = maps_.map(slot);
            if (finest_alone) bound_[slot].sampler.mip = MipFilter::none;
            glsl::samplers[slot]->map = &bound_[slot];
        }
        nearest_ = bound_[static_cast<int>(TextureSlot::height)];
        nearest_.sampler.mag = nearest_.sampler.min = Filter::nearest;
        glsl::height_map_nearest.map = &nearest_;
    }

    void run_stage_itself(const StageInfo& stage, std::span<const EditedParameter> edits) {
        std::vector<std::max_align_t> params(stage.params_size / sizeof(std::max_align_t) + 1);
        stage.set_defaults(params.data());
        for (const EditedParameter& edit : edits)
            for (const ParameterText& of : stage.parameters)
                if (std::string_view(of.name) == edit.name) of.set(params.data(), edit.value);
        // Inputs first: a stage may store what others load.
        for (int slot = 0; slot < slot_count; ++slot)
            std::copy_n(inputs_.at(slot), batch_lanes, expected_.at(slot));
        for (int slot = 0; slot < slot_count; ++slot)
            std::copy_n(inputs_.at(slot), batch_lanes, found_.at(slot));
        std::uint32_t active[batch_lanes];
        std::fill_n(active, batch_lanes, 1u);
        StageCall call{};
        call.values = expected_.pointers();
        call.active = active;
        call.lanes = compared_lanes;
        call.parameters = params.data();
        triangles_.bind(call);
        call.material = &material_;
        call.frame = &frame_;
        for (int slot = 0; slot < texture_slot_count; ++slot) call.textures[slot] = &bound_[slot];
        if (RandomShells::are_read_by(stage.text.id)) shells_.bind(stage.text.id, call, inputs_);
        glsl::shell_table.map = &shells_.table();
        find_kernel(scalar_float_kernels(), stage.text.id)(&call);
    }

    /// Neighbours' values are right once all are that they were made of in the round before.
    void run_quad(const ExportedFunction& function, int first_lane) {
        constexpr int rounds = 4;
        glsl::quad_run.forget();
        const auto varyings = triangles_.interpolated(function, first_lane);
        for (int round = 0; round < (function.uses_neighbours ? rounds : 1); ++round) {
            for (int lane = 0; lane < 4; ++lane) {
                glsl::quad_run.begin(lane);
                function.run({inputs_.pointers(), found_.pointers(), first_lane + lane,
                              varyings[std::size_t(lane)].data()});
            }
            glsl::quad_run.end_of_round();
        }
    }

    std::string compared() const {
        for (int v = 0; v < static_cast<int>(Value::count); ++v) {
            const auto value = static_cast<Value>(v);
            for (int slot = slot_of(value); slot < slot_of(value) + arrays_of(value); ++slot)
                for (int lane = 0; lane < compared_lanes; ++lane)
                    if (!is_same(value, slot, lane))
                        return std::string(info(value).name) + " of lane " + std::to_string(lane) +
                               ": " + std::to_string(found_.at(slot)[lane]) + " (" +
                               std::to_string(found_.integer(slot, lane)) + "), the stage has " +
                               std::to_string(expected_.at(slot)[lane]) + " (" +
                               std::to_string(expected_.integer(slot, lane)) + ")";
        }
        return {};
    }
    bool is_same(Value value, int slot, int lane) const {
        const float a = found_.at(slot)[lane], b = expected_.at(slot)[lane];
        if (info(value).kind == ValueKind::real && a != a && b != b) return true;
        return found_.integer(slot, lane) == expected_.integer(slot, lane);
    }

    void set_uniforms() const {
        const auto vector = [](const float(&v)[3]) { return glsl::vec3(v[0], v[1], v[2]); };
        triangles_.set_uniforms();
        glsl::eye = vector(frame_.eye);
        std::copy_n(frame_.eye_to_world, 9, glsl::eye_to_world);
        std::copy_n(frame_.projection, 16, glsl::projection);
        glsl::depth_scale = frame_.depth_scale;
        glsl::depth_offset = frame_.depth_offset;
        const LightUniforms &a = frame_.lights[0], &b = frame_.lights[1];
        glsl::light0_position = vector(a.position);
        glsl::light0_ambient = vector(a.ambient);
        glsl::light0_diffuse = vector(a.diffuse);
        glsl::light0_specular = vector(a.specular);
        glsl::light0_intensity = a.intensity;
        glsl::light0_constant = a.attenuation[0];
        glsl::light1_position = vector(b.position);
        glsl::light1_ambient = vector(b.ambient);
        glsl::light1_diffuse = vector(b.diffuse);
        glsl::light1_specular = vector(b.specular);
        glsl::light1_intensity = b.intensity;
        glsl::light1_constant = b.attenuation[0];
        glsl::light1_linear = b.attenuation[1];
        glsl::light1_quadratic = b.attenuation[2];
        const auto number = [&](TextureSlot slot, int i) {
            const TextureView& table = maps_.map(static_cast<int>(slot)).view;
            return table.texels[table.offset[2] + i];
        };
        glsl::ddm_map_depth = number(TextureSlot::ddm, 0);
        glsl::gdm_map_depth = number(TextureSlot::gdm, 0);
        glsl::vdm_map_depth = number(TextureSlot::vdm, 0);
        glsl::vdm_map_curvature = number(TextureSlot::vdm, 1);
    }

    test::Random random_;
    MaterialUniforms material_;
    RandomMaps maps_;
    FrameUniforms frame_;
    RandomTriangles triangles_;
    RandomShells shells_;
    SlotArrays inputs_, expected_, found_;
    SampledTexture bound_[texture_slot_count], nearest_;
};

TEST(Export, FunctionsHaveTheBitsOfTheirStages) {
    Comparison comparison(1);
    for (int i = 0; i < exported_count; ++i)
        EXPECT_EQ(comparison.difference(exported_functions[i]), "") << exported_functions[i].id;
}

/// A constant at a function's top is the parameter, wherever the text has it.
TEST(Export, ConstantsAreTheParameters) {
    Comparison comparison(2);
    int unlike = 0;
    for (int i = 0; i < edited_count; ++i) {
        const EditedFunction& edited = edited_functions[i];
        const std::span parameters(edited.parameters, static_cast<std::size_t>(edited.count));
        EXPECT_EQ(comparison.difference(edited.function, parameters), "") << edited.function.id;
        if (!comparison.difference(edited.function).empty()) ++unlike;
    }
    EXPECT_GT(edited_count, 50);
    // Without them most are other functions.
    EXPECT_GT(2 * unlike, edited_count);
}

/// Stages that compute at the vertices are compared as well. What shells are made of stands in the
/// vertices' place, in a table.
TEST(Export, VertexProgramsHaveFunctionsOfTheirOwn) {
    int vertex_programs = 0;
    for (int i = 0; i < exported_count; ++i) {
        const StageInfo& stage = *find_stage(exported_functions[i].id);
        const bool computes = stage.reads_vertices && !is_of_shells(stage.text.id);
        EXPECT_EQ(exported_functions[i].run_vertex != nullptr, computes) << stage.text.id;
        vertex_programs += computes;
    }
    EXPECT_GE(vertex_programs, 15);
}

TEST(Export, ErrorsOfAPrinterAreFound) {
    Comparison comparison(1);
    for (int i = 0; i < planted_count; ++i)
        EXPECT_NE(comparison.difference(planted_functions[i].function), "")
            << planted_functions[i].function.id << ": " << planted_functions[i].what;
}

}  // namespace
}  // namespace quadrel::export_tests
