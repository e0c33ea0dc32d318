// Searches by blocks find what comparing all texels with all finds, bit for bit.
#include <limits>

#include "bake/cone/relaxed_falls.hpp"
#include "bake/search/octants.hpp"
#include "bake/search/sector_search.hpp"
#include "bake/support.hpp"

namespace quadrel::test {
namespace {

/// A field as generators get it.
struct Field {
    Field(const Texture& heights, const SamplerState& wraps)
        : source(heights), sampler(wraps), plane(heights, wraps) {}

    const Texture& source;
    SamplerState sampler;
    HeightPlane plane;
    std::map<std::string, double> parameters;
    std::string id = "field";
    Progress progress{{}, std::numeric_limits<double>::infinity()};
    BakeJob job{source, plane, sampler, parameters, id, progress};
};

unsigned octants_at(const HeightPlane& plane, double u_low, double u_high, double v_low,
                    double v_high) {
    return octants_of({(u_low - 0.5) / plane.width, (u_high + 0.5) / plane.width},
                      {(v_low - 0.5) / plane.height, (v_high + 0.5) / plane.height});
}

/// Octants of texels' squares; `planted`: of blocks those of the middle alone.
struct TestOctants {
    static constexpr int sectors = 8, channels = 1;
    unsigned sectors_of(const Offsets& at) const {
        if (planted != Planted::sectors_of_the_middle)
            return octants_at(plane, at.u_low, at.u_high, at.v_low, at.v_high);
        const double u = (at.u_low + at.u_high) / 2.0, v = (at.v_low + at.v_high) / 2.0;
        return octants_at(plane, u, u, v, v);
    }
    float greatest(const Offsets&, const float* channel) const { return *channel; }

    const HeightPlane& plane;
    Planted planted;
};

/// The search, or one with an error in how it bounds blocks.
struct PlantedRatios : SectorRatios<TestOctants> {
    PlantedRatios(const SectorRatios<TestOctants>& real, const HeightPlane& heights, Planted error)
        : SectorRatios(real), plane(heights), planted(error) {}

    bool look(Candidate& candidate, const float* greatest) const {
        const bool block = candidate.block.level > 0;
        const Span& u = candidate.block.u;
        const float low = block ? *greatest - 0.05f : *greatest;
        if (planted == Planted::block_too_low) return SectorRatios::look(candidate, &low);
        if (planted == Planted::beyond_forgotten && (u.high < 0 || u.low >= plane.grid.u.count))
            return false;
        if (!SectorRatios::look(candidate, greatest)) return false;
        if (planted == Planted::distance_of_the_middle && candidate.bound > 0) {
            const TileMetric metric(plane.width, plane.height);
            const Offsets& at = candidate.at;
            candidate.bound *= metric((at.u_low + at.u_high) / 2.0, (at.v_low + at.v_high) / 2.0) /
                               metric(at.gap_u(), at.gap_v());
        }
        return matters(candidate);
    }

