#include "scene/displace/seams.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace quadrel::displacement {
namespace {

using Triple = std::array<std::uint32_t, 3>;

/// Vertices at one position have one number.
std::vector<std::uint32_t> number_positions(const Mesh& mesh) {
    std::vector<std::uint32_t> order(mesh.positions.size()), number(order.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return comes_before(mesh, a, b); });
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i > 0 && mesh.positions[order[i]] != mesh.positions[order[i - 1]]) ++count;
        number[order[i]] = count;
    }
    return number;
}

/// A side of some triangle, by the positions of its edge's ends.
struct PlacedSide {
    std::uint64_t ends;
    Side side;
};

std::vector<PlacedSide> placed_sides(const Mesh& mesh, const Edges& edges) {
    const std::vector<std::uint32_t> number = number_positions(mesh);
    std::vector<PlacedSide> sides;
    sides.reserve(3 * mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const Side& side = edges.side(t, k);
            const Edge& edge = edges.all()[side.edge];
            sides.push_back({std::uint64_t(number[edge.from]) << 32 | number[edge.to], side});
        }
    std::stable_sort(sides.begin(), sides.end(),
                     [](const auto& a, const auto& b) { return a.ends < b.ends; });
    return sides;
}

/// The vertices along an edge and where on it they are, its ends included.
struct Border {
    const Edges& edges;
    std::uint32_t edge;
    std::uint32_t mesh_vertices;

    std::uint32_t last() const { return edges.all()[edge].cuts + 1; }
    std::uint32_t vertex(std::uint32_t n) const {
        const Edge& e = edges.all()[edge];
        if (n == 0) return e.from;
        return n > e.cuts ? e.to : mesh_vertices + e.first_cut + n - 1;
    }
    Fraction at(std::uint32_t n) const {
        if (n == 0) return {0, 1};
        return n >= last() ? Fraction{1, 1} : edges.cuts()[edges.all()[edge].first_cut + n - 1].at;
    }
};

void sew(const Border& forth, const Border& back, std::vector<Triple>& out) {
    std::uint32_t i = 0, j = 0;
    while (i < forth.last() || j < back.last()) {
        const bool first =
            j == back.last() || (i < forth.last() && !(back.at(j + 1) < forth.at(i + 1)));
        if (first) {
            out.push_back({forth.vertex(i + 1), forth.vertex(i), back.vertex(j)});
            ++i;
        } else {
            out.push_back({back.vertex(j), back.vertex(j + 1), forth.vertex(i)});
            ++j;
        }
    }
}

/// The ends of walls around a position, one after the other, are the border of a hole.
class Holes {
  public:
    void add_edge(std::uint32_t from, std::uint32_t to) { next_.emplace(from, to); }

    void fill(std::vector<Triple>& out) {
        while (!next_.empty()) {
            const std::vector<std::uint32_t> loop = take_loop();
            for (std::size_t i = 2; i < loop.size(); ++i)
                out.push_back({loop[0], loop[i - 1], loop[i]});
        }
    }

  private:
    /// Empty where the mesh ends.
    std::vector<std::uint32_t> take_loop() {
        std::vector<std::uint32_t> loop{next_.begin()->first};
        for (;;) {
            const auto step = next_.find(loop.back());
            if (step == next_.end()) return {};
            const std::uint32_t to = step->second;
            next_.erase(step);
            if (to == loop[0]) return loop;
            loop.push_back(to);
        }
    }

    std::multimap<std::uint32_t, std::uint32_t> next_;
};

}  // namespace

std::vector<Seam> find_seams(const Mesh& mesh, const Edges& edges) {
    const std::vector<PlacedSide> sides = placed_sides(mesh, edges);
    std::vector<Seam> seams;
    for (std::size_t first = 0; first < sides.size();) {
        std::size_t end = first + 1;
        while (end < sides.size() && sides[end].ends == sides[first].ends) ++end;
        const bool point = sides[first].ends >> 32 == (sides[first].ends & 0xffffffffu);
        if (end - first == 2 && !point) {
            Side a = sides[first].side, b = sides[first + 1].side;
            if (a.reversed) std::swap(a, b);
            if (a.edge != b.edge && !a.reversed && b.reversed) seams.push_back({a.edge, b.edge});
        }
        first = end;
    }
    return seams;
}

std::uint64_t most_wall_triangles(const Seam& seam, const Edges& edges) {
    return std::uint64_t(edges.all()[seam.forth].cuts) + edges.all()[seam.back].cuts + 4;
}

std::vector<Triple> wall_triangles(const std::vector<Seam>& seams, const Edges& edges,
                                   std::size_t mesh_vertices) {
    std::vector<Triple> out;
    Holes holes;
    for (const Seam& seam : seams) {
        const auto count = static_cast<std::uint32_t>(mesh_vertices);
        const Border forth{edges, seam.forth, count}, back{edges, seam.back, count};
        sew(forth, back, out);
        holes.add_edge(back.vertex(0), forth.vertex(0));
        holes.add_edge(forth.vertex(forth.last()), back.vertex(back.last()));
    }
    holes.fill(out);
    return out;
}

}  // namespace quadrel::displacement
