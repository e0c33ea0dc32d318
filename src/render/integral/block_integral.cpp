#include "render/integral/block_integral.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/integral/pattern.hpp"

namespace quadrel {
namespace {

constexpr int replicates = IntegralOptions::replicates;

/// Errors are looked at after this many samples first, then each time that they have doubled:
/// seldom, since who stops at the first small estimate stops too soon.
constexpr int first_look = 4 * replicates;

bool is_look(const IntegralOptions& options, int samples) {
    return options.error > 0 && samples >= first_look && (samples & (samples - 1)) == 0;
}

}  // namespace

BlockIntegral::BlockIntegral(const IntegralOptions& options, const glm::vec4& background)
    : options_(options), background_{background.r, background.g, background.b, 0} {}

template <class Visit>
void BlockIntegral::for_each_quad(const Visit& visit) {
    auto quad = quads_.begin();
    for (int y = rect_.y0; y < rect_.y1; y += 2)
        for (int x = rect_.x0; x < rect_.x1; x += 2) visit(*quad++, x, y);
}

/// visit(index) for the pixels of a quad that are in the frame.
template <class Visit>
void BlockIntegral::for_each_pixel(int x, int y, const Visit& visit) const {
    for (int py = y; py < std::min(y + 2, rect_.y1); ++py)
        for (int px = x; px < std::min(x + 2, rect_.x1); ++px) visit(pixel_index(px, py));
}

void BlockIntegral::begin(const PixelRect& block) {
    rect_ = block;
    places_.reset(block);
    sample_ = 0;
    const auto pixels = std::size_t(block.width()) * std::size_t(block.height());
    constexpr double none = std::numeric_limits<double>::infinity();
    quads_.assign(std::size_t(block.width() + 1) / 2 * (std::size_t(block.height() + 1) / 2),
                  {0, true, {none, none, none, none}, {-none, -none, -none, -none}});
    shown_.assign(pixels, {});
    sums_.assign(pixels, {});
}

bool BlockIntegral::next() {
    if (sample_ == options_.samples) return false;
    const bool look = is_look(options_, sample_);
    bool any = false;
    for_each_quad([&](Quad& quad, int x, int y) {
        if (quad.drawn && look && is_enough(quad, x, y)) {
            quad.drawn = false;
            places_.leave_out(x, y);
        }
        if (!quad.drawn) return;
        any = true;
        places_.draw(x, y, sample_place(x, y, sample_));
    });
    if (any) ++sample_;
    return any;
}

void BlockIntegral::add(const Batch& batch, const QuadCoverage* quads) {
    constexpr int color = slot_of(Value::color);
    const bool has_color = batch.has(color);
    for (int lane = 0; lane < 4 * batch.quads(); ++lane) {
        const QuadCoverage& quad = quads[lane / 4];
        if (quad.samples[static_cast<std::size_t>(lane % 4)] == 0) continue;
        Components& shown = shown_[pixel_index(lane_x(quad, lane % 4), lane_y(quad, lane % 4))];
        for (int c = 0; has_color && c < 3; ++c) {
            const auto i = static_cast<std::size_t>(c);
            shown[i] = batch.number(color + c, lane) - background_[i];
        }
        shown[3] = 1;
    }
}

void BlockIntegral::end_sample() {
    const auto replicate = static_cast<std::size_t>((sample_ - 1) % replicates);
    for_each_quad([&](Quad& quad, int x, int y) {
        if (!quad.drawn) return;
        for_each_pixel(x, y, [&](std::size_t pixel) {
            for (std::size_t c = 0; c < 4; ++c) {
                const double value = shown_[pixel][c];
                sums_[pixel][replicate][c] += value;
                quad.low[c] = std::min(quad.low[c], value);
                quad.high[c] = std::max(quad.high[c], value);
            }
            shown_[pixel] = {};
        });
        ++quad.samples;
    });
}

void BlockIntegral::take_background() {
    const int samples =
        options_.error > 0 ? std::min(first_look, options_.samples) : options_.samples;
    for (Quad& quad : quads_) quad.samples = samples;
}

/// Mean and error of what the samples show less the background.
PixelIntegral BlockIntegral::difference(std::size_t pixel, int samples) const {
    PixelIntegral result;
    result.samples = samples;
    const double each = samples / replicates;
    for (std::size_t c = 0; c < 4; ++c) {
        double sum = 0, squares = 0;
        for (const Components& replicate : sums_[pixel]) sum += replicate[c];
        result.mean[c] = sum / samples;
        for (const Components& replicate : sums_[pixel]) {
            const double off = replicate[c] / each - result.mean[c];
            squares += off * off;
        }
        result.error[c] = std::sqrt(squares / (replicates - 1) / replicates);
    }
    return result;
}

/// Whether no error is above the stated one. What is not finite gets no better. A part of a pixel
/// that no sample has met has no spread: so large a part as one sample stands for may differ as
/// much as anything in the quad does.
bool BlockIntegral::is_enough(const Quad& quad, int x, int y) const {
    bool enough = true;
    for_each_pixel(x, y, [&](std::size_t pixel) {
        const PixelIntegral found = difference(pixel, quad.samples);
        for (std::size_t c = 0; c < 4; ++c) {
            const double unseen = (quad.high[c] - quad.low[c]) / quad.samples;
            enough = enough && !(std::max(found.error[c], unseen) > options_.error);
        }
    });
    return enough;
}

PixelIntegral BlockIntegral::pixel(int x, int y) const {
    const std::size_t columns = std::size_t(rect_.width() + 1) / 2;
    const std::size_t quad =
        std::size_t((y - rect_.y0) / 2) * columns + std::size_t((x - rect_.x0) / 2);
    PixelIntegral result = difference(pixel_index(x, y), quads_[quad].samples);
    for (std::size_t c = 0; c < 4; ++c) result.mean[c] += background_[c];
    return result;
}

}  // namespace quadrel
