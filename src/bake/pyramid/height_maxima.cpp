#include "bake/pyramid/height_maxima.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "bake/pyramid/row_loops.hpp"
#include "quadrel/relief/cells.hpp"

namespace quadrel {
namespace {

using namespace row_loops;

/// The texels of one axis in the order of its cells: two for each node, and one more. -1: the
/// border.
std::vector<int> texels_of_nodes(const GridAxis& cells, int texels, Wrap wrap) {
    std::vector<int> list(static_cast<std::size_t>((cells.count + 1) / 2) * 2 + 1);
    for (std::size_t i = 0; i < list.size(); ++i) {
        const int texel = cells.first + std::min(static_cast<int>(i), cells.count);
        list[i] =
            inside_level<float>(texel, texels, wrap) ? wrap_index<float>(texel, texels, wrap) : -1;
    }
    return list;
}

/// Rows of one mip level's heights in the order of its cells.
class LevelHeights {
  public:
    LevelHeights(const TextureView& view, int level, const SamplerState& sampler)
        : texels_(view.texels + view.offset[level]),
          channels_(view.channels),
          width_(view.width[level]),
          border_(known(sampler.border[0])),
          columns_(texels_of_nodes(cell_axis(width_, sampler.wrap_u), width_, sampler.wrap_u)),
          rows_(texels_of_nodes(cell_axis(view.height[level], sampler.wrap_v), view.height[level],
                                sampler.wrap_v)) {
        while (columns_[first_] != 0) ++first_;
        last_ = first_;
        while (last_ < columns_.size() && columns_[last_] == static_cast<int>(last_ - first_))
            ++last_;
    }

    /// Nodes of 2x2 cells.
    int width() const { return static_cast<int>(columns_.size() / 2); }
    int height() const { return static_cast<int>(rows_.size() / 2); }
    /// Heights in a row.
    std::size_t size() const { return columns_.size(); }

    /// Row i of the texels, 2 j to 2 j + 2 those of node row j.
    void row(int i, float* to) const {
        const int texel_row = rows_[static_cast<std::size_t>(i)];
        if (texel_row < 0) {
            std::fill_n(to, columns_.size(), border_);
            return;
        }
        const float* const from = texels_ + std::ptrdiff_t(texel_row) * width_ * channels_;
        for (std::size_t k = 0; k < first_; ++k) to[k] = height(from, columns_[k]);
        if (channels_ == 1)
            copy_known(from, last_ - first_, to + first_);
        else
            for (std::size_t k = first_; k < last_; ++k) to[k] = height(from, columns_[k]);
        for (std::size_t k = last_; k < columns_.size(); ++k) to[k] = height(from, columns_[k]);
    }

  private:
    float height(const float* row, int column) const {
        return column < 0 ? border_ : known(row[std::ptrdiff_t(column) * channels_]);
    }

    const float* texels_;
    int channels_, width_;
    float border_;
    std::vector<int> columns_, rows_;
    std::size_t first_ = 0, last_ = 0;  ///< columns between them are the texels in their order
};

/// Greatest heights and differences of the cells of a node row.
class NodeRow {
  public:
    explicit NodeRow(const LevelHeights& heights) : heights_(heights) {
        for (auto* row :
             {&a_, &b_, &c_, &highest_, &steepest_, &column_highest_, &column_steepest_})
            row->resize(heights.size());
    }

    void make(int j, float margin, float* maxima, float* slopes) {
        if (j == next_)
            std::swap(a_, c_);
        else
            heights_.row(2 * j, a_.data());
        heights_.row(2 * j + 1, b_.data());
        heights_.row(2 * j + 2, c_.data());
        next_ = j + 1;
        const std::size_t size = a_.size();
        reduce_sides(a_.data(), b_.data(), c_.data(), size, highest_.data(), steepest_.data());
        reduce_columns(a_.data(), b_.data(), c_.data(), highest_.data(), steepest_.data(), size - 1,
                       column_highest_.data(), column_steepest_.data());
        greater_of_pairs(column_highest_.data(), size / 2, margin, maxima);
        greater_of_pairs(column_steepest_.data(), size / 2, 0, slopes);
    }

