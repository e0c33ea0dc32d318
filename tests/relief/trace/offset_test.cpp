// The shifts without a search: how long they are, where they are exact, which normal they read.
#include "relief/trace/trace_rows.hpp"

namespace quadrel::test {
namespace {

/// Rays at any angle up to 87 degrees over a noisy map.
struct OffsetInputs {
    Random random;
    Map map;
    Batch<float> batch;

    explicit OffsetInputs(int seed, float seat = 1)
        : random(static_cast<std::uint64_t>(seed)), map(noise_map(random, 16, 16)), batch(64) {
        fill_surface(batch, random, {0.05});
        batch.material.seat = seat;
        batch.bind(TextureSlot::height, map.sampled);
    }
};

// ---- Lengths ------------------------------------------------------------------------------------

/// What a shift is: (sigma - h) K times a factor of r and of the map's normal.
struct Shift {
    std::string id;
    std::function<double(double r)> factor;
    double seat = -1;  ///< the row's own; negative: the material's
};

std::vector<Shift> shifts() {
    return {
        {"parallax", [](double) { return 1.0; }},
        {"parallax-bias", [](double) { return 1.0; }, 0.5},
        {"offset-limit", [](double r) { return r; }},
        {"offset-limit-042", [](double r) { return r / (r + 0.42); }},
        {"offset-limit-fixed", [](double r) { return r / std::max(r, 0.25); }},
    };
}

/// In double, from the height that the stage reports.
testing::AssertionResult shifts_by(const Shift& shift, const std::string& id) {
    for (const float seat : {1.0f, 0.5f, 0.0f}) {
        OffsetInputs inputs(3, seat);
        Batch<float>& b = inputs.batch;
        b.run(id);
        const double sigma = shift.seat < 0 ? double(seat) : shift.seat;
        for (int lane = 0; lane < b.lanes; ++lane) {
            const double h = b.real(Value::hit_h, lane);
            const double factor = (sigma - h) * shift.factor(b.real(Value::r, lane));
            const auto expected =
                dvec2(b.vector2(Value::uv, lane)) + dvec2(b.vector2(Value::K, lane)) * factor;
            const auto off = dvec2(b.vector2(Value::hit_uv, lane)) - expected;
            if (length(off) < 2e-6 && b.integer(Value::hit_fetches, lane) == 1) continue;
            return testing::AssertionFailure() << id << ", lane " << lane << ": " << length(off);
        }
    }
    return testing::AssertionSuccess();
}

TEST(Offsets, AreTheHeightTimesTheRay) {
    const std::vector<Shift> all = shifts();
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_TRUE(shifts_by(all[i], all[i].id));
        EXPECT_FALSE(shifts_by(all[i], all[(i + 1) % all.size()].id));
    }
}

/// The limited ones stay within the depth in UV units (times 1 / r_min), however flat the view.
TEST(Offsets, LimitedOnesAreLimited) {
    for (const auto& [id, limit] : std::map<std::string, double>{{"offset-limit", 1},
                                                                 {"offset-limit-042", 1 / 0.42},
                                                                 {"offset-limit-fixed", 4},
                                                                 {"parallax-slope-nz", 1},
                                                                 {"parallax-slope-nv", 1}}) {
        OffsetInputs inputs(4);
        fill_surface(inputs.batch, inputs.random, {0.001});
        inputs.batch.run(id);
        double longest = 0;
        for (int lane = 0; lane < inputs.batch.lanes; ++lane) {
            const auto moved = dvec2(inputs.batch.vector2(Value::hit_uv, lane)) -
                               dvec2(inputs.batch.vector2(Value::uv, lane));
            longest = std::max(longest, length(moved) / inputs.batch.material.depth);
        }
        EXPECT_LE(longest, limit + 1e-4) << id;
        EXPECT_GT(longest, limit / 20) << id;
    }
}

/// Exact where the height is constant: the shift of a flat map is the way to it along the ray.
TEST(Offsets, ParallaxMeetsFlatMaps) {
    for (const char* id : {"parallax", "parallax-iter"}) {
        Random random(7);
        const Map map = flat_map(0.375f);
        Batch<float> batch(64);
        fill_surface(batch, random, {0.2});
        batch.bind(TextureSlot::height, map.sampled);
        batch.run(id, id == std::string("parallax") ? Parameters() : Parameters{{"exact", 1}});
        for (int lane = 0; lane < batch.lanes; ++lane) {
            EXPECT_NEAR(batch.real(Value::hit_s, lane), 0.625f, 1e-6f) << id;
        }
    }
}

// ---- Slopes -------------------------------------------------------------------------------------

/// A plane of heights around (0.5, 0.5), and its normal in the axes of the plane: (-D h_u, -D h_v,
/// 1) where a UV unit is a world unit.
struct Ramp {
    int b, c;
    Map map;

