// Pyramids of bounds: nodes of 2x2, sizes rounded up, to 1x1.
#pragma once

#include <algorithm>

#include "bake/job.hpp"

namespace quadrel {

/// Sizes of all levels over a grid.
inline std::vector<LevelSize> pyramid_sizes(const Grid& grid) {
    std::vector<LevelSize> sizes{{grid.u.count, grid.v.count}};
    while (sizes.back() != LevelSize(1, 1)) {
        const auto [width, height] = sizes.back();
        sizes.emplace_back((width + 1) / 2, (height + 1) / 2);
    }
    return sizes;
}

/// NaN if either is, so that a bound over a broken map says so. (Objects, not functions, so that
/// each caller has its own code.)
inline constexpr auto max_or_nan = [](float a, float b) { return b > a || b != b ? b : a; };
inline constexpr auto min_or_nan = [](float a, float b) { return b < a || b != b ? b : a; };
/// max_or_nan where neither is NaN: loops of it become vector instructions.
inline constexpr auto max_of_numbers = [](float a, float b) { return b > a ? b : a; };

bool has_nan(const HeightPlane& plane);

/// Calls fill(reduce) with the quickest that is max_or_nan for the plane's heights.
template <class Fill>
void with_max_of(const HeightPlane& plane, const Fill& fill) {
    if (has_nan(plane))
        fill(max_or_nan);
    else
        fill(max_of_numbers);
}

/// Channel c of a row of `count` values, one after the other where there is but one channel.
template <class Value>
void fill_row(float* row, int count, int channels, int c, const Value& value) {
    if (channels == 1)
        for (int i = 0; i < count; ++i) row[i] = value(i);
    else
        for (int i = 0; i < count; ++i) row[std::ptrdiff_t(i) * channels + c] = value(i);
}

/// Calls row(j) for 0 <= j < count, a block of them after another in each thread: what is told of
/// each row would take longer than the row.
template <class Row>
void rows_by_blocks(const BakeJob& job, int count, double share, const Row& row) {
    constexpr int block = 16;
    job.rows((count + block - 1) / block, share, [&](int b) {
        const int end = std::min((b + 1) * block, count);
        for (int j = b * block; j < end; ++j) row(j, j == b * block);
    });
}

/// Fills channel c of levels 1 and above of a pyramid with the `reduce` of each node's children.
template <class Reduce>
void reduce_pyramid(const BakeJob& job, double share, Texture& pyramid, int c,
                    const Reduce& reduce) {
    const TextureView& view = pyramid.view();
    const int channels = view.channels;
    for (int level = 1; level < view.levels; ++level) {
        const float* const from = pyramid.level_texels(level - 1, 0);
        float* const to = pyramid.level_texels(level, 0);
        const int width = view.width[level - 1], last_row = view.height[level - 1] - 1;
        const std::ptrdiff_t row_floats = std::ptrdiff_t(width) * channels;
        rows_by_blocks(job, view.height[level], share / view.levels, [&](int y, bool) {
            const float* const a = from + 2 * y * row_floats;
            const float* const b = from + std::min(2 * y + 1, last_row) * row_floats;
            float* const out = to + std::ptrdiff_t(y) * view.width[level] * channels;
            const auto node = [&](std::ptrdiff_t i, std::ptrdiff_t k) {
                return reduce(reduce(a[i], a[k]), reduce(b[i], b[k]));
            };
            if (channels == 1)
                for (int x = 0; x < width / 2; ++x) out[x] = node(2 * x, 2 * x + 1);
            else
                for (int x = 0; x < width / 2; ++x)
                    out[x * channels + c] =
                        node((2 * x) * channels + c, (2 * x + 1) * channels + c);
            if (width % 2 == 0) return;
            const std::ptrdiff_t last = row_floats - channels + c;
            out[std::ptrdiff_t(width / 2) * channels + c] = node(last, last);
        });
    }
}

/// Rows of a plane's texels in the order of its cells, one texel more than cells.
class RowsOfCells {
  public:
    RowsOfCells(const HeightPlane& plane, const Grid& cells) : plane_(plane), cells_(cells) {
        const int first = cells.u.first, end = first + cells.u.count + 1;
        inner_ = std::max(first, plane.grid.u.first);
        inner_end_ = std::min(end, plane.grid.u.first + plane.grid.u.count);
    }
    /// The texels of row y of the plane.
    void read(int y, float* to) const {
        const int first = cells_.u.first, end = first + cells_.u.count + 1;
        for (int x = first; x < inner_; ++x) *to++ = plane_.texel(x, y);
        to = std::copy_n(&plane_.heights[plane_.index(inner_, y)], inner_end_ - inner_, to);
        for (int x = inner_end_; x < end; ++x) *to++ = plane_.texel(x, y);
    }

  private:
    const HeightPlane& plane_;
    Grid cells_;
    int inner_, inner_end_;  ///< texels that are stored side by side
};

/// Fills channel c of level 0 with the `reduce` of the corners of each stored dual cell.
template <class Reduce>
void reduce_cells(const BakeJob& job, double share, Texture& pyramid, int c, const Reduce& reduce) {
    const HeightPlane& plane = job.plane;
    const Grid cells = cell_grid(plane.width, plane.height, job.sampler);
    const RowsOfCells rows(plane, cells);
    const int channels = pyramid.view().channels, count = cells.u.count;
    const auto size = static_cast<std::size_t>(count);
    float* const to = pyramid.level_texels(0, 0);
    rows_by_blocks(job, cells.v.count, share, [&](int j, bool first) {
        thread_local std::vector<float> texels, above, below;
        for (auto* const row : {&texels, &above, &below}) row->resize(size + 1);
        const auto pairs = [&](int y, std::vector<float>& row) {
            rows.read(y, texels.data());
            const float* const t = texels.data();
            fill_row(row.data(), count, 1, 0, [&](int i) { return reduce(t[i], t[i + 1]); });
        };
        if (first)
            pairs(cells.v.first + j, above);
        else
            std::swap(above, below);
        pairs(cells.v.first + j + 1, below);
        const float *const a = above.data(), *const b = below.data();
        fill_row(to + std::ptrdiff_t(j) * count * channels, count, channels, c,
                 [&](int i) { return reduce(a[i], b[i]); });
    });
}

/// The max-mip map, also what other generators search.
std::shared_ptr<Texture> cell_max_pyramid(const BakeJob& job, double share);
/// The texel-max map.
std::shared_ptr<Texture> texel_max_pyramid(const BakeJob& job, double share);

}  // namespace quadrel
