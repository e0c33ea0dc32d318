// The cone map of dual cells is its definition, all cells compared with all.
#include "bake/support.hpp"
#include "quadrel/relief/cells.hpp"

namespace quadrel::test {
namespace {

struct CellPlane {
    CellPlane(const Texture& texture, const SamplerState& state)
        : field(texture),
          sampler(state),
          grid(cell_grid(texture.view().width[0], texture.view().height[0], state)) {}
    float greatest(int i, int j) const {
        double most = -1;
        for (int k = 0; k < 4; ++k)
            most = std::max(most, height_at(field, sampler, i + k % 2, j + k / 2));
        return static_cast<float>(most);
    }

    const Texture& field;
    const SamplerState& sampler;
    Grid grid;
};

/// The least ratio over all cells of the plane that are near enough to matter.
double defined_ratio(const CellPlane& plane, int i, int j) {
    const int width = plane.field.view().width[0], height = plane.field.view().height[0];
    const double own = plane.greatest(i, j);
    double best = 1;
    for (int dj = -height - 2; dj <= height + 2; ++dj) {
        for (int di = -width - 2; di <= width + 2; ++di) {
            const double rise = plane.greatest(i + di, j + dj) - own;
            if (!(rise > 0)) continue;
            const double du = std::max(0, std::abs(di) - 1) / double(width);
            const double dv = std::max(0, std::abs(dj) - 1) / double(height);
            best = std::min(best, std::sqrt(du * du + dv * dv) / rise);
        }
    }
    return best;
}

testing::AssertionResult is_its_definition(const Texture& map, const Texture& field,
                                           const SamplerState& sampler) {
    const CellPlane plane(field, sampler);
    const Grid& grid = plane.grid;
    if (map.view().width[0] != grid.u.count || map.view().height[0] != grid.v.count)
        return testing::AssertionFailure() << "size";
    for (int j = 0; j < grid.v.count; ++j) {
        for (int i = 0; i < grid.u.count; ++i) {
            const int x = i + grid.u.first, y = j + grid.v.first;
            const double exact = defined_ratio(plane, x, y);
            const float c = texel_of(map, 0, 0, i, j, 1);
            const bool down = c <= exact && c >= exact * (1 - 0x1p-22);
            if (texel_of(map, 0, 0, i, j, 0) != plane.greatest(x, y) || !down)
                return testing::AssertionFailure()
                       << "cell " << x << " " << y << ": " << c << ", by definition " << exact;
        }
    }
    return testing::AssertionSuccess();
}

Baker planted_cells(Planted planted) {
    const Baker real = baker(BakeKind::cone_cell);
    if (planted == Planted::first_ratio) {
        return [=](const Texture& field, const SamplerState& sampler) {
            const Texels map = real(field, sampler);
            return with_values(*map, [&](float v, int, int, int, int, int c) {
                return c == 1 ? texel_of(*map, 0, 0, 0, 0, 1) : v;
            });
        };
    }
    return changed(real, [=](float v, int, int, int, int, int c) {
        if (planted == Planted::node_an_ulp_low) return c == 0 ? std::nextafter(v, -1.0f) : v;
        if (c == 0) return v;
        if (planted == Planted::ratio_an_ulp_wide) return std::nextafter(v, 2.0f);
        return planted == Planted::ratio_halved ? v / 2 : v;
    });
}

TEST(ConeCell, IsItsDefinition) {
    EXPECT_TRUE(holds_for_small_fields(baker(BakeKind::cone_cell), is_its_definition));
    for (const Planted planted : {Planted::first_ratio, Planted::node_an_ulp_low,
                                  Planted::ratio_an_ulp_wide, Planted::ratio_halved}) {
        EXPECT_FALSE(holds_for_small_fields(planted_cells(planted), is_its_definition))
            << static_cast<int>(planted);
    }
}

TEST(ConeCell, IsItsDefinitionOnLargerFields) {
    std::mt19937 random(9);
    const Texels sparse =
        make_field(37, 26, [&](int, int) { return random() % 97 == 0 ? 1.0 : 0.0; });
    const Texels hills = make_field(33, 40, [](int i, int j) {
        return ((i - 16) * (i - 16) + (j - 9) * (j - 9)) % 512 / 512.0;
    });
    for (const Texels& field : {sparse, hills}) {
        for (const SamplerState& sampler :
             {sampler_with(Wrap::repeat, Wrap::repeat),
              sampler_with(Wrap::mirrored_repeat, Wrap::clamp_to_edge)}) {
            EXPECT_TRUE(
                is_its_definition(*bake(*field, BakeKind::cone_cell, sampler), *field, sampler));
        }
    }
}

}  // namespace
}  // namespace quadrel::test
