// Implementations that a budget permits, 64 at a time on one quad: its stages on float32, with
// errors put in between them.
//
// A varying is what exact interpolation gives, moved by its errors, rounded to a float that is
// still permitted. Look-ups of a stage are all off by the same part of a texel: what they start
// from is moved while it runs, and what it has found is moved back. Levels of detail are moved by
// longer or shorter gradients, heights by a factor. Arithmetic is float32's own, rounded to
// nearest.
//
// Stages that interpolate by themselves (vertex programs) do so without errors, and so have levels
// of look-ups whose gradients are not those of the undisplaced UV.
#pragma once

#include <span>
#include <vector>

#include "quadrel/raster/coverage.hpp"
#include "render/draw/batch.hpp"
#include "render/plan/render_plan.hpp"
#include "render/ranges/permitted_errors.hpp"

namespace quadrel {

class PermittedBatch {
  public:
    /// The plan is one of float kernels, whose materials store `bary`. Both must outlive it.
    PermittedBatch(const RenderPlan& plan, const Geometry& geometry, const ErrorBudget& budget);
    PermittedBatch(const PermittedBatch&) = delete;
    PermittedBatch& operator=(const PermittedBatch&) = delete;

    /// Runs the stages of the quad's material. Up to batch_quads implementations.
    void run(const QuadCoverage& quad, int samples, bool centroid,
             std::span<const PermittedErrors> implementations, const SharedChoices& shared);

    /// What an implementation of the last run has in a lane of the quad, in a slot that the plan
    /// has an array for (float values).
    float value(int slot, std::size_t implementation, int lane) const {
        return floats(slot)[4 * implementation + static_cast<std::size_t>(lane)];
    }

  private:
    class KeptValues;

    void prepare(std::uint32_t material);
    float* floats(int slot) const {
        return static_cast<float*>(values_[static_cast<std::size_t>(slot)]);
    }
    void snap_vertices();
    void interpolate(const PlannedStage& stage);
    void move_varying(int varying);
    void choose_differences();
    std::size_t lane_of_difference(int difference, std::size_t implementation,
                                   std::size_t lane) const;
    void stretch_gradients(const PlannedStage& stage);
    void move_heights();
    void move_decoded();
    void run_looking_up(const PlannedStage& stage, std::size_t number);
    std::vector<float> move_place(const PlannedStage& stage, std::size_t number, int slot,
                                  int axis);
    bool looks_up(const PlannedStage& stage) const;
    std::array<double, 2> texel_error(const PlannedStage& stage) const;

    const RenderPlan& plan_;
    const Geometry& geometry_;
    const ErrorBudget budget_;
    Batch placed_;  ///< for the edge functions alone
    const MaterialPlan* prepared_ = nullptr;
    std::uint32_t material_ = 0;
    std::vector<QuadCoverage> quads_;
    std::span<const PermittedErrors> implementations_;
    SharedChoices shared_;
    StageCall call_{};
    FrameUniforms frame_{};
    MaterialUniforms uniforms_{};
    std::vector<float> memory_;
    std::vector<void*> values_;
    std::vector<double> exact_memory_;  ///< what interpolation gives, before errors
    std::vector<void*> exact_;
    std::vector<double> edges_[3];
    /// A map with texels that are moved.
    struct MovedMap {
        const float* of = nullptr;  ///< the map's own
        std::vector<float> texels;
        SampledTexture map{};

        template <class Move>
        const SampledTexture* moved(const SampledTexture& from, const Move& move);
    };
    MovedMap heights_[2];  ///< a little lower, and higher
    std::array<std::array<MovedMap, texture_slot_count>, 2> decoded_;  ///< likewise
};

}  // namespace quadrel
