#include "scene/displace/edges.hpp"

#include "quadrel/check.hpp"

namespace quadrel::displacement {
namespace {

bool on_a_border(std::int64_t x) { return x % one == 0; }

/// One coordinate of a point that goes along an edge from cell to cell.
class Walk {
  public:
    Walk(std::int64_t from, std::int64_t to) : from_(from), to_(to) {
        cell_ = floor_cell(from);
        // It leaves a border that it starts from at once.
        if (to < from && on_a_border(from)) --cell_;
    }

    std::int64_t cell() const { return cell_; }
    /// The border that it meets next, and where.
    std::int64_t border() const { return to_ > from_ ? cell_ + 1 : cell_; }
    std::optional<Fraction> next() const {
        if (from_ == to_) return std::nullopt;
        const Fraction at = crossing(from_, to_, border() * one);
        if (at.numerator >= at.denominator) return std::nullopt;
        return at;
    }
    void advance() { cell_ += to_ > from_ ? 1 : -1; }
    bool along_a_border() const { return from_ == to_ && on_a_border(from_); }
    /// In the cell, in [0, 1]. From small integers, so that it does not depend on how far away the
    /// cell is.
    double in_cell(const Fraction& at) const {
        const double part =
            Lattice::part(from_ - cell_ * one) + at.value() * Lattice::part(to_ - from_);
        return std::clamp(part, 0.0, 1.0);
    }

  private:
    std::int64_t from_, to_, cell_;
};

class EdgeCutter {
  public:
    EdgeCutter(const Lattice& lattice, const Place& a, const Place& b, std::vector<Cut>& out)
        : lattice_(lattice), a_(a), b_(b), x_(a.x, b.x), y_(a.y, b.y), out_(out) {}

    void cut() {
        Fraction last{0, 1};
        for (;;) {
            const auto at_x = x_.next(), at_y = y_.next();
            const bool any = at_x || at_y;
            const bool by_x = at_x && (!at_y || !(*at_y < *at_x));
            const bool by_y = at_y && (!at_x || !(*at_x < *at_y));
            const Fraction next = by_x ? *at_x : by_y ? *at_y : Fraction{1, 1};
            cut_diagonal(last, next);
            if (!any) return;
            out_.push_back({next, border_height(next, by_x, by_y)});
            if (by_x) x_.advance();
            if (by_y) y_.advance();
            last = next;
        }
    }

  private:
    double border_height(const Fraction& at, bool by_x, bool by_y) const {
        if (by_x && by_y) return lattice_.at(x_.border(), y_.border());
        if (by_x) {
            const double low = lattice_.at(x_.border(), y_.cell());
            return low + y_.in_cell(at) * (lattice_.at(x_.border(), y_.cell() + 1) - low);
        }
        const double low = lattice_.at(x_.cell(), y_.border());
        return low + x_.in_cell(at) * (lattice_.at(x_.cell() + 1, y_.border()) - low);
    }

    void cut_diagonal(const Fraction& after, const Fraction& before) {
        if (x_.along_a_border() || y_.along_a_border()) return;
        const std::int64_t i = x_.cell(), j = y_.cell();
        const bool main = lattice_.has_main_diagonal(i, j);
        const auto beyond = [&](const Place& p) {
            const std::int64_t f = p.x - i * one, g = p.y - j * one;
            return main ? f - g : f + g - one;
        };
        const std::int64_t from = beyond(a_), to = beyond(b_);
        if (from == to) return;
        const Fraction at = crossing(from, to, 0);
        if (!(after < at) || !(at < before)) return;
        const double f = x_.in_cell(at);
        const double low = main ? lattice_.at(i, j) : lattice_.at(i, j + 1);
        const double high = main ? lattice_.at(i + 1, j + 1) : lattice_.at(i + 1, j);
        out_.push_back({at, low + f * (high - low)});
    }

    const Lattice& lattice_;
    Place a_, b_;
    Walk x_, y_;
    std::vector<Cut>& out_;
};

}  // namespace

bool comes_before(const Mesh& mesh, std::uint32_t a, std::uint32_t b) {
    const glm::vec3 &p = mesh.positions[a], &q = mesh.positions[b];
    if (p.x != q.x) return p.x < q.x;
    if (p.y != q.y) return p.y < q.y;
    if (p.z != q.z) return p.z < q.z;
    return a < b;
}

Edges::Edges(const Mesh& mesh, const std::vector<Place>& places, const Lattice& lattice) {
    std::unordered_map<std::uint64_t, std::uint32_t> known;
    sides_.resize(mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
            const bool reversed = comes_before(mesh, to, from);
            if (reversed) std::swap(from, to);
            const auto [found, is_new] = known.try_emplace(
                std::uint64_t(from) << 32 | to, static_cast<std::uint32_t>(edges_.size()));
            sides_[t][k] = {found->second, reversed};
            if (!is_new) continue;
            const auto first = static_cast<std::uint32_t>(cuts_.size());
            EdgeCutter(lattice, places[from], places[to], cuts_).cut();
            edges_.push_back({from, to, first, static_cast<std::uint32_t>(cuts_.size()) - first});
        }
    }
}

std::uint32_t Edges::find(const Side& side, const Fraction& at) const {
    const Edge& edge = edges_[side.edge];
    const Fraction wanted = side.reversed ? at.from_other_end() : at;
    const auto first = cuts_.begin() + edge.first_cut, last = first + edge.cuts;
    const auto found = std::lower_bound(
        first, last, wanted, [](const Cut& cut, const Fraction& place) { return cut.at < place; });
    QUADREL_CHECK(found != last && found->at == wanted, wanted.value());
    return static_cast<std::uint32_t>(found - cuts_.begin());
}

}  // namespace quadrel::displacement
