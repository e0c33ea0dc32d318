// The least ratio of each sector of directions, as comparing all texels of the plane would find it.
//
// Texels are visited by blocks. A block's nearest offset and greatest height bound all that is in
// it, rounding included, because every operation is monotonic. A search begins with the texels that
// decided for the apex before, which mostly are near to the minimum already.
#pragma once

#include <array>

#include "bake/cone/cone.hpp"
#include "bake/search/block_search.hpp"

namespace quadrel {

/// Whatever the direction.
struct WholeCircle {
    static constexpr int sectors = 1, channels = 1;
    unsigned sectors_of(const Offsets&) const { return 1; }
    float greatest(const Offsets&, const float* channel) const { return *channel; }
};

/// What a search knows so far. Directions: as WholeCircle; `sectors_of` has all sectors that any
/// texel of a block counts for, `greatest` at least the height of each that counts.
template <class Directions>
class SectorRatios {
  public:
    static constexpr int sectors = Directions::sectors;
    using Ratios = std::array<double, sectors>;

    SectorRatios(const Directions& directions, const TileMetric& metric, double own, double limit)
        : directions_(directions), metric_(metric), own_(own), widest_(limit) {
        best_.fill(limit);
    }

    bool look(Candidate& candidate, const float* greatest) const {
        const Offsets& at = candidate.at;
        const double rise = directions_.greatest(at, greatest) - own_;
        if (!(rise > 0)) return false;
        candidate.bound = cone_ratio(metric_(at.gap_u(), at.gap_v()), rise);
        if (candidate.bound >= widest_) return false;
        candidate.sectors = directions_.sectors_of(at);
        return matters(candidate);
    }

    bool matters(const Candidate& candidate) const {
        bool any = false;
        for (int k = 0; k < sectors; ++k)
            any |= (candidate.sectors >> k & 1u) != 0 && candidate.bound < best_[k];
        return any;
    }

    bool is_fine(const Candidate&) const { return false; }

    void take(const Candidate& candidate) {
        for (int k = 0; k < sectors; ++k) {
            if ((candidate.sectors >> k & 1u) == 0 || candidate.bound >= best_[k]) continue;
            best_[k] = candidate.bound;
            deciders_[k] = {candidate.block.u.low, candidate.block.v.low, true};
        }
        widest_ = *std::max_element(best_.begin(), best_.end());
    }

    using Deciders = std::array<Decider, sectors>;

    const Ratios& best() const { return best_; }
    const Deciders& deciders() const { return deciders_; }

  private:
    const Directions& directions_;
    const TileMetric& metric_;
    double own_, widest_;
    Ratios best_;
    Deciders deciders_{};
};

/// Searches for one apex after the other.
template <class Directions>
class SectorSearch {
  public:
    using Ratios = SectorRatios<Directions>;

    SectorSearch(const PlaneTree& tree, const Directions& directions, const TileMetric& metric,
                 double limit)
        : tree_(&tree), directions_(&directions), metric_(&metric), limit_(limit) {}

    typename Ratios::Ratios operator()(const Apex& apex) {
        Ratios ratios(*directions_, *metric_, apex.height, limit_);
        BlockSearch search(*tree_, apex.i, apex.j, ratios);
        for (const auto& decider : deciders_)
            if (decider.known) search.try_texel(decider.x, decider.y);
        search.try_all();
        deciders_ = ratios.deciders();
        return ratios.best();
    }

  private:
    const PlaneTree* tree_;
    const Directions* directions_;
    const TileMetric* metric_;
    double limit_;
    typename Ratios::Deciders deciders_{};
};

}  // namespace quadrel
