// What a whole render computes, and what it need not: stages and textures of each material.
#pragma once

#include <optional>
#include <vector>

#include "bake/pyramid/height_maxima.hpp"
#include "quadrel/render.hpp"
#include "render/draw/geometry.hpp"
#include "render/errors/error_plan.hpp"
#include "render/plan/plan.hpp"
#include "render/plan/shortcuts.hpp"
#include "render/plan/textures.hpp"
#include "render/ranges/range_plan.hpp"

namespace quadrel {

class InjectedValues;
class JudgedImage;
class KnownTruths;

/// All that is settled before the first tile, but for geometry.
struct RenderPlan {
    HardwareModel hardware;
    const KernelTable* kernels = nullptr;
    std::string isa = "auto";  ///< by which name the kernels were asked for
    int scalar_bytes = 4;
    Shortcuts shortcuts;
    std::optional<IntegralOptions> integral;  ///< where pixels are integrals
    FrameUniforms frame{};
    std::vector<MaterialPlan> materials;  ///< per material of the scene
    std::vector<MaterialPlan> discard;    ///< what decides whether a fragment is kept
    std::vector<MaterialPlan> exact;      ///< what runs again on duals; empty where nothing asks
    std::vector<ErrorPlan> errors;        ///< what runs again for the judge; likewise
    std::shared_ptr<const JudgedImage> judged;       ///< that err.* judge; null: what is drawn
    KnownTruths* truths = nullptr;                   ///< what the judge has found before
    std::shared_ptr<const InjectedValues> injected;  ///< in the place of what stages store, or null
    RangePlan bounds, limits;                        ///< and on ranges
    std::vector<TexelsRead> texels_read;
    std::vector<MaterialTextures> textures;
    std::vector<MaterialUniforms> uniforms;
    /// Maxima of the height maps of those materials whose searches leave out steps by them.
    std::vector<std::shared_ptr<const OwnedMaxima>> maxima;
};

/// Plans every material, used or not, so that mistakes in the scene are found. Loads nothing:
/// `textures` are unbound. With `skip` off every stage of every material is planned, and
/// drawn without shortcuts. `limits`: as RenderOptions has it. `injected` may be null.
RenderPlan make_render_plan(const Scene& scene, const std::vector<ChannelSource>& channels,
                            const KernelTable& kernels, bool skip, const std::string& limits = "",
                            std::shared_ptr<const InjectedValues> injected = nullptr);

/// All that runs of a material, but for exact derivatives, which read no more than is drawn.
std::vector<const MaterialPlan*> plans_that_load(const RenderPlan& plan, std::size_t material);

/// The textures that these read.
SlotSet slots_read(const RenderPlan& plan, std::size_t material);

/// What the planned stages read of triangles.
GeometryParts parts_read(const RenderPlan& plan);

/// Whether steps of a material's searches may be left out: a stage knows how, and nothing asks how
/// many there are.
bool may_leave_out_steps(const MaterialPlan& plan);

/// Whether each material has a triangle in `area` (window coordinates).
std::vector<bool> used_materials(const Scene& scene, const Geometry& geometry,
                                 const PixelRect& area);

/// Loads the textures that the plan reads, of the materials in `used`, and measures the heights of
/// those whose stages leave out steps by them, for an image of so many pixels. Tells `baking` of
/// maps that are derived.
void load_plan_textures(const Scene& scene, const std::vector<bool>& used, RenderPlan& plan,
                        const BakingListener& baking, std::int64_t pixels);

/// The same plan, storing the step counts of the searches that it runs, too, which leave out no
/// step by bounds of parts of their map.
RenderPlan plan_with_steps(const RenderPlan& plan);

/// What a stage of that material is called with, but for values and parameters.
StageCall stage_call(const RenderPlan& plan, std::uint32_t material);

}  // namespace quadrel
