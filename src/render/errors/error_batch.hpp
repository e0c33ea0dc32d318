// The quads of a batch once more with the judge's stages, and what err.* channels make of them.
#pragma once

#include <array>

#include "render/draw/batch.hpp"
#include "render/errors/error_plan.hpp"
#include "render/errors/judgement.hpp"
#include "render/errors/known_truths.hpp"

namespace quadrel {

/// One fragment's values: in a lane of a batch, or in a pixel of an image that was drawn elsewhere.
class JudgedValues;

/// The planes of an image by the arrays of values that they stand for; null: it has none.
class JudgedImage {
  public:
    /// The film must outlive it.
    explicit JudgedImage(const Film& film);

    const Film& film() const { return film_; }
    const Plane* plane(int slot) const { return planes_[static_cast<std::size_t>(slot)]; }
    const Plane* coverage() const { return coverage_; }

  private:
    const Film& film_;
    std::array<const Plane*, slot_count> planes_{};
    const Plane* coverage_;
};

/// One thread's. Its batches hold the same quads, lane by lane, as the one that is drawn.
class ErrorBatch {
  public:
    /// `image`: what is judged in the place of what is drawn, or null. `truths`: what is known
    /// from before, and gets what is found, or null.
    ErrorBatch(int scalar_bytes, const ProbeCommand* command, const JudgedImage* image,
               KnownTruths* truths);

    /// Runs the plan's stages over up to batch_quads quads. `call` comes with material, frame and
    /// textures set; all must stay until the last value is taken.
    void run(const ErrorPlan& plan, const StageCall& call, const QuadCoverage* quads, int count,
             const Geometry& geometry, int samples, bool centroid);

    /// The bits of an err.* channel in a lane of `drawn`, the batch of the same quads, at a pixel
    /// in image coordinates.
    std::uint32_t bits(const ChannelSource& channel, const Batch& drawn, int lane, int x,
                       int y) const;

  private:
    const Batch& batch(JudgedRun run) const { return batches_[static_cast<std::size_t>(run)]; }
    JudgedValues judged(ErrorPart part, const Batch& drawn, int lane, int x, int y) const;
    TrueHit true_hit(int lane) const;
    std::uint32_t integer(ErrorMeasure measure, const JudgedValues& values, int lane) const;
    double real(const ChannelSource& channel, const JudgedValues& values, int lane) const;
    double difference(Value v, int component, const JudgedValues& values, int lane) const;
    double degrees(const JudgedValues& values, int lane) const;
    double frame_error(const JudgedValues& values, int lane) const;

    std::array<Batch, judged_runs> batches_;
    std::array<const MaterialPlan*, judged_runs> prepared_{};  ///< the batches' arrays are theirs
    const ErrorPlan* plan_ = nullptr;
    const JudgedImage* image_;
    KnownTruths* truths_;
    StageCall call_{};
};

}  // namespace quadrel