  private:
    const LevelHeights& heights_;
    std::vector<float> a_, b_, c_, highest_, steepest_, column_highest_, column_steepest_;
    int next_ = -1;
};

/// What a look-up may be above all of its texels: a + t (b - a) is off by at most 5 units of 2^-24
/// of the largest magnitude, and there are three of them: x, y, level.
float rounding_of_filters(const Texture& map, const SamplerState& sampler) {
    const TextureView& view = map.view();
    const std::int64_t texels = std::int64_t(view.width[0]) * view.height[0];
    const auto largest_of = [&](const tbb::blocked_range<std::int64_t>& range, float largest) {
        const auto channels = static_cast<std::size_t>(view.channels);
        return greater(largest, largest_size(view.texels + range.begin() * view.channels,
                                             range.size(), channels));
    };
    const float border = std::fabs(sampler.border[0]);
    const float largest =
        tbb::parallel_reduce(tbb::blocked_range<std::int64_t>(0, texels, 1 << 16),
                             border < largest_height ? border : 0.0f, largest_of, greater);
    return std::max(largest * 0x1p-20f, 0x1p-22f);
}

TextureView layout_of(int width, int height) {
    TextureView view{};
    view.channels = view.faces = 1;
    std::int32_t offset = 0;
    for (;;) {
        view.width[view.levels] = width;
        view.height[view.levels] = height;
        view.offset[view.levels++] = offset;
        if (width == 1 && height == 1) return view;
        offset += width * height;
        width = (width + 1) / 2;
        height = (height + 1) / 2;
    }
}

/// Fills a level from the one before.
void reduce(Texture& nodes, int level) {
    const TextureView& view = nodes.view();
    const int width = view.width[level - 1], last_row = view.height[level - 1] - 1;
    for (int j = 0; j < view.height[level]; ++j) {
        const float* const a = nodes.level_texels(level - 1, 0) + std::ptrdiff_t(2 * j) * width;
        const float* const b = 2 * j < last_row ? a + width : a;
        float* const to = nodes.level_texels(level, 0) + std::ptrdiff_t(j) * view.width[level];
        greatest_of_blocks(a, b, static_cast<std::size_t>(width / 2), to);
        if (width % 2 != 0) to[width / 2] = greater(a[width - 1], b[width - 1]);
    }
}

/// For each texel of an axis of the slopes: which nodes of 2x2 cells lie in its 4 cells or up to
/// two cells away from them.
std::vector<std::vector<int>> nodes_near(const GridAxis& cells) {
    const int nodes = (cells.count + 1) / 2;
    // Across the seam a last node of one cell does not reach far enough.
    const int reach = cells.periodic && cells.count % 2 != 0 ? 2 : 1;
    std::vector<std::vector<int>> near(static_cast<std::size_t>((nodes + 1) / 2));
    for (int i = 0; i < static_cast<int>(near.size()); ++i)
        for (int node = 2 * i - reach; node <= 2 * i + 1 + reach; ++node)
            near[static_cast<std::size_t>(i)].push_back(
                cells.periodic ? (node % nodes + nodes) % nodes : std::clamp(node, 0, nodes - 1));
    return near;
}

/// Rows of the slopes, from those of 2x2 cells.
class SlopeRows {
  public:
    SlopeRows(const float* fine, std::size_t fine_width,
              const std::vector<std::vector<int>>& columns)
        : fine_(fine), greatest_(fine_width), columns_(columns) {}

    /// From rows `rows`.
    void make(const std::vector<int>& rows, float* to) {
        std::fill(greatest_.begin(), greatest_.end(), 0.0f);
        for (const int row : rows)
            raise_to(fine_ + static_cast<std::size_t>(row) * greatest_.size(), greatest_.size(),
                     greatest_.data());
        // Of all but the first texels and the last, four nodes side by side.
        const std::size_t side = 2, count = columns_.size();
        if (count > 2 * side)
            greatest_of_fours(greatest_.data() + 2 * side, count - 2 * side, to + side);
        for (std::size_t i = 0; i < count; ++i)
            if (count <= 2 * side || i < side || i >= count - side) to[i] = greatest_near(i);
    }

  private:
    float greatest_near(std::size_t i) const {
        float greatest = 0;
        for (const int column : columns_[i])
            greatest = greater(greatest, greatest_[static_cast<std::size_t>(column)]);
        return greatest;
    }

