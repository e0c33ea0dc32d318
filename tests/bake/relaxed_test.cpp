// Relaxed cones: the published search line by line, and what falling edges promise.
#include "bake/support.hpp"

namespace quadrel::test {
namespace {

// ---- The listing --------------------------------------------------------------------------------

struct Vec3 {
    float x, y, z;
};

Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }

/// tex2D(ReliefSampler, uv).w: depth, point-sampled.
float listed_depth(const Texture& field, const SamplerState& sampler, float u, float v) {
    const int i = static_cast<int>(std::floor(double(u) * field.view().width[0]));
    const int j = static_cast<int>(std::floor(double(v) * field.view().height[0]));
    return 1.0f - static_cast<float>(height_at(field, sampler, i, j));
}

/// GPU Gems 3, listing 18-1, for one source texel and one offset; `best_ratio` is the previous
/// pass's result.
float listed_pass(const Texture& field, const SamplerState& sampler, float s, float t,
                  float offset_x, float offset_y, float best_ratio, int search_steps) {
    const Vec3 src{s, t, 0};                             // float3 src = float3(TexCoord,0);
    Vec3 dst = src + Vec3{offset_x, offset_y, 0};        // float3 dst = src + Offset;
    dst.z = listed_depth(field, sampler, dst.x, dst.y);  // dst.z = tex2D(ReliefSampler,dst.xy).w;
    Vec3 vec{dst.x - src.x, dst.y - src.y, dst.z};       // float3 vec = dst - src;
    const float z = vec.z;
    vec = {vec.x / z, vec.y / z, vec.z / z};  // vec /= vec.z;
    const float rest = 1.0f - dst.z;
    vec = {vec.x * rest, vec.y * rest, vec.z * rest};  // vec *= 1.0 - dst.z;
    const auto n = static_cast<float>(search_steps);
    const Vec3 step_fwd{vec.x / n, vec.y / n, vec.z / n};  // float3 step_fwd = vec/search_steps;
    Vec3 ray_pos = dst + step_fwd;                         // float3 ray_pos = dst + step_fwd;
    for (int i = 1; i < search_steps; i++) {               // for(int i=1;i<search_steps;i++)
        const float current_depth = listed_depth(field, sampler, ray_pos.x, ray_pos.y);
        if (current_depth <= ray_pos.z)    // if(current_depth<=ray_pos.z)
            ray_pos = ray_pos + step_fwd;  //   ray_pos+=step_fwd;
    }
    const float src_texel_depth = listed_depth(field, sampler, s, t);
    const float x = ray_pos.x - s, y = ray_pos.y - t;
    float cone_ratio = ray_pos.z >= src_texel_depth  // float cone_ratio=(ray_pos.z>=...)?1.0:
                           ? 1.0f
                           : std::sqrt(x * x + y * y) / (src_texel_depth - ray_pos.z);
    if (cone_ratio > best_ratio) cone_ratio = best_ratio;  // if(cone_ratio>best_ratio) ...
    return cone_ratio;
}

/// All passes for one texel: every offset that can reach into a cone of ratio 1.
float listed_ratio(const Texture& field, const SamplerState& sampler, int i, int j, int steps) {
    const int width = field.view().width[0], height = field.view().height[0];
    const float s = (float(i) + 0.5f) / float(width), t = (float(j) + 0.5f) / float(height);
    float best = 1;
    for (int dj = -height; dj <= height; ++dj) {
        for (int di = -width; di <= width; ++di) {
            if (di == 0 && dj == 0) continue;
            best = listed_pass(field, sampler, s, t, float(di) / float(width),
                               float(dj) / float(height), best, steps);
        }
    }
    return best;
}

MapCheck is_the_listing(int steps) {
    return [=](const Texture& map, const Texture& field, const SamplerState& sampler) {
        const int width = map.view().width[0], height = map.view().height[0];
        for (int k = 0; k < width * height; ++k) {
            const float got = texel_of(map, 0, 0, k % width, k / width, 1);
            const float listed = listed_ratio(field, sampler, k % width, k / width, steps);
            if (got != listed)
                return testing::AssertionFailure() << "texel " << k % width << " " << k / width
                                                   << ": " << got << ", listed " << listed;
        }
        return testing::AssertionSuccess();
    };
}

testing::AssertionResult follows_the_listing(const Baker& baked, int steps) {
    const Texels noise = random_field(9, 7, 21);
    const Texels hills = make_field(
        12, 10, [](int i, int j) { return 0.05 + ((i - 5) * (i - 5) + j * j) % 37 / 41.0; });
    // Ridges that rays come out of far behind where they went in.
    const Texels ridges = make_field(15, 4, [](int i, int j) {
        const double far = std::abs(i - 6 - j / 3.0) / 5, near = std::abs(i - 12.0) / 2;
        return std::max({0.05, 0.97 - far * far, 0.6 - near}) - (i + j) % 3 / 500.0;
    });
    int turn = 0;
    for (const Texels& field : {noise, hills, ridges}) {
        for (const Wrap wrap : all_wraps) {
            const SamplerState sampler = sampler_with(wrap, all_wraps[turn++ % 4]);
            const auto result = is_the_listing(steps)(*baked(*field, sampler), *field, sampler);
            if (!result) return result;
        }
    }
    return testing::AssertionSuccess();
}

TEST(RelaxedCone, FollowsTheListing) {
    EXPECT_TRUE(follows_the_listing(baker(BakeKind::relaxed_cone), 128));
    BakeOptions fewer;
    fewer.parameters["steps"] = 127;
    EXPECT_TRUE(follows_the_listing(baker(BakeKind::relaxed_cone, fewer), 127));
    EXPECT_FALSE(follows_the_listing(baker(BakeKind::relaxed_cone, fewer), 128))
        << static_cast<int>(Planted::early_exit);
}

/// Where the listing divides by 0, a texel that is as high as can be, the cone stays outside of it.
TEST(RelaxedCone, StaysOutsideOfTheHighestTexels) {
    const Texels field =
        make_field(9, 9, [](int i, int j) { return i == 4 && j == 4 ? 1.0 : 0.0; });
    const Texels map =
        bake(*field, BakeKind::relaxed_cone, sampler_with(Wrap::repeat, Wrap::repeat));
    EXPECT_FLOAT_EQ(texel_of(*map, 0, 0, 2, 4, 1), 2 / 9.0f);
    EXPECT_EQ(texel_of(*map, 0, 0, 4, 4, 1), 1.0f);
}

// ---- Falling edges ------------------------------------------------------------------------------

/// One ray from height `top` over texel (i, j) towards (di, dj), which is along an axis on which
/// the map has `side` texels: once below the field it stays below for as long as it is in the cone.
bool stays_below(const Texture& field, const SamplerState& sampler, int i, int j, int di, int dj,
                 int side, double top, double slope, double c) {
    const double own = height_at(field, sampler, i, j);
    bool below = false;
    for (int n = 0; n < 400; ++n) {
        const double t = n * 0.05, z = top - t / side / slope;
        if (z < own || t / side > c * (z - own)) break;
        const double h = bilinear_at(field, sampler, i + di * t, j + dj * t);
        if (below && h < z - 1e-9) return false;
        below |= h > z;
    }
    return true;
}

/// Rays along rows and columns, from over each texel's centre into its cone.
testing::AssertionResult pierces_once(const Baker& baked) {
    for (std::uint32_t seed = 1; seed < 5; ++seed) {
        const int width = seed == 4 ? 5 : 14, height = seed < 3 ? 1 : 9;
        const Texels field = random_field(width, height, seed);
        const SamplerState sampler =
            sampler_with(seed % 2 ? Wrap::repeat : Wrap::clamp_to_edge, Wrap::mirrored_repeat);
        const Texels map = baked(*field, sampler);
        for (int k = 0; k < width * height * 4 * 8 * 12; ++k) {
            const int i = k % width, j = k / width % height, way = k / width / height % 4;
            const int along = way % 2 ? 1 : -1, rest = k / width / height / 4;
            const double top = (rest % 8 + 1) / 8.0, slope = 0.08 * (rest / 8 + 1);
            if (stays_below(*field, sampler, i, j, way < 2 ? along : 0, way < 2 ? 0 : along,
                            way < 2 ? width : height, top, slope, texel_of(*map, 0, 0, i, j, 1)))
                continue;
            return testing::AssertionFailure()
                   << describe(*field, sampler) << " texel " << i << " " << j << " way " << way
                   << " top " << top << " slope " << slope;
        }
    }
    return testing::AssertionSuccess();
}

/// Never narrower than the conservative cone: only some of its texels bound it.
testing::AssertionResult is_wider(const Texture& map, const Texture& field,
                                  const SamplerState& sampler) {
    const Texels cone = bake(field, BakeKind::cone_robust, sampler);
    for (int k = 0; k < map.view().width[0] * map.view().height[0]; ++k) {
        const float c = texel_of(map, 0, 0, k % map.view().width[0], k / map.view().width[0], 1);
        const float least =
            texel_of(*cone, 0, 0, k % map.view().width[0], k / map.view().width[0], 1);
        if (c < least || c > 1) return testing::AssertionFailure() << c << " < " << least;
    }
    return testing::AssertionSuccess();
}

TEST(RelaxedConeExact, PiercesOnce) {
    const Baker real = baker(BakeKind::relaxed_cone_exact);
    EXPECT_TRUE(pierces_once(real));
    EXPECT_FALSE(pierces_once(changed(real, [](float v, int, int, int, int, int c) {
        return c == 1 ? 1.0f : v;
    }))) << static_cast<int>(Planted::open_cones);
    EXPECT_FALSE(pierces_once(changed(real, [](float v, int, int, int, int, int c) {
        return c == 1 ? std::min(v * 1.3f, 1.0f) : v;
    })));
    EXPECT_TRUE(holds_for_small_fields(real, is_wider));
    EXPECT_FALSE(holds_for_small_fields(
        changed(real, [](float v, int, int, int, int, int c) { return c == 1 ? v / 2 : v; }),
        is_wider))
        << static_cast<int>(Planted::ratio_halved);
}

/// A slope that rises away from the apex, ever less steeply, does not bound the cone: only its
/// crest does, at texel 11.
testing::AssertionResult passes_rising_slopes(const Baker& baked) {
    const auto height = [](int i) { return i < 12 ? 1 - (12 - i) * (12 - i) / 144.0 : 0.0; };
    const Texels hill = make_field(16, 1, [&](int i, int) { return height(i); });
    const Texels map = baked(*hill, sampler_with(Wrap::clamp_to_edge, Wrap::clamp_to_edge));
    // Of texels 3 to 5 the cone of texel 3 is the narrowest.
    const double crest = 8 / 16.0 / (height(11) - height(3));
    const float c = texel_of(*map, 0, 0, 4, 0, 1);
    if (std::abs(c - crest) < 1e-6) return testing::AssertionSuccess();
    return testing::AssertionFailure() << c << " for " << crest;
}

TEST(RelaxedConeExact, PassesRisingSlopes) {
    EXPECT_TRUE(passes_rising_slopes(baker(BakeKind::relaxed_cone_exact)));
    EXPECT_FALSE(passes_rising_slopes(baker(BakeKind::cone_robust)));
}

}  // namespace
}  // namespace quadrel::test
