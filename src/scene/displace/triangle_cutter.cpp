#include "scene/displace/triangle_cutter.hpp"

#include <algorithm>
#include <cmath>

#include "quadrel/check.hpp"
#include "scene/displace/chart.hpp"
#include "scene/displace/interior.hpp"

namespace quadrel::displacement {
namespace {

/// The longest side of a triangle, along one of the axes.
class LongestSide {
  public:
    explicit LongestSide(const Corners& place) : place_(place) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Place d = place[(k + 1) % 3] - place[k];
            for (const bool x : {true, false})
                if (const std::int64_t size = std::abs(x ? d.x : d.y); size > span_) {
                    span_ = size;
                    number_ = k;
                    by_x_ = x;
                }
        }
    }

    std::size_t number() const { return number_; }
    /// How far along it a corner lies: 0 where it begins, 1 where it ends.
    double at(std::size_t corner) const {
        const Place d = place_[corner % 3] - place_[number_];
        return span_ == 0 ? 0.0 : std::fabs(double(by_x_ ? d.x : d.y)) / double(span_);
    }

  private:
    const Corners& place_;
    std::size_t number_ = 0;
    bool by_x_ = true;
    std::int64_t span_ = -1;
};

/// A vertex on a triangle's border, and how far along the longest side.
struct BorderVertex {
    std::uint32_t vertex;
    double at;
};

/// One triangle of the mesh, cut along the cells.
class TriangleCutter {
  public:
    TriangleCutter(const Base& base, const Edges& edges, const Lattice& lattice, std::size_t t,
                   Facets& facets)
        : base_(base), edges_(edges), lattice_(lattice), t_(t), chart_(base, t), facets_(facets) {
        for (std::size_t k = 0; k < 3; ++k) {
            sides_[k] = chart_.side(edges, t, k);
            corners_[k] = base.mesh.triangles[t][chart_.corner[k]];
        }
    }

    void cut() {
        first_own_ = facets_.begin();
        if (chart_.degenerate) {
            cut_degenerate();
        } else {
            add_interior();
            const auto [low, high] =
                std::minmax({chart_.place[0].y, chart_.place[1].y, chart_.place[2].y});
            for (std::int64_t j = floor_cell(low); j <= floor_cell(high - 1); ++j) cut_row(j);
        }
        facets_.end();
    }

  private:
    void add_interior() {
        interior_ = InteriorPoints(chart_.place, first_own_);
        for (std::int64_t j = interior_.first_row(); j <= interior_.last_row(); ++j) {
            const InteriorRow& row = interior_.row(j);
            for (std::int64_t i = row.low; i <= row.high; ++i)
                facets_.add_own(lattice_vertex(i, j));
        }
    }
    Vertex lattice_vertex(std::int64_t i, std::int64_t j) const {
        const Corners& p = chart_.place;
        const Place at{i * one, j * one};
        const double all = static_cast<double>(side_of(p[0], p[1], p[2]));
        const double b = static_cast<double>(side_of(p[2], p[0], at)) / all;
        const double c = static_cast<double>(side_of(p[0], p[1], at)) / all;
        const Vertex &v0 = facets_.vertex(corners_[0]), &v1 = facets_.vertex(corners_[1]),
                     &v2 = facets_.vertex(corners_[2]);
        const auto mixed = [&](const auto& x0, const auto& x1, const auto& x2) {
            return x0 + (x1 - x0) * b + (x2 - x0) * c;
        };
        return {mixed(v0.point, v1.point, v2.point), mixed(v0.normal, v1.normal, v2.normal),
                base_.offset(lattice_.at(i, j)), mixed(v0.uv, v1.uv, v2.uv)};
    }

    /// Cells between rows j and j + 1: whole ones at once, those at the border by their halves.
    void cut_row(std::int64_t j) {
        const auto [first, last] = columns(j);
        const InteriorRow &below = interior_.row(j), &above = interior_.row(j + 1);
        for (std::int64_t i = first; i <= last; ++i) {
            const bool main = lattice_.has_main_diagonal(i, j);
            if (below.holds(i) && below.holds(i + 1) && above.holds(i) && above.holds(i + 1)) {
                add_cell(
                    {below.number(i), below.number(i + 1), above.number(i + 1), above.number(i)},
                    main);
                continue;
            }
            for (const bool upper : {false, true})
                add_polygon(within(half_cell(i, j, main, upper), chart_.place));
        }
    }

    /// Of the cells that the triangle may meet there, and little more.
    std::pair<std::int64_t, std::int64_t> columns(std::int64_t j) const {
        double low = 0x1p60, high = -0x1p60;
        const auto take = [&](double x) {
            low = std::min(low, x);
            high = std::max(high, x);
        };
        for (std::size_t k = 0; k < 3; ++k) {
            const Place &a = chart_.place[k], &b = chart_.place[(k + 1) % 3];
            if (a.y >= j * one && a.y <= (j + 1) * one) take(double(a.x));
            for (const std::int64_t y : {j * one, (j + 1) * one}) {
                if ((a.y < y) == (b.y < y)) continue;
                take(double(a.x) + double(b.x - a.x) * (double(y - a.y) / double(b.y - a.y)));
            }
        }
        constexpr double slack = 8;  // of 2^20, more than rounding
        return {static_cast<std::int64_t>(std::floor((low - slack) / double(one))),
                static_cast<std::int64_t>(std::floor((high + slack) / double(one)))};
    }

