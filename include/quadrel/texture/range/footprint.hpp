// What a filtered look-up may give anywhere in a range of coordinates: the least and the greatest
// of the patches that are met. A bilinear patch over a rectangle has both at corners.
#pragma once

#include "quadrel/num/range/geometry.hpp"
#include "quadrel/texture/sampler.hpp"

namespace quadrel::range_detail {

/// All four channels of a texel or of a filtered value, missing ones as samplers expand them.
struct TexelRange {
    RealInterval channel[4];

    static TexelRange nothing() {
        constexpr double most = std::numeric_limits<double>::infinity();
        const RealInterval none(most, -most);
        return {{none, none, none, none}};
    }
    void include(const double (&value)[4]) {
        for (int c = 0; c < 4; ++c) {
            // What is no number may spoil its neighbours, or not.
            const bool finite = std::fabs(value[c]) <= std::numeric_limits<float>::max();
            constexpr double most = std::numeric_limits<double>::infinity();
            channel[c].lo = std::min(channel[c].lo, finite ? value[c] : -most);
            channel[c].hi = std::max(channel[c].hi, finite ? value[c] : most);
        }
    }
    void include(const TexelRange& other) {
        for (int c = 0; c < 4; ++c) channel[c] = hull(channel[c], other.channel[c]);
    }
};

struct TexelValue {
    double channel[4];
};

/// What a texel of one's own index may be: patches are few, whole maps are looked through once.
inline constexpr double most_patches = 64, most_texels = 256;

/// A range of texel coordinates along an axis (centres at .5), with what the sampler is off by.
inline RealInterval texel_coordinates(const RealInterval& u, std::int32_t size,
                                      const SamplerState& sampler) {
    const ErrorBudget& errors = budget();
    const RealInterval x = u * RealInterval(size);
    double off = errors.address + x.magnitude() * (errors.unit > 0 ? 0x1p-22 : 0x1p-50);
    if (sampler.weight_bits > 0) off += std::ldexp(0.5, -sampler.weight_bits);
    return widened(x, off);
}

/// The texel that index i stands for, and whether it is one (or the border).
struct AxisTexel {
    std::int32_t index;
    bool inside;
};
inline AxisTexel axis_texel(double i, std::int32_t size, Wrap wrap) {
    const double period = wrap == Wrap::mirrored_repeat ? 2.0 * size : size;
    const double reduced = is_periodic(wrap) ? i - period * std::floor(i / period) : i;
    const auto index = static_cast<std::int32_t>(std::clamp(reduced, -0x1p30, 0x1p30));
    return {wrap_index<double>(index, size, wrap), inside_level<double>(index, size, wrap)};
}

/// One level of a two-dimensional map, or of a face of a cube map.
class LevelTexels {
  public:
    LevelTexels(const SampledTexture& texture, int level, int face = 0)
        : sampler_(texture.sampler),
          channels_(texture.view.channels),
          width_(texture.view.width[level]),
          height_(texture.view.height[level]),
          texels_(texture.view.texels + texture.view.offset[level] +
                  std::int64_t{face} * width_ * height_ * channels_) {}

    TexelValue at(double i, double j) const {
        const AxisTexel x = axis_texel(i, width_, sampler_.wrap_u);
        const AxisTexel y = axis_texel(j, height_, sampler_.wrap_v);
        TexelValue value{{0, 0, 0, 1}};
        const float* texel =
            texels_ + std::int64_t{channels_} * (std::int64_t{y.index} * width_ + x.index);
        for (int c = 0; c < channels_; ++c)
            value.channel[c] = x.inside && y.inside ? texel[c] : sampler_.border[c];
        return value;
    }
    std::int32_t width() const { return width_; }
    std::int32_t height() const { return height_; }
    const SamplerState& sampler() const { return sampler_; }

  private:
    const SamplerState& sampler_;
    std::int32_t channels_, width_, height_;
    const float* texels_;
};

/// The patch with its lower corner at texel (i, j), over weights in x and y.
template <class Texels>
void include_patch(TexelRange& range, const Texels& level, double i, double j,
                   const RealInterval& x, const RealInterval& y) {
    const TexelValue taps[4] = {level.at(i, j), level.at(i + 1, j), level.at(i, j + 1),
                                level.at(i + 1, j + 1)};
    for (const double t : {x.lo, x.hi})
        for (const double s : {y.lo, y.hi}) {
            double value[4];
            for (int c = 0; c < 4; ++c) {
                const double top =
                    taps[0].channel[c] + t * (taps[1].channel[c] - taps[0].channel[c]);
                const double low =
                    taps[2].channel[c] + t * (taps[3].channel[c] - taps[2].channel[c]);
                value[c] = top + s * (low - top);
            }
            range.include(value);
        }
}

/// Every texel with indices in these ranges.
template <class Texels>
void include_texels(TexelRange& range, const Texels& level, const RealInterval& x,
                    const RealInterval& y) {
    for (double j = y.lo; j <= y.hi; ++j)
        for (double i = x.lo; i <= x.hi; ++i) range.include(level.at(i, j).channel);
}

/// The part of a range that lies in the unit from i on, as a weight.
inline RealInterval weights_in(const RealInterval& x, double i) {
    return {std::max(x.lo, i) - i, std::min(x.hi, i + 1) - i};
}

/// All that linear filtering of a level may give; false if that is too much to look through.
template <class Texels>
bool include_linear(TexelRange& range, const Texels& level, const RealInterval& x,
                    const RealInterval& y) {
    const RealInterval column(std::floor(x.lo - 0.5), std::floor(x.hi - 0.5));
    const RealInterval row(std::floor(y.lo - 0.5), std::floor(y.hi - 0.5));
    const double patches = (column.width() + 1) * (row.width() + 1);
    if (!(patches <= most_texels)) return false;
    if (patches > most_patches) {
        include_texels(range, level, {column.lo, column.hi + 1}, {row.lo, row.hi + 1});
        return true;
    }
    const RealInterval centred_x(x.lo - 0.5, x.hi - 0.5), centred_y(y.lo - 0.5, y.hi - 0.5);
    for (double j = row.lo; j <= row.hi; ++j)
        for (double i = column.lo; i <= column.hi; ++i)
            include_patch(range, level, i, j, weights_in(centred_x, i), weights_in(centred_y, j));
    return true;
}
template <class Texels>
bool include_nearest(TexelRange& range, const Texels& level, const RealInterval& x,
                     const RealInterval& y) {
    const RealInterval column(std::floor(x.lo), std::floor(x.hi)),
        row(std::floor(y.lo), std::floor(y.hi));
    if (!((column.width() + 1) * (row.width() + 1) <= most_texels)) return false;
    include_texels(range, level, column, row);
    return true;
}

/// With what filters are off by.
inline TexelRange filtered(TexelRange range) {
    const ErrorBudget& errors = budget();
    const double part = errors.filtered + (errors.unit > 0 ? 4 * errors.unit : 0x1p-48);
    for (RealInterval& channel : range.channel)
        channel = widened(channel, part * channel.magnitude());
    return range;
}

}  // namespace quadrel::range_detail
