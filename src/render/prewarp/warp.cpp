#include "render/prewarp/warp.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "bake/layout.hpp"
#include "quadrel/check.hpp"

namespace quadrel {
namespace {

constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

/// A texel on its way: where it comes from, and where it goes, in texels of the rectangle. NaN:
/// there is none.
struct Moving {
    double to_column = nowhere, to_row = nowhere;
    double u = 0, v = 0, s = 0;
};

Moving between(const Moving& a, const Moving& b, double t) {
    const auto mix = [&](double x, double y) { return x + t * (y - x); };
    return {mix(a.to_column, b.to_column), mix(a.to_row, b.to_row), mix(a.u, b.u), mix(a.v, b.v),
            mix(a.s, b.s)};
}

/// Warps one line: puts what is between two of its texels into the whole places that it covers, in
/// the order from either end towards the epipole, so that what is nearer to the eye comes later.
/// Where the line runs back it is seen from behind, and hidden.
class LineWarp {
  public:
    /// `place` is where texels go, in texels; `epipole` where the eye stands, likewise, infinite of
    /// parallel projections.
    LineWarp(double Moving::*place, double epipole) : place_(place), epipole_(epipole) {}

    template <class Put>
    void operator()(std::span<const Moving> line, const Put& put) const {
        const auto last = static_cast<std::ptrdiff_t>(line.size()) - 1;
        const auto middle = static_cast<std::ptrdiff_t>(
            std::clamp(std::floor(epipole_), 0.0, static_cast<double>(last)));
        for (std::ptrdiff_t i = 0; i < middle; ++i)
            fill(line[static_cast<std::size_t>(i)], line[static_cast<std::size_t>(i + 1)], 1,
                 line.size(), put);
        for (std::ptrdiff_t i = last; i > middle; --i)
            fill(line[static_cast<std::size_t>(i)], line[static_cast<std::size_t>(i - 1)], -1,
                 line.size(), put);
        if (line.size() == 1 && std::floor(line[0].*place_ + 0.5) == 0) put(0, line[0]);
    }

  private:
    template <class Put>
    void fill(const Moving& from, const Moving& to, int way, std::size_t places,
              const Put& put) const {
        // Rounding takes no place from a texel that stays where it is.
        constexpr double slack = 1e-6;
        const double a = way * from.*place_, b = way * to.*place_;
        if (!(b > a)) return;
        const double most = way > 0 ? static_cast<double>(places) - 1 : 0;
        const double least = way > 0 ? 0 : 1 - static_cast<double>(places);
        for (double at = std::max(std::ceil(a - slack), least); at <= std::min(b + slack, most);
             ++at)
            put(static_cast<std::size_t>(way * at), between(from, to, (at - a) / (b - a)));
    }

    double Moving::*place_;
    double epipole_;
};

class Prewarp {
  public:
    Prewarp(const HeightPlane& heights, const PrewarpRequest& request)
        : heights_(heights),
          request_(request),
          columns_(static_cast<std::size_t>(request.columns.count())),
          rows_(static_cast<std::size_t>(request.rows.count())) {}

    void run(Texture& texture) const {
        std::vector<Moving> half_way(columns_ * rows_);
        const LineWarp across(&Moving::to_column,
                              epipole(request_.eye.u, heights_.width, request_.columns.first));
        tbb::parallel_for(std::size_t(0), rows_, [&](std::size_t j) {
            std::vector<Moving> row;
            for (std::size_t i = 0; i < columns_; ++i) row.push_back(seen(i, j));
            across(row, [&](std::size_t column, const Moving& texel) {
                half_way[j * columns_ + column] = texel;
            });
        });
        const LineWarp along(&Moving::to_row,
                             epipole(request_.eye.v, heights_.height, request_.rows.first));
        float* const texels = texture.level_texels(0, 0);
        tbb::parallel_for(std::size_t(0), columns_, [&](std::size_t i) {
            std::vector<Moving> column;
            for (std::size_t j = 0; j < rows_; ++j) column.push_back(half_way[j * columns_ + i]);
            along(column, [&](std::size_t row, const Moving& texel) {
                float* const to = texels + 4 * (row * columns_ + i);
                to[0] = static_cast<float>(texel.u);
                to[1] = static_cast<float>(texel.v);
                to[2] = static_cast<float>(texel.s);
                to[3] = 1;
            });
        });
    }

  private:
    double epipole(double at, int texels, int first) const {
        if (!request_.eye.at_infinity) return at * texels - 0.5 - first;
        const double infinity = std::numeric_limits<double>::infinity();
        return at > 0 ? infinity : -infinity;
    }

    /// Texel (i, j) of the rectangle, and where the eye sees it in the plane.
    Moving seen(std::size_t i, std::size_t j) const {
        const int column = request_.columns.first + static_cast<int>(i);
        const int row = request_.rows.first + static_cast<int>(j);
        const double h = static_cast<double>(heights_.texel(column, row));
        Moving texel;
        texel.u = (column + 0.5) / heights_.width;
        texel.v = (row + 0.5) / heights_.height;
        texel.s = 1 - h;
        const EyeOverPlane& eye = request_.eye;
        const double q = (h - request_.seat) * request_.depth;
        const double below = eye.at_infinity ? eye.height : eye.height - q;
        if (!(below > 0)) return texel;
        // k1 = -u / height, k2 = -v / height of the eye, k3 = -1 / height; 0 at infinity.
        texel.to_column = (texel.u * eye.height - eye.u * q) / below * heights_.width - 0.5 -
                          request_.columns.first;
        texel.to_row = (texel.v * eye.height - eye.v * q) / below * heights_.height - 0.5 -
                       request_.rows.first;
        return texel;
    }

    const HeightPlane& heights_;
    const PrewarpRequest& request_;
    std::size_t columns_, rows_;
};

}  // namespace

std::shared_ptr<const Texture> prewarp(const HeightPlane& heights, const PrewarpRequest& request,
                                       const std::string& id) {
    const auto layout = make_layout(4, 1, {{request.columns.count(), request.rows.count() + 1}});
    QUADREL_CHECK(layout.has_value(), request.columns.count());
    const auto texture = std::make_shared<Texture>(*layout, TexelFormat::float32, id);
    float* const area = texture->level_texels(0, 0) +
                        std::size_t(4) * request.columns.count() * request.rows.count();
    area[0] = static_cast<float>(static_cast<double>(request.columns.first) / heights.width);
    area[1] = static_cast<float>(static_cast<double>(request.rows.first) / heights.height);
    area[2] = static_cast<float>(static_cast<double>(heights.width) / request.columns.count());
    area[3] = static_cast<float>(static_cast<double>(heights.height) / request.rows.count());
    if (request.eye.height > 0) Prewarp(heights, request).run(*texture);
    return texture;
}

}  // namespace quadrel
