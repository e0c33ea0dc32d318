// true-impostor and its frame: rays from all sides at spheres in depth layers, against the spheres
// themselves; solids by parity, whichever map they are in; what rays pass and where they end.
#include "relief/layer/impostor_views.hpp"

namespace quadrel::test::impostor {
namespace {

using Bind = std::function<void(Batch<double>&)>;
void bind_both(Batch<double>& batch) { batch.bind(TextureSlot::layers, maps().both.sampled); }

/// A search of 64 rays a view takes a tenth of a second at -O0.
constexpr int views = 12;

/// Runs the frame and the search over views, and has each lane looked at.
testing::AssertionResult each_ray(
    const Bind& bind, const std::function<void(Batch<double>&)>& spoil,
    const std::function<testing::AssertionResult(Batch<double>&, int, const View&)>& look) {
    Random random(31);
    for (int n = 0; n < views; ++n) {
        const View view(random);
        Batch<double> batch(64);
        batch.own_depth = true;
        bind(batch);
        for (int lane = 0; lane < batch.lanes; ++lane) fill_lane(batch, lane, view, random);
        if (spoil) spoil(batch);
        batch.run("frame-impostor");
        batch.run("true-impostor", {{"steps", 192}, {"binary_steps", 12}});
        batch.run("displace");
        for (int lane = 0; lane < batch.lanes; ++lane)
            if (auto seen = look(batch, lane, view); !seen) return seen << ", lane " << lane;
    }
    return testing::AssertionSuccess();
}

/// Hits lie on the balls, within what texels make of them; rays that clearly meet a ball hit, rays
/// that clearly do not, miss.
testing::AssertionResult finds_the_balls(const Bind& bind,
                                         const std::function<void(Batch<double>&)>& spoil = {}) {
    int hits = 0, misses = 0, behind = 0;
    auto result = each_ray(bind, spoil, [&](Batch<double>& batch, int lane, const View& view) {
        const dvec3 P(batch.vector3(Value::P, lane));
        const dvec3 direction = normalize(P);
        const dvec3 from = view.in_object(dvec3(0) - view.origin), way = view.in_object(direction);
        const dvec3 unit = normalize(way);
        const double texel = tile / side;
        const bool surely = meets(from, unit, -4 * texel) < never;
        const bool surely_not = meets(from, unit, 2 * texel) == never;
        const auto status = static_cast<Status>(batch.integer(Value::hit_status, lane));
        if (surely && status != Status::hit) return testing::AssertionFailure() << "passes a ball";
        if (surely_not && status != Status::clip)
            return testing::AssertionFailure() << "hits nothing";
        misses += surely_not;
        if (!surely) return testing::AssertionSuccess();
        ++hits;
        behind += batch.real(Value::hit_depth, lane) < 0;
        const dvec3 hit = view.in_object(dvec3(batch.vector3(Value::hit_P, lane)) - view.origin);
        const double expected = meets(from, unit), found = dot(hit - from, unit);
        // Rims are a texel wide and as steep as a ray may be flat.
        if (!(std::abs(found - expected) <= 12 * texel))
            return testing::AssertionFailure() << found << " in place of " << expected;
        const dvec3 place =
            dvec3(batch.real(Value::hit_uv, lane, 0), batch.real(Value::hit_uv, lane, 1),
                  1 - batch.real(Value::hit_s, lane)) -
            dvec3(0.5);
        if (!(length(place * dvec3(tile, tile, thickness) - hit) <= 1e-9))
            return testing::AssertionFailure() << "another place in the map";
        return testing::AssertionSuccess();
    });
    if (!result) return result;
    if (hits < 60 || misses < 60 || behind < 15)
        return testing::AssertionFailure() << hits << " hits, " << misses << " misses";
    return testing::AssertionSuccess();
}

/// Of volumes whose depth has hardly an inverse, or none, all that is stored is a number.
TEST(TrueImpostor, VolumesWithoutThicknessLeaveNumbers) {
    Random random(32);
    for (const float depth : {1e-36f, 3e-39f, 6.4e-41f, 0.0f})
        for (const Status framed : {Status::hit, Status::no_frame}) {
            Batch<float> batch(64);
            batch.own_depth = true;
            batch.bind(TextureSlot::layers, maps().both.sampled);
            const View view(random);
            for (int lane = 0; lane < batch.lanes; ++lane) fill_lane(batch, lane, view, random);
            batch.run("frame-impostor");
            for (int lane = 0; lane < batch.lanes; ++lane) {
                batch.real(Value::relief_depth, lane) = depth;
                batch.integer(Value::frame_status, lane) = static_cast<int>(framed);
            }
            batch.run("true-impostor");
            for (int lane = 0; lane < batch.lanes; ++lane)
                for (const Value v : {Value::hit_uv, Value::hit_s, Value::hit_h, Value::hit_depth})
                    for (int c = 0; c < info(v).components; ++c)
                        EXPECT_TRUE(std::isfinite(batch.real(v, lane, c)))
                            << info(v).name << " of depth " << depth << ", lane " << lane;
        }
}

TEST(TrueImpostor, FindsWhatIsInTheLayersFromAllSides) {
    EXPECT_TRUE(finds_the_balls(bind_both));
    const auto negated = [](Value v) {
        return [v](Batch<double>& batch) {
            for (int lane = 0; lane < batch.lanes; ++lane)
                batch.set(v, lane, dvec3(0) - dvec3(batch.vector3(v, lane)));
        };
    };
    EXPECT_FALSE(finds_the_balls(bind_both, negated(Value::object_z))) << "back to front";
    EXPECT_FALSE(finds_the_balls(bind_both, negated(Value::object_x))) << "mirrored";
    EXPECT_FALSE(finds_the_balls(bind_both, [](Batch<double>& batch) {
        for (int lane = 0; lane < batch.lanes; ++lane) batch.real(Value::relief_depth, lane) *= 1.2;
    })) << "too deep";
    EXPECT_FALSE(finds_the_balls([](Batch<double>& batch) {
        batch.bind(TextureSlot::layers, maps().first.sampled);
    })) << "a solid lost";
}

/// The same solids in other maps are the same solids, bit for bit.
TEST(TrueImpostor, SolidsMayBeInAnyMap) {
    const std::vector<std::array<const Map*, 3>> ways{
        {&maps().first, &maps().second, nullptr},
        {&maps().first, nullptr, &maps().second},
        {&maps().nothing, &maps().first, &maps().second},
        {&maps().both, &maps().nothing, &maps().nothing}};
    const auto hits_of = [](const std::array<const Map*, 3>& way) {
        std::vector<double> hits;
        const Bind bind = [&](Batch<double>& batch) {
            constexpr TextureSlot slots[] = {TextureSlot::layers, TextureSlot::layers_2,
                                             TextureSlot::layers_3};
            for (std::size_t i = 0; i < 3; ++i)
                if (way[i] != nullptr) batch.bind(slots[i], way[i]->sampled);
        };
        EXPECT_TRUE(each_ray(bind, {}, [&](Batch<double>& batch, int lane, const View&) {
            hits.push_back(batch.real(Value::hit_depth, lane));
            hits.push_back(batch.real(Value::hit_h, lane));
            hits.push_back(batch.integer(Value::hit_status, lane));
            return testing::AssertionSuccess();
        }));
        return hits;
    };
    const std::vector<double> whole = hits_of({&maps().both, nullptr, nullptr});
    for (const auto& way : ways) EXPECT_EQ(hits_of(way), whole);
    EXPECT_NE(hits_of({&maps().second, &maps().second, nullptr}), whole)
        << "a solid twice is none, by parity";
}

/// One more step of the same length finds nothing earlier: late by a part of a step, never early.
TEST(TrueImpostor, IsNeverEarly) {
    EXPECT_TRUE(each_ray(bind_both, {}, [](Batch<double>& batch, int lane, const View&) {
        if (batch.integer(Value::hit_status, lane) != static_cast<int>(Status::hit))
            return testing::AssertionSuccess();
        // The hit is inside: an odd number of the bilinear depths there are at or above s.
        const dvec2 uv(batch.vector2(Value::hit_uv, lane));
        int passed = 0;
        for (int c = 0; c < 4; ++c)
            passed += depth_at(maps().both, uv, c) <= batch.real(Value::hit_s, lane) + 1e-12;
        return passed % 2 == 1 ? testing::AssertionSuccess()
                               : testing::AssertionFailure() << "outside";
    }));
}

/// Cards without UV, and without depth.
TEST(TrueImpostor, DegenerateCards) {
    Random random(3);
    Batch<double> batch(16);
    batch.own_depth = true;
    bind_both(batch);
    const View view(random);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        fill_lane(batch, lane, view, random);
        if (lane < 8)
            for (int c = 0; c < 6; ++c) batch.real(Value::face_J, lane, c) = 0;
        else
            batch.real(Value::relief_depth, lane) = 0;
    }
    batch.run("frame-impostor");
    batch.run("true-impostor");
    for (int lane = 0; lane < batch.lanes; ++lane) {
        EXPECT_EQ(batch.integer(Value::hit_status, lane),
                  static_cast<int>(lane < 8 ? Status::no_frame : Status::clip));
        EXPECT_EQ(batch.real(Value::hit_depth, lane), 0);
    }
}

/// The normals of hits are those of the balls, on either map.
TEST(TrueImpostor, NormalsAreThoseOfTheBalls) {
    const auto normals_fit = [](const Bind& bind, const char* surface) {
        std::vector<double> errors;
        const auto seen = each_ray(bind, {}, [&](Batch<double>& batch, int lane, const View& view) {
            if (lane == 0) batch.run(surface);
            if (batch.integer(Value::hit_status, lane) != static_cast<int>(Status::hit))
                return testing::AssertionSuccess();
            const dvec3 hit =
                view.in_object(dvec3(batch.vector3(Value::hit_P, lane)) - view.origin);
            dvec3 expected(0);
            double nearest = never;
            for (const Ball& ball : balls())
                if (const double off = std::abs(length(hit - ball.centre) - ball.radius);
                    off < nearest) {
                    nearest = off;
                    expected = normalize(hit - ball.centre);
                }
            // At rims slopes are those of a texel's wall.
            if (std::abs(expected.z) < 0.4) return testing::AssertionSuccess();
            const dvec3 N(batch.vector3(Value::N, lane));
            errors.push_back(length(normalize(view.in_object(N)) - expected));
            return testing::AssertionSuccess();
        });
        if (!seen) return seen;
        std::sort(errors.begin(), errors.end());
        if (errors.size() < 60) return testing::AssertionFailure() << errors.size() << " normals";
        const double most = errors[errors.size() * 95 / 100];
        return most < 0.1 ? testing::AssertionSuccess()
                          : testing::AssertionFailure() << "off by " << most;
    };
    const Bind apart = [](Batch<double>& batch) {
        batch.bind(TextureSlot::layers, maps().first.sampled);
        batch.bind(TextureSlot::layers_2, maps().second.sampled);
    };
    EXPECT_TRUE(normals_fit(bind_both, "h2n-impostor"));
    EXPECT_TRUE(normals_fit(apart, "h2n-impostor"));
    EXPECT_TRUE(normals_fit(bind_both, "h2n-layers"));
    EXPECT_FALSE(normals_fit(apart, "h2n-layers")) << "does not see the second map";
}

}  // namespace
}  // namespace quadrel::test::impostor
