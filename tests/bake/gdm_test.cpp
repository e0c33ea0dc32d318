// Tables of distances: each value is the distance from its node along its direction.
#include "bake/direction/relief_ray.hpp"
#include "bake/support.hpp"
#include "quadrel/error.hpp"
#include "quadrel/relief/direction_table.hpp"

namespace quadrel::test {
namespace {

constexpr double node_depth = 0.3, most_curvature = 4;
constexpr int node_layers = 3, node_directions = 5;

BakeOptions node_table(BakeKind kind, int columns) {
    BakeOptions options;
    options.parameters = {
        {"columns", columns}, {"directions", node_directions}, {"depth", node_depth}};
    if (kind == BakeKind::gdm) options.parameters["slices"] = node_layers;
    if (kind == BakeKind::vdm) {
        options.parameters["curvatures"] = node_layers;
        options.parameters["curvature"] = most_curvature;
    }
    return options;
}

/// The distance that the definition has for a node.
double defined_distance(BakeKind kind, const Texture& field, const SamplerState& sampler,
                        vec2<double> place, int k, vec2<double> coordinate) {
    const HeightPlane plane(field, sampler);
    const vec2<double> K = direction_of_square(coordinate.x, coordinate.y) * node_depth;
    ReliefRay ray{};
    ray.x = place.x;
    ray.y = place.y;
    ray.dx = K.x * field.view().width[0];
    ray.dy = K.y * field.view().height[0];
    ray.z = kind == BakeKind::gdm ? (k + 1.0) / node_layers : 1;
    const double curvature = kind == BakeKind::vdm ? most_curvature * (k - 1) : 0;
    // The base falls away by curvature / 2 times the way squared, in tiles.
    ray.bend = curvature / 2 * dot(K, K) / node_depth;
    const double t = first_meeting(plane, ray);
    return t < 0 ? -1 : t;
}

MapCheck is_the_distance(BakeKind kind) {
    return [kind](const Texture& map, const Texture& field, const SamplerState& sampler) {
        const TextureView& view = map.view();
        const Grid grid = texel_grid(field.view().width[0], field.view().height[0], sampler);
        const int columns = view.width[1], rows = view.height[1];
        std::mt19937 random(7);
        for (int trial = 0; trial < 60; ++trial) {
            const auto below = [&](int n) { return static_cast<int>(random() % n); };
            const int i = below(columns), j = below(rows), k = below(node_layers);
            const int a = below(node_directions), b = below(node_directions);
            const auto place = [](int n, int count, const GridAxis& axis) {
                return axis.first + (n + 0.5) * axis.count / count - 0.5;
            };
            const auto coordinate = [](int n) { return 2.0 * n / (node_directions - 1) - 1; };
            const double expected = defined_distance(
                kind, field, sampler, {place(i, columns, grid.u), place(j, rows, grid.v)}, k,
                {coordinate(a), coordinate(b)});
            const float value = texel_of(map, 0, k, a * columns + i, b * rows + j);
            if (std::abs(value - expected) > 1e-6 * (1 + expected))
                return testing::AssertionFailure() << value << " for " << expected;
        }
        return testing::AssertionSuccess();
    };
}

TEST(Gdm, HasTheDistancesOfItsNodes) {
    for (const BakeKind kind : {BakeKind::gdm, BakeKind::vdm}) {
        const MapCheck holds = is_the_distance(kind);
        for (const int columns : {3, 64})
            EXPECT_TRUE(holds_for_small_fields(baker(kind, node_table(kind, columns)), holds));
        const Baker real = baker(kind, node_table(kind, 64));
        EXPECT_FALSE(holds_for_small_fields(
            changed(real, [](float v, int, int, int, int, int) { return v + 1e-4f; }), holds))
            << static_cast<int>(Planted::raised);
        const auto turned = [&](int next_layer, int next_direction) {
            return [=](const Texture& field, const SamplerState& sampler) {
                const Texels map = real(field, sampler);
                const TextureView& view = map->view();
                return with_values(*map, [&](float v, int level, int layer, int i, int j, int) {
                    if (level > 0) return v;
                    const int x = (i + next_direction * view.width[1]) % view.width[0];
                    return texel_of(*map, 0, (layer + next_layer) % node_layers, x, j);
                });
            };
        };
        EXPECT_FALSE(holds_for_small_fields(turned(1, 0), holds))
            << static_cast<int>(Planted::layers_turned);
        EXPECT_FALSE(holds_for_small_fields(turned(0, 1), holds))
            << static_cast<int>(Planted::sectors_turned);
    }
}

TEST(Gdm, SaysWhatItsLayersAre) {
    const Texels field = random_field(6, 4, 3);
    const Texels vdm = bake(*field, BakeKind::vdm, repeat(), node_table(BakeKind::vdm, 6));
    const Texels gdm = bake(*field, BakeKind::gdm, repeat(), node_table(BakeKind::gdm, 6));
    EXPECT_EQ(texel_of(*vdm, 2, 0, 0, 0), static_cast<float>(node_depth));
    EXPECT_EQ(texel_of(*vdm, 2, 0, 1, 0), static_cast<float>(most_curvature));
    EXPECT_EQ(texel_of(*gdm, 2, 0, 1, 0), 0.0f);
    EXPECT_EQ(vdm->view().faces, node_layers);
    EXPECT_EQ(gdm->view().width[0], node_directions * gdm->view().width[1]);
}

/// The top of a generalized map is the plane's layer of a view-dependent one.
TEST(Gdm, HasAtTheTopWhatAPlaneHas) {
    const Texels field = random_field(6, 4, 3);
    const Texels vdm = bake(*field, BakeKind::vdm, repeat(), node_table(BakeKind::vdm, 6));
    const Texels gdm = bake(*field, BakeKind::gdm, repeat(), node_table(BakeKind::gdm, 6));
    int differ = 0, bent = 0;
    for (int j = 0; j < gdm->view().height[0]; ++j) {
        for (int i = 0; i < gdm->view().width[0]; ++i) {
            differ += texel_of(*gdm, 0, node_layers - 1, i, j) != texel_of(*vdm, 0, 1, i, j);
            bent += texel_of(*gdm, 0, node_layers - 1, i, j) != texel_of(*vdm, 0, 2, i, j);
        }
    }
    EXPECT_EQ(differ, 0);
    EXPECT_GT(bent, 100);
}

TEST(Gdm, RefusesTablesThatAreTooLarge) {
    const Texels wide = make_field(512, 512, [](int, int) { return 0.5; });
    BakeOptions options;
    options.parameters = {{"columns", 512}, {"slices", 64}, {"directions", 65}};
    try {
        bake(*wide, BakeKind::gdm, repeat(), options);
        ADD_FAILURE() << "a table of 264 GiB";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(" 270464 MiB"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace quadrel::test
