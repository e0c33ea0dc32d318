// Memory of one batch: 64 quads of one material, each planned value an array in quad order.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "quadrel/num/dual.hpp"
#include "quadrel/quad/shared_scales.hpp"
#include "quadrel/raster/quad_points.hpp"
#include "raster/placed.hpp"
#include "render/draw/geometry.hpp"
#include "render/draw/lane_bits.hpp"
#include "render/plan/plan.hpp"
#include "render/plan/shortcuts.hpp"
#include "render/probe/command.hpp"
#include "render/stats/stage_clock.hpp"

namespace quadrel {

class InjectedValues;

/// The arrays of a batch, for one type of element (float, double or Dual). One per thread, used
/// again and again; arrays are 64-byte aligned.
class Batch {
  public:
    /// `command`, if given, is what failed checks name. It must outlive the batch.
    explicit Batch(int scalar_bytes, const ProbeCommand* command = nullptr);

    /// Makes arrays for the plan's values; those of other values are null. Values that no stage
    /// of the plan produces are 0.
    void prepare(const MaterialPlan& plan);

    /// From now on these values take the place of what stages store, which then run one by one;
    /// null: none. They must stay.
    void inject(const InjectedValues* injected) { injected_ = injected; }

    /// Fills in up to batch_quads quads, which must stay until they have run, and pads with
    /// inactive ones to a whole packet. `runs`: quads of a triangle that lie side by side are
    /// filled in together.
    void load(const QuadCoverage* quads, int count, const Geometry& geometry, int samples,
              bool centroid, bool runs = false);
    /// The same at samples that lie anywhere in their pixels. Attributes are interpolated exactly.
    void load(const QuadCoverage* quads, int count, const Geometry& geometry,
              const QuadPlaces& places);

    /// Runs the plan's stages and checks what each stored. `call` comes with material, frame,
    /// textures and counters set. A `clock`, if given, times the stages. `shortcuts`: those that
    /// stages may take; arrays of values that no one outside of a chain reads are then undefined.
    void run(const MaterialPlan& plan, StageCall call, const Geometry& geometry,
             StageClock* clock = nullptr, const Shortcuts& shortcuts = no_shortcuts);

    /// What a call needs beside values, parameters and lanes, from a quad of the batch on.
    void point_to_quads(StageCall& call, const Geometry& geometry, int first_quad = 0) const;

    /// Runs a stage function on what the batch holds, storing `output` not there but in `to`, an
    /// array of batch_lanes elements of the batch's type for each of its components.
    void run_beside(StageFunction function, StageCall call, Value output, void* to) const;

    int scalar_bytes() const { return scalar_bytes_; }
    int quads() const { return quads_; }
    /// Sum over all lanes of the quads; 0 where the array is not there.
    std::uint64_t sum(int slot) const;
    /// The array that a channel's bits come from. The channel is a value or Z.
    LaneBits bits(const ChannelSource& source) const;
    float real(int slot, int lane) const;
    /// The same, unrounded.
    double number(int slot, int lane) const;
    /// number(slot, a) - number(slot, b), in the batch's number type.
    double difference(int slot, int a, int b) const;
    /// An element of a batch of duals.
    const Dual& dual(int slot, int lane) const {
        return static_cast<const Dual*>(values_[slot])[lane];
    }
    std::uint32_t integer(int slot, int lane) const {
        return static_cast<const std::uint32_t*>(values_[slot])[lane];
    }
    bool has(int slot) const { return values_[slot] != nullptr; }
    /// An element's bits, whatever its type, and back, for who keeps them. Not of batches of duals.
    std::uint64_t element(int slot, int lane) const;
    void set_element(int slot, int lane, std::uint64_t bits);

  private:
    struct Free {
        void operator()(std::byte* memory) const;
    };

    void begin_load(const QuadCoverage* quads, int count);
    void end_load(int count);
    void load_quad(const QuadCoverage& quad, int q, const Geometry& geometry,
                   const QuadPoints& points);
    void load_run(const QuadCoverage& quad, int q, int count, const Geometry& geometry);
    void load_slopes(const QuadCoverage* quads, const Geometry& geometry);
    void run_stages(const MaterialPlan& plan, std::size_t first, std::size_t end,
                    const StageCall& call, StageClock* clock);
    bool run_chains(const MaterialPlan& plan, StageCall call);
    void check_border(const PlannedStage& stage) const;
    void inject_after(const MaterialPlan& plan, std::size_t stage);

    int scalar_bytes_;
    const ProbeCommand* command_;
    const InjectedValues* injected_ = nullptr;
    const QuadCoverage* loaded_ = nullptr;
    int quads_ = 0, lanes_ = 0;
    std::unique_ptr<std::byte[], Free> memory_;
    std::size_t capacity_ = 0;
    std::vector<void*> values_, values_of_chains_;  ///< the latter: null where handed on locally
    std::vector<std::vector<ChainStage>> links_;    ///< per chain of the plan
    std::unique_ptr<SharedScales> scales_ = std::make_unique<SharedScales>();
    double* edges_[3]{};
    float* window_[2]{};
    std::int32_t* primitive_ = nullptr;
    std::uint32_t* active_ = nullptr;
    std::vector<EdgeSlopes> slopes_;  ///< per quad, for duals
};

}  // namespace quadrel
