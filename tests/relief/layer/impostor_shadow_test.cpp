// Shadows in the volume of an impostor, any way through the cube or to a light in it: against dense
// samples of its own layers in double.
#include "effort.hpp"
#include "relief/layer/impostor_views.hpp"

namespace quadrel::test::impostor {
namespace {

/// The maps that are looked at, first to third.
using BoundMaps = std::vector<const Map*>;

void bind_all(Batch<float>& batch, const BoundMaps& bound) {
    constexpr TextureSlot slots[] = {TextureSlot::layers, TextureSlot::layers_2,
                                     TextureSlot::layers_3};
    for (std::size_t i = 0; i < bound.size(); ++i) batch.bind(slots[i], bound[i]->sampled);
}

enum class Light { directional, point };

/// Hits of the march over a view, and a light in any direction, or at any place in the cube.
class LitImpostor {
  public:
    Batch<float> batch{64};
    View view;

    LitImpostor(const BoundMaps& bound, Light kind, Random& random) : view(random) {
        batch.own_depth = true;
        bind_all(batch, bound);
        for (int lane = 0; lane < batch.lanes; ++lane) fill_lane(batch, lane, view, random);
        batch.run("frame-impostor");
        batch.run("true-impostor", {{"steps", 128}, {"binary_steps", 20}});
        batch.run("displace");
        is_point = kind == Light::point;
        const auto inside = [&](double length) { return random.uniform(-0.45, 0.45) * length; };
        const dvec3 at(inside(tile), inside(tile), inside(thickness));
        place_light(is_point ? at : random_direction(random));
    }
    LitImpostor(const LitImpostor&) = delete;

    bool is_point;
    dvec3 light;  ///< in the object's space: where it is, or towards it