    const float* fine_;
    std::vector<float> greatest_;
    const std::vector<std::vector<int>>& columns_;
};

/// Calls `row(j)` or the like for chunks of rows in parallel: `rows(first, end)`.
template <class Rows>
void in_chunks(int count, const Rows& rows) {
    tbb::parallel_for(
        tbb::blocked_range<int>(0, count, 32),
        [&](const tbb::blocked_range<int>& chunk) { rows(chunk.begin(), chunk.end()); });
}

std::shared_ptr<const Texture> make_slopes(const float* fine, std::size_t fine_width,
                                           const Grid& cells, const std::string& id) {
    const auto columns = nodes_near(cells.u), rows = nodes_near(cells.v);
    TextureView layout = layout_of(static_cast<int>(columns.size()), static_cast<int>(rows.size()));
    layout.levels = 1;
    const auto slopes = std::make_shared<Texture>(layout, TexelFormat::float32, id);
    in_chunks(layout.height[0], [&](int first, int end) {
        SlopeRows row(fine, fine_width, columns);
        for (int j = first; j < end; ++j)
            row.make(rows[static_cast<std::size_t>(j)],
                     slopes->level_texels(0, 0) + std::ptrdiff_t(j) * layout.width[0]);
    });
    return slopes;
}

/// Nodes and slopes of one mip level.
struct LevelTextures {
    std::shared_ptr<const Texture> nodes, slopes;
};

LevelTextures make_level(const Texture& map, int level, const SamplerState& sampler, float margin,
                         const std::string& id) {
    const LevelHeights heights(map.view(), level, sampler);
    const Grid cells = cell_grid(map.view().width[level], map.view().height[level], sampler);
    const auto width = static_cast<std::size_t>(heights.width());
    const auto nodes = std::make_shared<Texture>(layout_of(heights.width(), heights.height()),
                                                 TexelFormat::float32, id);
    // Left as it is: threads are to touch what they fill.
    const std::unique_ptr<float[]> fine(
        new float[width * static_cast<std::size_t>(heights.height())]);
    in_chunks(heights.height(), [&](int first, int end) {
        NodeRow row(heights);
        for (int j = first; j < end; ++j)
            row.make(j, margin, nodes->level_texels(0, 0) + static_cast<std::size_t>(j) * width,
                     fine.get() + static_cast<std::size_t>(j) * width);
    });
    for (int i = 1; i < nodes->view().levels; ++i) reduce(*nodes, i);
    return {nodes, make_slopes(fine.get(), width, cells, id + " slopes")};
}

LevelMaxima level_view(const TextureView& map, int level, const SamplerState& sampler,
                       const LevelTextures& textures) {
    const int width = map.width[level], height = map.height[level];
    const Grid cells = cell_grid(width, height, sampler);
    return {textures.nodes->view(), textures.slopes->view(), width,         height,
            cells.u.first,          cells.v.first,           cells.u.count, cells.v.count,
            cells.u.periodic,       cells.v.periodic};
}

/// Equal for samplers under which a map's bounds are the same.
std::string id_of(const Texture& map, const SamplerState& sampler, int level) {
    std::string id =
        fmt::format("maxima {} of {} {} {}", level, map.id(), static_cast<int>(sampler.wrap_u),
                    static_cast<int>(sampler.wrap_v));
    if (has_border(sampler))
        id += fmt::format(" {:x}", std::bit_cast<std::uint32_t>(sampler.border[0]));
    return id;
}

}  // namespace

std::size_t OwnedMaxima::bytes() const {
    std::size_t floats = 0;
    for (const auto& texture : textures) {
        const TextureView& view = texture->view();
        const int last = view.levels - 1;
        floats += static_cast<std::size_t>(view.offset[last]) +
                  static_cast<std::size_t>(view.width[last]) *
                      static_cast<std::size_t>(view.height[last]);
    }
    return floats * sizeof(float);
}

std::shared_ptr<const OwnedMaxima> height_maxima(const Texture& map, const SamplerState& sampler) {
    struct Known {
        std::weak_ptr<const Texture> nodes, slopes;
        float rounding;
    };
    static std::mutex mutex;
    static std::map<std::string, Known> known;
    const TextureView& view = map.view();
    if (view.faces != 1) return nullptr;
    auto maxima = std::make_shared<OwnedMaxima>();
    HeightMaxima& all = maxima->maxima;
    all.levels = sampler.mip == MipFilter::none ? 1 : view.levels;
    all.slack = sampler.weight_bits > 0 ? std::ldexp(1.0f, -sampler.weight_bits) : 0;
    all.continuous =
        sampler.mag == Filter::linear && sampler.min == Filter::linear && sampler.weight_bits == 0;
    const auto start = std::chrono::steady_clock::now();
    const std::lock_guard lock(mutex);
    std::erase_if(known, [](const auto& entry) { return entry.second.nodes.expired(); });
    const auto finest = known.find(id_of(map, sampler, 0));
    all.rounding =
        finest != known.end() ? finest->second.rounding : rounding_of_filters(map, sampler);
    for (int level = 0; level < all.levels; ++level) {
        const std::string id = id_of(map, sampler, level);
        LevelTextures textures{known[id].nodes.lock(), known[id].slopes.lock()};
        if (!textures.nodes || !textures.slopes) {
            textures = make_level(map, level, sampler, all.rounding, id);
            known[id] = {textures.nodes, textures.slopes, all.rounding};
            ++maxima->made;
        }
        all.level[level] = level_view(view, level, sampler, textures);
        maxima->textures.push_back(std::move(textures.nodes));
        maxima->textures.push_back(std::move(textures.slopes));
    }
    maxima->wall_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return maxima;
}

}  // namespace quadrel
