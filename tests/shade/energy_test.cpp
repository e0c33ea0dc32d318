// What any reflection must obey: reciprocity, and no more light than arrives.
#include "shade/lighting.hpp"

namespace quadrel::test {
namespace {

// ---- Reciprocity and energy ---------------------------------------------------------------------

/// White light of one intensity from L, seen from V, over N = z; white material.
void place(Batch<float>& batch, int lane, const dvec3& L, const dvec3& V) {
    batch.set(Value::N, lane, dvec3(0, 0, 1));
    batch.set(Value::hit_P, lane, -L);
    batch.set(Value::P, lane, -V);
}
Batch<float> white_batch(float shininess) {
    Random random(1);
    Batch<float> batch = random_points(random, 1, batch_lanes);
    LightUniforms& light = batch.frame.lights[0];
    light = {{0, 0, 0}, 0, {0, 0, 0}, {1, 1, 1}, {1, 1, 1}, 1, {1, 0, 0}};
    std::fill_n(batch.material.specular, 3, 1.0f);
    std::fill_n(batch.material.diffuse, 3, 1.0f);
    std::fill_n(batch.material.emission, 3, 0.0f);
    batch.material.shininess = shininess;
    each_lane(batch, [&](int lane) { batch.real(Value::shadow_visibility, lane) = 1; });
    return batch;
}
dvec3 upwards(Random& random) {
    dvec3 d = random_direction(random);
    d.z = std::abs(d.z) + 0.02;
    return normalize(d);
}

/// f(L, V) = f(V, L): the reflected light over its cosine.
testing::AssertionResult is_reciprocal(const std::string& id) {
    Random random(2);
    Batch<float> one = white_batch(20);
    Batch<float> other = one;
    std::vector<double> cosines;
    each_lane(one, [&](int lane) {
        const dvec3 L = upwards(random), V = upwards(random);
        place(one, lane, L, V);
        place(other, lane, V, L);
        cosines.push_back(L.z / V.z);
    });
    one.run(id);
    other.run(id);
    for (int lane = 0; lane < one.lanes; ++lane) {
        const double a = one.real(Value::color, lane) / cosines[static_cast<std::size_t>(lane)];
        const double b = other.real(Value::color, lane);
        if (!(std::abs(a - b) <= 1e-3 * (std::abs(a) + std::abs(b))))
            return testing::AssertionFailure() << id << ": " << a << " and " << b;
    }
    return testing::AssertionSuccess();
}

TEST(ReflectionModels, LambertCookTorranceAndRabbidAreReciprocal) {
    for (const char* id :
         {"shade-lambert", "shade-cook-torrance", "shade-rabbid", "shade-metallic-roughness"})
        EXPECT_TRUE(is_reciprocal(id));
    EXPECT_FALSE(is_reciprocal("shade-blinn-phong"));
    EXPECT_FALSE(is_reciprocal("shade-rabbid@published"));
}

/// The part of a white sky's light that the term sends to a viewer at this elevation: the mean over
/// directions, weighted as a light of every direction is.
double reflected_part(const std::string& id, Value term, float shininess, double cosine) {
    constexpr int rings = 128, sectors = 64;
    const dvec3 V(std::sqrt(1 - cosine * cosine), 0, cosine);
    Batch<float> batch = white_batch(shininess);
    double sum = 0;
    for (int first = 0; first < rings * sectors; first += batch.lanes) {
        each_lane(batch, [&](int lane) {
            const int k = first + lane;
            const double z = (k / sectors + 0.5) / rings, r = std::sqrt(1 - z * z);
            const double phi = 2 * 3.141592653589793 * (k % sectors + 0.5) / sectors;
            place(batch, lane, {r * cos(phi), r * sin(phi), z}, V);
        });
        batch.run(id);
        each_lane(batch, [&](int lane) { sum += batch.real(term, lane); });
    }
    // Light of irradiance pi over 2 pi steradians, a sky of radiance 1.
    return sum * 2 / (rings * sectors);
}

TEST(ReflectionModels, AWhiteMatteSurfaceReflectsAllLight) {
    for (const double cosine : {1.0, 0.5, 0.1})
        EXPECT_NEAR(reflected_part("shade-lambert", Value::light_diffuse, 0, cosine), 1, 1e-3);
}

/// Facets that mirror all light lose only what grooves hide, and never make any.
testing::AssertionResult keeps_its_energy(double gain) {
    for (const float shininess : {2.0f, 10.0f, 40.0f}) {
        for (const double cosine : {1.0, 0.7, 0.4, 0.15}) {
            const double part = gain * reflected_part("shade-cook-torrance", Value::light_specular,
                                                      shininess, cosine);
            if (!(part <= 1.001 && part > 0.3))
                return testing::AssertionFailure()
                       << part << " at shininess " << shininess << ", cosine " << cosine;
        }
    }
    return testing::AssertionSuccess();
}

TEST(CookTorrance, MakesNoLight) {
    EXPECT_TRUE(keeps_its_energy(1));
    EXPECT_FALSE(keeps_its_energy(4));  // the paper's divisor
    EXPECT_GT(reflected_part("shade-cook-torrance", Value::light_specular, 40, 1), 0.9);
}

/// shade-rabbid's highlight has one energy, whatever its size; Phong's has not.
TEST(Rabbid, HighlightsOfEverySizeHaveOneEnergy) {
    const auto ratio = [](const char* id) {
        return reflected_part(id, Value::light_specular, 40, 1) /
               reflected_part(id, Value::light_specular, 160, 1);
    };
    EXPECT_NEAR(ratio("shade-rabbid"), 1, 0.08);
    EXPECT_GT(ratio("shade-blinn-phong"), 2);
}

/// `roughness` in place of the exponent.
TEST(CookTorrance, RoughnessIsTheSlope) {
    Random random(5);
    Batch<float> one = random_points(random, 2), other = one;
    one.material.shininess = 6;  // m^2 = 2 / 8
    one.run("shade-cook-torrance");
    other.run("shade-cook-torrance", {{"roughness", 0.5}});
    constexpr auto term = values(Value::light_specular);
    EXPECT_TRUE(same_bits<float>(one, other, term));
    other.run("shade-cook-torrance", {{"roughness", 0.4}});
    EXPECT_FALSE(same_bits<float>(one, other, term));
}

}  // namespace
}  // namespace quadrel::test
