// Memory of one batch: 64 quads of one material, each planned value an array in quad order.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "quadrel/quad/stage.hpp"
#include "quadrel/raster/quad_points.hpp"
#include "render/geometry.hpp"
#include "render/plan.hpp"
#include "render/stage_clock.hpp"

namespace quadrel {

/// The arrays of a batch, for one scalar type (float or double). One per thread, used again and
/// again; arrays are 64-byte aligned.
class Batch {
  public:
    explicit Batch(int scalar_bytes);

    /// Makes arrays for the plan's values; those of other values are null. Values that no stage
    /// of the plan produces are 0.
    void prepare(const MaterialPlan& plan);

    /// Fills in up to batch_quads quads and pads with inactive ones to a whole packet.
    void load(const QuadCoverage* quads, int count, const Geometry& geometry, int samples,
              bool centroid);

    /// Runs the plan's stages. `call` comes with material, frame, textures and counters set. A
    /// `clock`, if given, times them.
    void run(const MaterialPlan& plan, StageCall call, const PrimitiveData* primitives,
             StageClock* clock = nullptr);

    int quads() const { return quads_; }
    /// The bits of lane `lane` of an array as float32 or uint32.
    std::uint32_t bits(const ChannelSource& source, int lane) const;
    float real(int slot, int lane) const;
    bool has(int slot) const { return values_[slot] != nullptr; }

  private:
    struct Free {
        void operator()(std::byte* memory) const;
    };

    int scalar_bytes_;
    int quads_ = 0, lanes_ = 0;
    std::unique_ptr<std::byte[], Free> memory_;
    std::size_t capacity_ = 0;
    std::vector<void*> values_;
    void* edges_[3]{};
    std::int32_t* primitive_ = nullptr;
    std::uint32_t* active_ = nullptr;
};

}  // namespace quadrel