    const HeightPlane& plane;
    Planted planted;
};

using Ratios = SectorRatios<TestOctants>::Ratios;

constexpr double limit = 1.5;

Ratios by_blocks(const Field& field, const PlaneTree& tree, int i, int j, Planted planted) {
    const TileMetric metric(field.plane.width, field.plane.height);
    const TestOctants octants{field.plane, planted};
    PlantedRatios found({octants, metric, field.plane.at(i, j), limit}, field.plane, planted);
    BlockSearch(tree, i, j, found).try_all();
    return found.best();
}

/// All texels that a cone of the limit can reach.
Ratios by_all_texels(const Field& field, int i, int j) {
    const HeightPlane& plane = field.plane;
    const TileMetric metric(plane.width, plane.height);
    const int reach = 2 * std::max(plane.width, plane.height);
    Ratios best;
    best.fill(limit);
    for (int dj = -reach; dj <= reach; ++dj) {
        for (int di = -reach; di <= reach; ++di) {
            const double height =
                plane.texel(i + di + plane.grid.u.first, j + dj + plane.grid.v.first);
            if (!(height > plane.at(i, j))) continue;
            const double ratio = cone_ratio(metric(di, dj), height - plane.at(i, j));
            const unsigned hit = octants_at(plane, di, di, dj, dj);
            for (int k = 0; k < 8; ++k)
                if (hit >> k & 1u) best[k] = std::min(best[k], ratio);
        }
    }
    return best;
}

/// Smooth hill_field: where blocks are passed.
Texels hill_field(int width, int height) {
    return make_field(width, height, [=](int i, int j) {
        const double u = 2.0 * i / width - 0.7, v = 2.0 * j / height - 1.1;
        return std::max(0.0, 0.9 - u * u - 0.7 * v * v);
    });
}

testing::AssertionResult finds_the_same(const Texels& heights, const SamplerState& sampler,
                                        Planted planted) {
    const Field field(*heights, sampler);
    const PlaneTree tree(field.job, 1, 1, cone_reach(field.plane, limit),
                         [&](int x, int y, int) { return field.plane.at(x, y); });
    const int columns = field.plane.grid.u.count, rows = field.plane.grid.v.count;
    // Every texel of small fields; some of larger ones.
    for (int k = 0; k < columns * rows; k += 1 + columns * rows / 60) {
        const int i = k % columns, j = k / columns;
        if (by_blocks(field, tree, i, j, planted) != by_all_texels(field, i, j))
            return testing::AssertionFailure()
                   << "texel " << i << " " << j << ", " << describe(*heights, sampler);
    }
    return testing::AssertionSuccess();
}

testing::AssertionResult finds_the_same_everywhere(Planted planted) {
    std::vector<Texels> fields = small_fields();
    for (const auto& [width, height] : {std::pair(24, 20), {40, 3}, {2, 33}})
        fields.push_back(hill_field(width, height));
    int turn = 0;
    for (const Texels& field : fields) {
        const auto samplers = all_samplers();
        // Every pair of wraps for some field, and every wrap for all.
        for (std::size_t k = turn++ % 3; k < samplers.size(); k += 3) {
            auto result = finds_the_same(field, samplers[k], planted);
            if (!result) return result;
        }
    }
    return testing::AssertionSuccess();
}

TEST(BlockSearch, FindsWhatAllTexelsSay) {
    EXPECT_TRUE(finds_the_same_everywhere(Planted::none));
    for (const Planted planted : {Planted::block_too_low, Planted::beyond_forgotten,
                                  Planted::distance_of_the_middle, Planted::sectors_of_the_middle})
        EXPECT_FALSE(finds_the_same_everywhere(planted)) << static_cast<int>(planted);
}

// ---- Rays of relaxed cones ----------------------------------------------------------------------

/// No point of a deeper texel is less than the fall away, over how much deeper it is. `larger`:
/// what falls are multiplied by.
testing::AssertionResult bounds_falls(const Texels& heights, const SamplerState& sampler,
                                      float larger) {
    const Field field(*heights, sampler);
    const HeightPlane& plane = field.plane;
    const RelaxedRays rays(plane, 8);
    const RelaxedFalls falls(field.job, 1, rays, RayErrors(plane, 8));
    for (int n = 0; n < plane.grid.u.count * plane.grid.v.count; ++n) {
        const int x = n % plane.grid.u.count, y = n / plane.grid.u.count;
        for (int dj = -2 * plane.height; dj <= 2 * plane.height; ++dj) {
            for (int di = -2 * plane.width; di <= 2 * plane.width; ++di) {
                const double fall =
                    rays.depth(HeightPlane::wrap(x + di + plane.grid.u.first, plane.grid.u),
                               HeightPlane::wrap(y + dj + plane.grid.v.first, plane.grid.v)) -
                    rays.depth(x, y);
                if (!(fall > 0)) continue;
                const double u = std::max(std::abs(di) - 0.5, 0.0) / plane.width;
                const double v = std::max(std::abs(dj) - 0.5, 0.0) / plane.height;
                const double ratio = std::sqrt(u * u + v * v) / fall;
                const bool touches = std::abs(di) <= 1 && std::abs(dj) <= 1;
                for (int k = 0; k < 8; ++k) {
                    if ((octants_at(plane, di, di, dj, dj) >> k & 1u) == 0) continue;
                    if (larger * falls.all(x, y)[k] <= ratio &&
                        (touches || larger * falls.far(x, y)[k] <= ratio))
                        continue;
                    return testing::AssertionFailure()
                           << "texel " << x << " " << y << " octant " << k << " at " << di << " "
                           << dj << ", " << describe(*heights, sampler);
                }
            }
        }
    }
    return testing::AssertionSuccess();
}

TEST(RelaxedFalls, AreNoGentlerThanTheField) {
    int turn = 0;
    for (const Texels& field : {random_field(6, 5, 31), hill_field(12, 5), hill_field(3, 14)}) {
        for (const SamplerState& sampler : all_samplers()) {
            if (turn++ % 4 != 0) continue;
            EXPECT_TRUE(bounds_falls(field, sampler, 1));
        }
        EXPECT_FALSE(bounds_falls(field, all_samplers()[0], 1.6f));
    }
}

}  // namespace
}  // namespace quadrel::test
