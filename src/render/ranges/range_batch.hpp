// The quads of a batch once more, on ranges: quad by quad, and where decisions are open, lane by
// lane and way by way.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "quadrel/num/range/ranged.hpp"
#include "quadrel/raster/coverage.hpp"
#include "render/draw/batch.hpp"
#include "render/ranges/range_plan.hpp"

namespace quadrel {

/// What a number of a fragment may be.
struct FragmentRange {
    double low = 0, high = 0;
    std::uint32_t paths = 1;  ///< disjoint ranges; 0: more ways than are followed
    /// The widest gap between them; equal where there is none.
    double gap_low = 0, gap_high = 0;
};

/// What a lane's ways have come to.
struct LaneWays {
    std::array<FragmentRange, 2> hit;  ///< hit.uv of all of them
    bool kept = false, discarded = false;
};

/// One thread's.
class RangeBatch {
  public:
    /// Ways of a lane that are followed.
    static constexpr int most_ways = 16;
    /// Levels of detail of the height map that are taken at once; where a lane may have more than
    /// the second number of them, whole levels are.
    static constexpr double levels_at_once = 0.25, most_levels_apart = 3;

    static constexpr int quad_lanes = 4;

    explicit RangeBatch(const RangePlan& plan);

    /// Runs the stages over the quads that `drawn` has been loaded with. `call` comes with
    /// material, frame and textures set; bounds of heights in it are not used. `injected`: values
    /// that are known, whatever the stages would make of them; or null.
    void run(std::uint32_t material, const StageCall& call, const Batch& drawn,
             const QuadCoverage* quads, const Geometry& geometry,
             const InjectedValues* injected = nullptr);

    /// A channel of a lane of the batch.
    const FragmentRange& range(const ChannelSource& channel, int lane) const;
    /// A set of Undecided's bits.
    std::uint32_t undecided(int lane) const { return undecided_[static_cast<std::size_t>(lane)]; }
    /// Why a pixel is not certified; `proven` if it is.
    Uncertified uncertified(int lane) const { return uncertified_[static_cast<std::size_t>(lane)]; }

  private:
    /// Of a value's array; integers need less.
    static constexpr std::size_t array_bytes = quad_lanes * sizeof(Ranged);

    void prepare(const MaterialPlan& plan);
    void run_stages(const MaterialPlan& plan);
    void run_stage(const MaterialPlan& plan, std::size_t number);
    bool is_made_of_differences(const MaterialPlan& plan, std::size_t number) const;
    void run_along_rows_and_columns(const MaterialPlan& plan, std::size_t number);
    void take_known_frame(const PlannedStage& stage);
    bool is_made_at_the_hit(const MaterialPlan& plan, std::size_t number) const;
    void run_at_parts_of_the_place(const MaterialPlan& plan, std::size_t number);
    bool is_last_run_of(int lane) const;
    void narrow_to_parts(const PlannedStage& stage, int lane);
    template <class Take>
    void for_each_output(const PlannedStage& stage, std::vector<std::byte>& kept, const Take& take);
    void take_drawn(const PlannedStage& stage);
    void inject_after(const MaterialPlan& plan, std::size_t stage);
    void name_place();
    void run_quad(const MaterialPlan& plan, int quad, const QuadCoverage& coverage);
    void follow(const MaterialPlan& plan, int quad, int lane, const std::vector<double>& borders);
    bool follow_ways(const MaterialPlan& plan, int quad, int lane, int most);
    bool follow_levels(const MaterialPlan& plan, int quad, int lane, double from, double to);
    std::vector<double> level_borders(int lane) const;
    void record(int quad, int lane);
    void record_presence(LaneWays& ways, int lane) const;
    void give_up(int quad);
    void mark_coverage(const QuadCoverage& coverage);
    void mark_cells();
    void mark_presence();
    Uncertified certify(std::uint32_t material, const Batch& drawn, int lane) const;
    FragmentRange& result(std::size_t slot, int lane) {
        return results_[slot * batch_lanes + static_cast<std::size_t>(lane)];
    }

    const RangePlan& plan_;
    RangeContext* context_ = nullptr;
    const MaterialPlan* prepared_ = nullptr;
    StageCall call_{};
    MaterialUniforms material_{};
    const InjectedValues* injected_ = nullptr;
    const Batch* drawn_ = nullptr;
    const QuadCoverage* quad_ = nullptr;  ///< the one that runs
    int quad_number_ = 0;                 ///< in `drawn_`
    bool quad_known_ = false;             ///< all of its lanes are injected
    const std::vector<bool>* known_ = nullptr;
    std::vector<std::byte> memory_;
    std::vector<void*> values_;
    /// What the quad's frame has stored, an array after the other.
    struct Frame {
        std::vector<std::byte> arrays;
        bool known = false;                                ///< whatever the run
        std::int32_t shared_errors = 0, unit_vectors = 0;  ///< RangeContext's, behind it
    };
    Frame frame_;
    std::vector<std::byte> at_whole_, at_parts_;    ///< of a stage, likewise: wherever a hit may be
    std::vector<FragmentRange> results_;            ///< [slot of the plan][lane]
    std::vector<std::vector<FragmentRange>> ways_;  ///< of the followed lane: [slot of the plan]
    std::vector<std::size_t> through_;  ///< stages until it is written: [slot of the plan]
    std::size_t stages_run_ = 0;        ///< of the last run, until there were too many ways
    std::vector<std::uint32_t> undecided_;
    std::vector<Uncertified> uncertified_;
    std::optional<oracle::Surface> surface_;  ///< of the material that runs
    Discarding discarding_;                   ///< likewise
    std::array<LaneWays, 4> lanes_;           ///< of the quad
};

}  // namespace quadrel