    void add_cell(const std::array<std::uint32_t, 4>& v, bool main) {
        if (main) {
            add({v[0], v[1], v[2]});
            add({v[0], v[2], v[3]});
        } else {
            add({v[0], v[1], v[3]});
            add({v[1], v[2], v[3]});
        }
    }

    void add(std::array<std::uint32_t, 3> index) {
        if (chart_.mirrored) std::swap(index[1], index[2]);
        facets_.add_facet(index);
    }

    void add_polygon(const Polygon& polygon) {
        if (polygon.count < 3) return;
        std::array<std::uint32_t, 8> index{};
        std::size_t count = 0;
        for (int n = 0; n < polygon.count; ++n) {
            const std::uint32_t v = vertex_of(polygon.node[static_cast<std::size_t>(n)]);
            if (count == 0 || (index[count - 1] != v && index[0] != v)) index[count++] = v;
        }
        for (std::size_t n = 2; n < count; ++n) add({index[0], index[n - 1], index[n]});
    }

    std::uint32_t vertex_of(const Node& node) const {
        switch (node.kind) {
            case Node::Kind::corner:
                return corners_[static_cast<std::size_t>(node.number)];
            case Node::Kind::cut:
                return on_side(static_cast<std::size_t>(node.number), node.at);
            default:
                break;
        }
        const InteriorRow& row = interior_.row(node.j);
        if (row.holds(node.i)) return row.number(node.i);
        for (int k = 0; k < 3; ++k) {
            if (inside_of(node, k, chart_.place) != 0) continue;
            const auto first = static_cast<std::size_t>(k);
            const Place &a = chart_.place[first], &b = chart_.place[(first + 1) % 3];
            return on_side(first, a.x != b.x ? crossing(a.x, b.x, node.i * one)
                                             : crossing(a.y, b.y, node.j * one));
        }
        QUADREL_CHECK(false, node.i);
        return 0;
    }

    std::uint32_t on_side(std::size_t k, const Fraction& at) const {
        if (at.numerator == 0) return corners_[k];
        if (at.numerator == at.denominator) return corners_[(k + 1) % 3];
        return static_cast<std::uint32_t>(base_.mesh.positions.size()) + edges_.find(sides_[k], at);
    }

    /// All corners on one line of texture space: the longest side on the one hand, both others on
    /// the other, sewn together by the order of their vertices along it.
    void cut_degenerate();
    void append_side(std::size_t k, const LongestSide& longest,
                     std::vector<BorderVertex>& out) const;
    void sew(const std::vector<BorderVertex>& near, const std::vector<BorderVertex>& far);

    const Base& base_;
    const Edges& edges_;
    const Lattice& lattice_;
    std::size_t t_;
    Chart chart_;
    Facets& facets_;
    std::array<Side, 3> sides_;
    std::array<std::uint32_t, 3> corners_;
    std::uint32_t first_own_ = 0;
    InteriorPoints interior_;
};

void TriangleCutter::cut_degenerate() {
    const LongestSide longest(chart_.place);
    const std::size_t k = longest.number();
    std::vector<BorderVertex> near, far;
    append_side(k, longest, near);
    near.push_back({corners_[(k + 1) % 3], 1});
    append_side((k + 1) % 3, longest, far);
    append_side((k + 2) % 3, longest, far);
    far.push_back({corners_[k], 0});
    std::reverse(far.begin(), far.end());
    sew(near, far);
}

/// The corner that side k begins at, and its cuts.
void TriangleCutter::append_side(std::size_t k, const LongestSide& longest,
                                 std::vector<BorderVertex>& out) const {
    const Edge& edge = edges_.all()[sides_[k].edge];
    const double from = longest.at(k), to = k == longest.number() ? 1.0 : longest.at(k + 1);
    out.push_back({corners_[k], from});
    for (std::uint32_t n = 0; n < edge.cuts; ++n) {
        const std::uint32_t c = edge.first_cut + (sides_[k].reversed ? edge.cuts - 1 - n : n);
        const double part = edges_.cuts()[c].at.value();
        const double t = sides_[k].reversed ? 1 - part : part;
        out.push_back(
            {static_cast<std::uint32_t>(base_.mesh.positions.size()) + c, from + t * (to - from)});
    }
}

/// The triangle lies to the left of the longest side, the other two beyond it.
void TriangleCutter::sew(const std::vector<BorderVertex>& near,
                         const std::vector<BorderVertex>& far) {
    for (std::size_t i = 0, j = 0; i + 1 < near.size() || j + 1 < far.size();) {
        const bool first =
            j + 1 == far.size() || (i + 1 < near.size() && near[i + 1].at <= far[j + 1].at);
        const std::array<std::uint32_t, 3> index{
            near[i].vertex, first ? near[i + 1].vertex : far[j + 1].vertex, far[j].vertex};
        const bool distinct = index[0] != index[1] && index[1] != index[2] && index[2] != index[0];
        if (distinct) add(index);
        first ? ++i : ++j;
    }
}

}  // namespace

void cut_triangle(const Base& base, const Edges& edges, const Lattice& lattice, std::size_t t,
                  Facets& facets) {
    TriangleCutter(base, edges, lattice, t, facets).cut();
}

}  // namespace quadrel::displacement
