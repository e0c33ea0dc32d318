// cone-robust-exact on ranges: its hits are on patches, none before the first; how late one may be
// is how far cones before it lead.
#pragma once

#include <vector>

#include "quadrel/relief/trace/cone/range_baked_maps.hpp"
#include "quadrel/relief/trace/search/range_first_hit.hpp"

namespace quadrel {

namespace range_detail {

/// A field whose first hit may be leapt over: where cones lead to from places before it, all rays
/// may still be on their way.
template <class Look>
class LeaptOver {
  public:
    LeaptOver(const FieldHits& field, const SearchRay<Ranges>& ray, const Look& cone, int lane)
        : field_(field) {
        const int pieces = static_cast<int>(
            std::clamp(4 * field.places().speed(), double(least_pieces), double(most_pieces)));
        reach_.reserve(static_cast<std::size_t>(pieces));
        const Ranges kappa = length(ray.K);
        double farthest = 0;
        for (int k = 0; k < pieces; ++k) {
            const RealInterval piece(double(k) / pieces, double(k + 1) / pieces);
            farthest = std::max(farthest, reach_of(ray, cone, kappa, piece, lane));
            reach_.push_back(farthest);
        }
    }

    const RayPlaces& places() const { return field_.places(); }
    Meets meets(double from, double to) const { return field_.meets(from, to); }
    RealInterval height_in(const RealInterval& s) const { return field_.height_in(s); }
    bool holds_all(double at) const { return field_.holds_all(at) && reach_before(at) <= at; }

  private:
    static constexpr int least_pieces = 64, most_pieces = 1024;

    /// How far a cone under a piece of the ray may lead.
    static double reach_of(const SearchRay<Ranges>& ray, const Look& cone, const Ranges& kappa,
                           const RealInterval& piece, int lane) {
        const Aside aside;
        const Ranges s = everywhere(piece);
        const auto here = cone(only(lane), ray.at(s));
        const Ranges gap = (Ranges(1) - s) - here.channel[0];
        if (!gap.lane[lane].is_bounded()) return 1;
        if (gap.lane[lane].range().hi <= 0) return 0;  // the patch is met instead
        const Ranged to = (s + cone_step_length(gap, here.channel[1], kappa)).lane[lane];
        return to.is_bounded() ? to.range().hi : 1;
    }
    double reach_before(double at) const {
        if (at <= 0) return 0;
        const double pieces = static_cast<double>(reach_.size());
        const double last = std::min(std::ceil(at * pieces), pieces) - 1;
        return reach_[static_cast<std::size_t>(last)];
    }

    const FieldHits& field_;
    std::vector<double> reach_;
};

}  // namespace range_detail

/// cone-robust-exact on ranges: hits are on patches, none before the first; how late one may be is
/// how far cones before it lead.
struct ConeRobustExactOnRanges : ConeRobustExact {
    template <class Io>
    void operator()(Io& io, const Params&) const {
        using namespace range_detail;
        const SearchRay<Ranges> ray = search_ray(io);
        const BakedLookUp<TextureSlot::cone_robust, 2, Io> cone(io);
        const SampledTexture& map = *io.template texture<TextureSlot::height>();
        SearchResult<Ranges> result;
        for (int lane = 0; lane < 4; ++lane) {
            if (ray.active.lane[lane].known().state == RangeTruth::no) continue;
            take_any_hit(lane, result);
            const auto rays = ray_range(ray, lane);
            if (!rays) continue;
            const FieldHits field(map, oracle::Surface::bilinear, *rays);
            if (!field.places().are_short()) continue;
            const LeaptOver solid(field, ray, cone, lane);
            take_first_hits(solid, Status::floor, lane, result);
        }
        result.flags = any_flags();
        result.steps = result.fetches = any_count();
        store_search(io, ray, result);
    }
};

}  // namespace quadrel
