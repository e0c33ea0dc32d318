// The quads of a batch once more, on dual numbers: exact window-space derivatives beside the finite
// differences that stages take.
#pragma once

#include <array>
#include <vector>

#include "render/draw/batch.hpp"
#include "render/exact/observed.hpp"

namespace quadrel {

/// One thread's. Its batch holds the same quads, lane by lane, as the one that is drawn.
class ExactBatch {
  public:
    explicit ExactBatch(const ProbeCommand* command = nullptr);

    /// Runs the plan's stages over up to batch_quads quads. `call` comes with material, frame and
    /// textures set; the textures must stay until the last derivative is taken.
    void run(const MaterialPlan& plan, const StageCall& call, const QuadCoverage* quads, int count,
             const Geometry& geometry, int samples, bool centroid);

    /// Makes what channels observe beside values, on duals and as it is drawn.
    void observe(const std::vector<ChannelSource>& channels, const Batch& drawn);

    /// The derivative of one component in window x (axis 0) or y (axis 1), per pixel, at the lane's
    /// evaluation point.
    double derivative(Value v, int component, int axis, int lane) const;

    /// What an exact channel holds in a lane; `drawn` is the batch of the same quads whose finite
    /// differences are judged.
    double value(const ChannelSource& channel, const Batch& drawn, int lane) const;

  private:
    /// On duals, and in the number type of what is drawn.
    struct Beside {
        std::vector<Dual> duals;
        std::vector<double> doubles;
        std::vector<float> floats;
    };

    void observe(Observed what, const Batch& drawn, Beside& beside) const;
    const Beside& beside(const ChannelSource& channel) const {
        return beside_[static_cast<std::size_t>(channel.observed)];
    }
    double exact(const ChannelSource& channel, int lane) const;
    double finite(const ChannelSource& channel, const Batch& drawn, int lane) const;
    double level_of_detail(const ChannelSource& channel, int lane) const;

    Batch batch_;
    const MaterialPlan* prepared_ = nullptr;  ///< the batch's arrays are this one's
    StageCall call_{};
    std::array<Beside, 3> beside_;  ///< by Observed
};

/// dFdx (axis 0) or dFdy (axis 1) of one component in a lane of a batch, in its number type.
double finite_difference(const Batch& batch, Value v, int component, int axis, DerivativeMode mode,
                         int lane);

}  // namespace quadrel