    Ramp(int b_of, int c_of)
        : b(b_of),
          c(c_of),
          map(height_map(
              64, 64,
              [=](int x, int y) { return 0.5f + static_cast<float>(b_of * x + c_of * y) / 4096; },
              Wrap::clamp_to_edge)) {}
    dvec3 normal(double depth) const {
        return normalize(dvec3(-depth * b / 64, -depth * c / 64, 1));
    }
};

/// The factor of a slope row is nz or nv of that plane.
testing::AssertionResult slope_is(const std::string& id, bool by_view, bool with_map) {
    const Ramp ramp(30, -50);
    Random random(8);
    Batch<float> b(64);
    fill_surface(b, random, {0.1, 0.5});
    b.bind(TextureSlot::height, ramp.map.sampled);
    const dvec3 n = ramp.normal(0.5);
    const Map normals = make_map(
        2, 2, 4, [&](int, int, int k) { return k < 3 ? float(0.5 + 0.5 * n[k]) : 1; },
        plain_sampler());
    if (with_map) b.bind(TextureSlot::normal, normals.sampled);
    for (int lane = 0; lane < b.lanes; ++lane) b.set(Value::uv, lane, dvec2(0.5, 0.5));
    b.run(id);
    for (int lane = 0; lane < b.lanes; ++lane) {
        const dvec3 V = normalize(-dvec3(b.vector3(Value::P, lane)));
        const dvec3 N = dvec3(b.vector3(Value::T, lane)) * n.x +
                        dvec3(b.vector3(Value::B, lane)) * n.y +
                        dvec3(b.vector3(Value::frame_normal, lane)) * n.z;
        const double factor = by_view ? std::max(dot(N, V), 0.0) : n.z;
        const double r = b.real(Value::r, lane), h = b.real(Value::hit_h, lane);
        const auto expected = dvec2(b.vector2(Value::uv, lane)) +
                              dvec2(b.vector2(Value::K, lane)) * ((1 - h) * r * factor);
        const double off = length(dvec2(b.vector2(Value::hit_uv, lane)) - expected);
        const bool fetches = b.integer(Value::hit_fetches, lane) == (with_map ? 2 : 5);
        if (off < 1e-5 && fetches) continue;
        return testing::AssertionFailure() << off << " in lane " << lane;
    }
    return testing::AssertionSuccess();
}

TEST(Offsets, SlopesAreTheMapsOrTheHeightsOwn) {
    for (const bool with_map : {false, true}) {
        EXPECT_TRUE(slope_is("parallax-slope-nz", false, with_map));
        EXPECT_TRUE(slope_is("parallax-slope-nv", true, with_map));
        EXPECT_FALSE(slope_is("parallax-slope-nz", true, with_map));
        EXPECT_FALSE(slope_is("parallax-slope-nv", false, with_map));
        EXPECT_FALSE(slope_is("offset-limit", false, with_map));
    }
}

/// Where a ray from the middle of the ramp meets it, in s.
double ramp_crossing(const Ramp& ramp, Batch<float>& b, int lane) {
    const auto K = b.vector2(Value::K, lane);
    const double slope = (ramp.b * double(K.x) + ramp.c * double(K.y)) / 64;
    const double at_start = 0.5 + (ramp.b + ramp.c) * 31.5 / 4096;
    return (1 - at_start) / (1 + slope);
}

/// Largest distance from the plane's crossing over the lanes that stay on the ramp.
double largest_error(const Parameters& parameters) {
    const Ramp ramp(20, -15);
    Random random(9);
    Batch<float> b(64);
    fill_surface(b, random, {0.5, 0.2});
    b.bind(TextureSlot::height, ramp.map.sampled);
    for (int lane = 0; lane < b.lanes; ++lane) b.set(Value::uv, lane, dvec2(0.5, 0.5));
    b.run("parallax-iter", parameters);
    double largest = 0;
    for (int lane = 0; lane < b.lanes; ++lane) {
        const double off = b.real(Value::hit_s, lane) - ramp_crossing(ramp, b, lane);
        largest = std::max(largest, std::abs(off));
    }
    return largest;
}

TEST(Offsets, IterationsApproachAPlane) {
    EXPECT_LT(largest_error({{"exact", 1}, {"iterations", 1}}), 1e-5);
    EXPECT_LT(largest_error({{"exact", 1}, {"iterations", 5}}), 1e-5);
    double before = 1;
    for (const int k : {1, 2, 4, 8, 16}) {
        const double error = largest_error({{"iterations", k}});
        EXPECT_LT(error, before) << k;
        before = error;
    }
    EXPECT_LT(before, 1e-2);
    EXPECT_GT(largest_error({{"iterations", 1}}), 1e-2);
}

/// Each iteration is one step and looks up a height and four neighbours, or a normal.
TEST(Offsets, IterationsAreCounted) {
    OffsetInputs inputs(5, 0.5f);
    inputs.batch.run("parallax-iter", {{"iterations", 3}});
    EXPECT_EQ(inputs.batch.integer(Value::hit_steps, 9), 3);
    EXPECT_EQ(inputs.batch.integer(Value::hit_fetches, 9), 15);
    EXPECT_EQ(inputs.batch.fetches(), 64u * 15);
    for (int lane = 0; lane < inputs.batch.lanes; ++lane) {
        const float s = inputs.batch.real(Value::hit_s, lane);
        EXPECT_TRUE(s >= 0 && s <= 1);
    }
}

/// Without depth: the UV as it was, also after iterations.
TEST(Offsets, IterationsWithoutDepthMoveNothing) {
    OffsetInputs inputs(6, 0.25f);
    inputs.batch.material.depth = 0;
    for (int lane = 0; lane < 64; ++lane) inputs.batch.set(Value::K, lane, dvec2(0));
    inputs.batch.run("parallax-iter");
    for (int lane = 0; lane < 64; ++lane) {
        EXPECT_EQ(inputs.batch.vector2(Value::hit_uv, lane), inputs.batch.vector2(Value::uv, lane));
    }
}

/// A shift says at which depth its height lies, from the polygon on.
TEST(Offsets, DepthIsThatOfTheHeight) {
    OffsetInputs inputs(7, 0.5f);
    Batch<float>& b = inputs.batch;
    for (const char* id : {"parallax", "offset-limit", "offset-limit@published"}) {
        b.run(id);
        for (int lane = 0; lane < b.lanes; ++lane) {
            const float h = b.real(Value::hit_h, lane);
            EXPECT_EQ(b.real(Value::hit_s, lane), 1 - h);
            EXPECT_EQ(b.real(Value::hit_depth, lane), (1 - h - 0.5f) * b.material.depth);
        }
    }
}

}  // namespace
}  // namespace quadrel::test