    void place_light(const dvec3& to) {
        light = to;
        const dvec3 v = (view.x * to.x + view.y * to.y + view.z * to.z) * view.scale;
        const dvec3 in_eye = is_point ? view.origin + v : v;
        batch.frame.lights[0].directional = is_point ? 0 : 1;
        for (int c = 0; c < 3; ++c)
            batch.frame.lights[0].position[c] = static_cast<float>(in_eye[c]);
    }
    bool hit(int lane) {
        return batch.integer(Value::hit_status, lane) == static_cast<int>(Status::hit);
    }
    float visibility(int lane) { return batch.real(Value::shadow_visibility, lane); }
};

/// How far a place is inside of a solid between the layers of a map; below 0 outside.
double depth_inside(const BoundMaps& bound, const dvec2& uv, double s) {
    double most = -1;
    for (const Map* map : bound)
        for (int pair = 0; pair < 4; pair += 2)
            most = std::max(
                most, std::min(s - depth_at(*map, uv, pair), depth_at(*map, uv, pair + 1) - s));
    return most;
}
/// The depth of a layer at uv that is next to s.
double next_layer(const BoundMaps& bound, const dvec2& uv, double s) {
    double next = 9;
    for (const Map* map : bound)
        for (int layer = 0; layer < 4; ++layer) {
            const double depth = depth_at(*map, uv, layer);
            if (std::abs(depth - s) < std::abs(next - s)) next = depth;
        }
    return next;
}

enum class Lit { dark, clear, undecided };

/// By dense samples from the layer that a lane has met; what lies within rounding is undecided.
Lit light_of(LitImpostor& lit, const BoundMaps& bound, int lane) {
    const dvec2 uv(lit.batch.vector2(Value::hit_uv, lane));
    const double s = next_layer(bound, uv, lit.batch.real(Value::hit_s, lane));
    const dvec3 from(uv.x, uv.y, s);
    const dvec3 to(lit.light.x / tile, lit.light.y / tile, -lit.light.z / thickness);
    const dvec3 way = lit.is_point ? to + dvec3(0.5) - from : to;
    double end = lit.is_point ? 1 : 1e9;
    for (int axis = 0; axis < 3; ++axis)
        if (way[axis] != 0) end = std::min(end, ((way[axis] > 0 ? 1 : 0) - from[axis]) / way[axis]);
    bool close = false;
    constexpr int samples = 500;
    for (int k = 1; k <= samples; ++k) {
        const dvec3 at = from + way * (end * k / samples);
        const double inside = depth_inside(bound, dvec2(at.x, at.y), at.z);
        if (inside > 1e-3) return Lit::dark;
        close |= inside > (k < samples / 50 ? 1e-5 : -1e-3);
    }
    return close ? Lit::undecided : Lit::clear;
}

struct ShadowCase {
    Light kind = Light::directional;
    const char* id = "shadow-impostor-exact";
    Parameters parameters{};
    std::function<void(LitImpostor&)> spoil{};
};

testing::AssertionResult shadows_as_the_solids_do(const BoundMaps& bound,
                                                  const ShadowCase& shadow) {
    Random random(91);
    int dark = 0, clear = 0, undecided = 0;
    for (int n = 0; n < (sanitized ? 5 : 40); ++n) {
        LitImpostor lit(bound, shadow.kind, random);
        std::vector<Lit> truth;
        for (int lane = 0; lane < lit.batch.lanes; ++lane)
            truth.push_back(lit.hit(lane) ? light_of(lit, bound, lane) : Lit::undecided);
        if (shadow.spoil) shadow.spoil(lit);
        lit.batch.run(shadow.id, shadow.parameters);
        for (int lane = 0; lane < lit.batch.lanes; ++lane) {
            const Lit expected = truth[static_cast<std::size_t>(lane)];
            dark += expected == Lit::dark;
            clear += expected == Lit::clear;
            undecided += expected == Lit::undecided && lit.hit(lane);
            if (expected == Lit::undecided ||
                lit.visibility(lane) == (expected == Lit::dark ? 0.0f : 1.0f))
                continue;
            return testing::AssertionFailure() << shadow.id << ", view " << n << ", lane " << lane
                                               << ": " << (expected == Lit::dark ? "lit" : "dark");
        }
    }
    if (dark < (sanitized ? 8 : 100) || clear < (sanitized ? 1 : 30) || undecided > dark + clear)
        return testing::AssertionFailure()
               << dark << " dark, " << clear << " clear, " << undecided << " undecided";
    return testing::AssertionSuccess();
}

TEST(ImpostorShadow, IsThatOfTheSolids) {
    const BoundMaps whole{&maps().both}, apart{&maps().first, &maps().second};
    for (const Light kind : {Light::directional, Light::point}) {
        EXPECT_TRUE(shadows_as_the_solids_do(whole, {kind}));
        EXPECT_TRUE(shadows_as_the_solids_do(apart, {kind}));
    }
    const auto light_times = [](double by) {
        return [by](LitImpostor& lit) { lit.place_light(lit.light * by); };
    };
    EXPECT_FALSE(shadows_as_the_solids_do(whole, {.spoil = light_times(-1)})) << "the other way";
    EXPECT_FALSE(shadows_as_the_solids_do(whole, {.kind = Light::point, .spoil = light_times(4)}))
        << "what is behind the light";
    EXPECT_FALSE(shadows_as_the_solids_do(
        apart, {.spoil = [](LitImpostor& lit) { lit.batch.unbind(TextureSlot::layers_2); }}))
        << "a map forgotten";
    EXPECT_FALSE(shadows_as_the_solids_do(whole, {.id = "shadow-layers-exact"}))
        << "for rays out of a relief";
    EXPECT_FALSE(
        shadows_as_the_solids_do(whole, {.id = "shadow-impostor", .parameters = {{"steps", 3}}}));
}

/// A march of small steps is dark where the exact shadow is, but for what is thinner than they.
TEST(ImpostorShadow, SmallStepsComeDownOnTheExactOne) {
    Random random(17);
    const BoundMaps apart{&maps().first, &maps().second};
    int same_lanes = 0, lanes = 0, dark = 0;
    for (int n = 0; n < (sanitized ? 4 : 8); ++n) {
        LitImpostor lit(apart, Light::directional, random);
        Batch<float> exact = lit.batch;
        exact.run("shadow-impostor-exact");
        lit.batch.run("shadow-impostor", {{"steps", 1000}});
        for (int lane = 0; lane < exact.lanes; ++lane) {
            if (!lit.hit(lane)) continue;
            const float expected = exact.real(Value::shadow_visibility, lane);
            ++lanes;
            dark += expected == 0;
            same_lanes += lit.visibility(lane) == expected;
        }
    }
    EXPECT_GT(dark, sanitized ? 3 : 30);
    EXPECT_GE(same_lanes, lanes - lanes / 20) << "of " << lanes;
}

}  // namespace
}  // namespace quadrel::test::impostor
