// The reduction of one mip level to the next, in double.
#pragma once

#include <algorithm>
#include <vector>

#include <tbb/parallel_for.h>

#include "quadrel/texture/format.hpp"

namespace quadrel {

/// A level of unrounded values, interleaved.
struct WideLevel {
    int width, height, channels;
    std::vector<double> values;

    double operator()(int x, int y, int c) const {
        return values[(static_cast<std::size_t>(y) * width + x) * channels + c];
    }
};

/// The mean of the 2x2 texels that start at (2x, 2y), clamped to the last: (a + b) + (c + d), then
/// a quarter. `source(x, y, c)` gives the finer level.
template <class Source>
double box_mean(const Source& source, int width, int height, int x, int y, int c) {
    const int x0 = std::min(2 * x, width - 1), x1 = std::min(2 * x + 1, width - 1);
    const int y0 = std::min(2 * y, height - 1), y1 = std::min(2 * y + 1, height - 1);
    return ((source(x0, y0, c) + source(x1, y0, c)) + (source(x0, y1, c) + source(x1, y1, c))) / 4;
}

/// The texels that destination texel i of `to` covers of an axis of `from` texels, in units where a
/// source texel is `to` long and a destination texel `from`.
struct Coverage {
    int first, last;

    Coverage(int i, int from, int to)
        : first(static_cast<int>(std::int64_t(i) * from / to)),
          last(static_cast<int>((std::int64_t(i + 1) * from - 1) / to)) {}
    static std::int64_t overlap(int texel, int i, int from, int to) {
        const std::int64_t low = std::max(std::int64_t(texel) * to, std::int64_t(i) * from);
        const std::int64_t high =
            std::min(std::int64_t(texel + 1) * to, std::int64_t(i + 1) * from);
        return high - low;
    }
};

/// The mean over the destination texel's area, row by row.
template <class Source>
double area_mean(const Source& source, int width, int height, const WideLevel& to, int x, int y,
                 int c) {
    const Coverage across(x, width, to.width), down(y, height, to.height);
    double sum = 0;
    for (int j = down.first; j <= down.last; ++j) {
        double row = 0;
        for (int i = across.first; i <= across.last; ++i) {
            row += static_cast<double>(Coverage::overlap(i, x, width, to.width)) * source(i, j, c);
        }
        sum += static_cast<double>(Coverage::overlap(j, y, height, to.height)) * row;
    }
    return sum / (static_cast<double>(width) * height);
}

/// The next level of a source of the given size: max(1, floor(n / 2)) texels a side.
template <class Source>
WideLevel reduce_level(const Source& source, int width, int height, int channels, MipRule rule) {
    WideLevel to{std::max(1, width / 2), std::max(1, height / 2), channels, {}};
    to.values.resize(static_cast<std::size_t>(to.width) * to.height * channels);
    const auto reduce_row = [&](int y) {
        double* out = &to.values[static_cast<std::size_t>(y) * to.width * channels];
        for (int x = 0; x < to.width; ++x) {
            for (int c = 0; c < channels; ++c) {
                *out++ = rule == MipRule::box ? box_mean(source, width, height, x, y, c)
                                              : area_mean(source, width, height, to, x, y, c);
            }
        }
    };
    tbb::parallel_for(0, to.height, reduce_row);
    return to;
}

}  // namespace quadrel
