#include "texture/mip.hpp"

#include <algorithm>
#include <cstdint>

namespace quadrel {

namespace {

/// `right`: distance of the right one of two texels from the left one.
template <int Channels>
void box_of(const double* a, const double* b, int right, int count, double* out) {
    for (int x = 0; x < count; ++x, a += 2 * Channels, b += 2 * Channels, out += Channels)
        for (int c = 0; c < Channels; ++c)
            out[c] = ((a[c] + a[right + c]) + (b[c] + b[right + c])) / 4;
}

/// The texels that destination texel i of `to` covers of an axis of `from` texels, in units where a
/// source texel is `to` long and a destination texel `from`.
struct Coverage {
    int first, last;

    Coverage(int i, int from, int to)
        : first(static_cast<int>(std::int64_t(i) * from / to)),
          last(static_cast<int>((std::int64_t(i + 1) * from - 1) / to)) {}
    static double overlap(int texel, int i, int from, int to) {
        const std::int64_t low = std::max(std::int64_t(texel) * to, std::int64_t(i) * from);
        const std::int64_t high =
            std::min(std::int64_t(texel + 1) * to, std::int64_t(i + 1) * from);
        return static_cast<double>(high - low);
    }
};

/// Adds `weight` times the sums over each destination texel's part of the row.
void add_row(const double* row, double weight, int width, const WideLevel& to, double* sums) {
    for (int x = 0; x < to.width; ++x) {
        const Coverage across(x, width, to.width);
        for (int c = 0; c < to.channels; ++c) {
            double sum = 0;
            for (int i = across.first; i <= across.last; ++i)
                sum += Coverage::overlap(i, x, width, to.width) * row[i * to.channels + c];
            *sums++ += weight * sum;
        }
    }
}

}  // namespace

WideLevel::WideLevel(int w, int h, int c)
    : width(w),
      height(h),
      channels(c),
      values_(new double[static_cast<std::size_t>(w) * static_cast<std::size_t>(h) *
                         static_cast<std::size_t>(c)]) {}

void box_row(const double* upper, const double* lower, int width, WideLevel& to, int y) {
    const int right = width == 1 ? 0 : to.channels;
    double* const out = to.row(y);
    if (to.channels == 1)
        box_of<1>(upper, lower, right, to.width, out);
    else if (to.channels == 2)
        box_of<2>(upper, lower, right, to.width, out);
    else
        box_of<4>(upper, lower, right, to.width, out);
}

void area_row(const LevelRows& from, int width, int height, WideLevel& to, int y) {
    double* const out = to.row(y);
    const int count = to.width * to.channels;
    std::fill_n(out, count, 0.0);
    std::vector<double> scratch;
    const Coverage down(y, height, to.height);
    for (int j = down.first; j <= down.last; ++j)
        add_row(from.row(j, scratch), Coverage::overlap(j, y, height, to.height), width, to, out);
    const double area = static_cast<double>(width) * height;
    for (int i = 0; i < count; ++i) out[i] /= area;
}

}  // namespace quadrel
