// Sums over the samples of a block's pixels, their errors, and when they are enough.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "quadrel/render.hpp"
#include "raster/placed.hpp"
#include "render/draw/batch.hpp"

namespace quadrel {

/// What a pixel's samples come to. Of four components, R G B and coverage.
struct PixelIntegral {
    std::array<double, 4> mean{}, error{};  ///< the error: standard error of the mean
    int samples = 0;
};

/// Draws a block of pixels sample by sample:
///     begin(block); while (next()) { draw by places(); add(...)...; end_sample(); }
/// What a pixel gets depends on its quad alone, not on the block.
class BlockIntegral {
  public:
    BlockIntegral(const IntegralOptions& options, const glm::vec4& background);

    /// `block` is in window coordinates; it begins with whole quads, and what it cuts the frame
    /// does.
    void begin(const PixelRect& block);
    /// Chooses the places of another sample. False where no quad takes one.
    bool next();
    const QuadPlaces& places() const { return places_; }
    /// The fragments that the sample shows. Where there is none, it shows the background.
    void add(const Batch& batch, const QuadCoverage* quads);
    void end_sample();
    /// As if every sample showed the background, without drawing.
    void take_background();

    const PixelRect& rect() const { return rect_; }
    PixelIntegral pixel(int x, int y) const;

  private:
    using Components = std::array<double, 4>;

    struct Quad {
        int samples = 0;
        bool drawn = true;
        Components low, high;  ///< of all samples of its pixels
    };

    std::size_t pixel_index(int x, int y) const {
        return std::size_t(y - rect_.y0) * std::size_t(rect_.width()) + std::size_t(x - rect_.x0);
    }
    template <class Visit>
    void for_each_quad(const Visit& visit);
    template <class Visit>
    void for_each_pixel(int x, int y, const Visit& visit) const;
    bool is_enough(const Quad& quad, int x, int y) const;
    PixelIntegral difference(std::size_t pixel, int samples) const;

    IntegralOptions options_;
    Components background_;
    PixelRect rect_;
    QuadPlaces places_;
    int sample_ = 0;
    std::vector<Quad> quads_;
    std::vector<Components> shown_;  ///< by the sample, less the background
    std::vector<std::array<Components, IntegralOptions::replicates>> sums_;  ///< likewise, a pixel
};

}  // namespace quadrel
