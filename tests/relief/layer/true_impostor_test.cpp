// true-impostor and its frame: rays from all sides at spheres in depth layers, against the spheres
// themselves; solids by parity, whichever map they are in; what rays pass and where they end.
#include "relief/layer/layer_maps.hpp"

namespace quadrel::test {
namespace {

/// Two spheres along z in a volume of 2 x 2 x 3 units around the origin, and what is nearest along
/// a ray.
struct Ball {
    dvec3 centre;
    double radius;
};
constexpr double tile = 2, thickness = 3;
const std::vector<Ball>& balls() {
    static const std::vector<Ball> all{{dvec3(0.1, -0.05, 0.8), 0.6}, {dvec3(0, 0.1, -0.85), 0.5}};
    return all;
}

constexpr double never = 1e9;
/// The least t at which origin + t direction (unit) is in a ball, grown by `more`.
double meets(const dvec3& origin, const dvec3& direction, double more = 0) {
    double nearest = never;
    for (const Ball& ball : balls()) {
        const dvec3 to = ball.centre - origin;
        const double along = dot(to, direction), radius = ball.radius + more;
        const double half = radius * radius - (dot(to, to) - along * along);
        if (half >= 0) nearest = std::min(nearest, along - std::sqrt(half));
    }
    return nearest;
}

/// Front and back of a ball under a texel, as depths; in its middle where it is not.
std::array<float, 2> ball_depths(const Ball& ball, double x, double y) {
    const double aside =
        (x - ball.centre.x) * (x - ball.centre.x) + (y - ball.centre.y) * (y - ball.centre.y);
    const double half = std::sqrt(std::max(ball.radius * ball.radius - aside, 0.0));
    const auto depth = [&](double z) { return static_cast<float>(0.5 - z / thickness); };
    return {depth(ball.centre.z + half), depth(ball.centre.z - half)};
}

constexpr int side = 128;
/// Four depths of every texel; `pairs` are balls, or none (-1): closed at the bottom.
Map depths_map(const std::array<int, 2>& pairs) {
    SamplerState sampler = plain_sampler();
    sampler.wrap_u = sampler.wrap_v = Wrap::clamp_to_edge;
    return make_map(
        side, side, 4,
        [&](int i, int j, int c) {
            const int ball = pairs[static_cast<std::size_t>(c / 2)];
            if (ball < 0) return 1.0f;
            const auto at = [](int k) { return ((k + 0.5) / side - 0.5) * tile; };
            return ball_depths(balls()[static_cast<std::size_t>(ball)], at(i),
                               at(j))[static_cast<std::size_t>(c % 2)];
        },
        sampler);
}

struct Maps {
    Map both = depths_map({0, 1}), first = depths_map({0, -1}), second = depths_map({1, -1}),
        nothing = depths_map({-1, -1});
};
const Maps& maps() {
    static const Maps all;
    return all;
}

/// A view of the volume: an object turned at will, far from the eye or near, and a card through its
/// origin.
struct View {
    dvec3 x, y, z;    ///< the object's axes in eye space, unit
    dvec3 origin;     ///< the object's
    double scale;     ///< eye-space units of one of the object's
    dvec3 right, up;  ///< of the card

    explicit View(Random& random) {
        z = random_direction(random);
        x = normalize(cross(z, random_direction(random)));
        y = cross(z, x);
        scale = random.uniform(0.3, 3);
        const dvec3 towards = normalize(random_direction(random) * 0.3 + dvec3(0, 0, -1));
        origin = towards * (scale * random.uniform(3, 9));
        right = normalize(cross(towards, dvec3(0.1, 1, 0)));
        up = cross(right, towards);
    }
    /// A point or vector of eye space in the object's.
    dvec3 in_object(const dvec3& v) const { return dvec3(dot(x, v), dot(y, v), dot(z, v)) / scale; }
};

void fill_lane(Batch<double>& batch, int lane, const View& view, Random& random) {
    const double a = random.uniform(-1.7, 1.7), b = random.uniform(-1.7, 1.7);
    batch.set(Value::P, lane, view.origin + (view.right * a + view.up * b) * view.scale);
    batch.set(Value::uv, lane, dvec2(a / tile + 0.5, b / tile + 0.5));
    for (int c = 0; c < 3; ++c) {
        batch.real(Value::face_J, lane, c) = view.right[c] / (tile * view.scale);
        batch.real(Value::face_J, lane, 3 + c) = view.up[c] / (tile * view.scale);
    }
    // Of a normal matrix.
    batch.set(Value::object_x, lane, view.x / view.scale);
    batch.set(Value::object_y, lane, view.y / view.scale);
    batch.set(Value::object_z, lane, view.z / view.scale);
    batch.real(Value::relief_depth, lane) = thickness * view.scale;
}

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
        const TextureView& view = maps().both.sampled.view;
        const auto place = [&](int axis) {
            return std::clamp(batch.real(Value::hit_uv, lane, axis) * side - 0.5, 0.0,
                              side - 1.0 - 1e-9);
        };
        const int i = static_cast<int>(place(0)), j = static_cast<int>(place(1));
        const double f = place(0) - i, g = place(1) - j;
        int passed = 0;
        for (int c = 0; c < 4; ++c) {
            const auto texel = [&](int di, int dj) {
                return double(view.texels[((j + dj) * side + i + di) * 4 + c]);
            };
            const double depth = (texel(0, 0) * (1 - f) + texel(1, 0) * f) * (1 - g) +
                                 (texel(0, 1) * (1 - f) + texel(1, 1) * f) * g;
            passed += depth <= batch.real(Value::hit_s, lane) + 1e-12;
        }
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
}  // namespace quadrel::test
