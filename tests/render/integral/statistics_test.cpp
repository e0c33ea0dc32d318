// Integrals over pixels against means that are known: they lie as far off as their standard errors
// say, and these fall with the number of samples.
#include <random>

#include "render/integral/integral_scene.hpp"
#include "render/integral/integrals.hpp"
#include "render/integral/pattern.hpp"

namespace quadrel::render_tests {
namespace {

/// How far means are off, over the pixels that an edge crosses.
struct Offs {
    int pixels = 0;
    int within[3]{};           ///< one, two, three standard errors
    double squares = 0;        ///< of what they are off by
    double error_squares = 0;  ///< of the standard errors
    double sum = 0;            ///< of what they are off by, with its sign
    double rms() const { return std::sqrt(squares / pixels); }
};

Offs offs_of(const TriangleField& field, const Film& film) {
    Offs offs;
    for (int y = 0; y < field.scene.height; ++y)
        for (int x = 0; x < field.scene.width; ++x) {
            const double area = field.area(x, y);
            if (area < 0.1 || area > 0.9) continue;
            const double off = value(film, "R", x, y) - field.mean(x, y);
            const double error = value(film, "integral.error.R", x, y);
            ++offs.pixels;
            for (int k = 0; k < 3; ++k) offs.within[k] += std::abs(off) <= (k + 1) * error;
            offs.squares += off * off;
            offs.error_squares += error * error;
            offs.sum += off;
        }
    return offs;
}

/// The means are the areas', and one, two and three standard errors hold them as often as an
/// estimate from 16 replicates should (Student's t of 15 degrees of freedom), within 4 standard
/// deviations of such counts.
testing::AssertionResult holds_the_mean(const Integrator& integrator) {
    const TriangleField field(14);
    const Offs offs = offs_of(field, integrator(field.scene, {256, 0}));
    const double expected[] = {0.6668, 0.9361, 0.9910};
    for (int k = 0; k < 3; ++k) {
        const double share = static_cast<double>(offs.within[k]) / offs.pixels;
        const double deviation = std::sqrt(expected[k] * (1 - expected[k]) / offs.pixels);
        if (std::abs(share - expected[k]) > 4 * deviation + 0.01)
            return testing::AssertionFailure()
                   << share << " of " << offs.pixels << " are within " << k + 1
                   << " standard errors, expected " << expected[k];
    }
    const double of_mean = std::sqrt(offs.error_squares) / offs.pixels;
    if (std::abs(offs.sum / offs.pixels) > 4 * of_mean)
        return testing::AssertionFailure() << "off by " << offs.sum / offs.pixels << " on average";
    return testing::AssertionSuccess();
}

TEST(IntegralStatistics, StandardErrorsHoldTheMeanAsOftenAsTheySay) {
    EXPECT_TRUE(holds_the_mean(honest));
    EXPECT_FALSE(holds_the_mean(centres_alone));
    EXPECT_FALSE(holds_the_mean(wide_filter));
    EXPECT_FALSE(holds_the_mean(mean_of_codes));
    EXPECT_FALSE(holds_the_mean(with_errors_by(0.75)));
    EXPECT_FALSE(holds_the_mean(with_errors_by(1.5)));
}

/// Four times the samples: half the error, or less.
TEST(IntegralStatistics, ErrorsFallWithTheSamples) {
    const TriangleField field(8);
    Offs before = offs_of(field, honest(field.scene, {16, 0}));
    for (const int samples : {64, 256, 1024}) {
        const Offs now = offs_of(field, honest(field.scene, {samples, 0}));
        EXPECT_LT(now.rms(), 0.55 * before.rms()) << samples;
        EXPECT_LT(now.error_squares, 0.3 * before.error_squares) << samples;
        before = now;
    }
    // The more so with strata: samples at random would have 0.0145.
    EXPECT_LT(before.rms(), 0.006);
}

/// Where the stated error is reached, drawing stops, and few pixels are off by much more.
testing::AssertionResult stops_in_time(const Integrator& integrator) {
    const TriangleField field(8);
    const IntegralOptions options{2048, 0.004};
    const Film film = integrator(field.scene, options);
    int edges = 0, far = 0;
    std::uint32_t least = UINT32_MAX, most = 0;
    for (int y = 0; y < field.scene.height; ++y)
        for (int x = 0; x < field.scene.width; ++x) {
            const std::uint32_t samples = bits(film, "integral.samples", x, y);
            least = std::min(least, samples);
            most = std::max(most, samples);
            if (samples < 2048 && value(film, "integral.error.R", x, y) > options.error)
                return testing::AssertionFailure() << "too early at " << x << "," << y;
            const double area = field.area(x, y);
            if (area == 0 || area == 1) continue;
            ++edges;
            far += std::abs(value(film, "R", x, y) - field.mean(x, y)) > 3 * options.error;
        }
    if (least != 64 || most <= 256)
        return testing::AssertionFailure() << least << " to " << most << " samples";
    if (far > edges / 100)
        return testing::AssertionFailure() << far << " of " << edges << " are far off";
    return testing::AssertionSuccess();
}

TEST(IntegralStatistics, StopsAtTheStatedError) {
    EXPECT_TRUE(stops_in_time(honest));
    EXPECT_FALSE(stops_in_time(with_errors_by(1.5)));
    EXPECT_FALSE(stops_in_time(centres_alone));
    EXPECT_FALSE(stops_in_time([](const Scene& scene, const IntegralOptions&) {
        return honest(scene, {64, 0});
    }));
}

/// A plane of a map of two values, alone.
Scene checker_scene(int tiles) {
    Scene scene = empty_scene(12, 10);
    set_pixel_camera(scene);
    scene.materials = {plain_material("checker")};
    Material& material = scene.materials[0];
    material.shade.id = "shade-texture";
    material.textures["color"] = texture(write_texture(
        "checker.exr", 16, [](int x, int y, int) { return (x + y) % 2 == 0 ? 0.9 : 0.1; }));
    add_object(scene, make_quad(40, 1, 1), 0, translation({0, 0, -5}));
    material.texture_matrix = glm::mat4(1.0f);
    material.texture_matrix[0][0] = material.texture_matrix[1][1] = static_cast<float>(tiles);
    return scene;
}

/// Of a checker that is far away the mean is seen: that of its light.
TEST(IntegralStatistics, FarCheckersGoToTheirMean) {
    const Film film = honest(checker_scene(611), {1024, 0});
    EXPECT_TRUE(everywhere(film, {}, [&](int x, int y) {
        return differs("R", value(film, "R", x, y), 0.5,
                       5 * value(film, "integral.error.R", x, y) + 1e-3);
    }));
    const Film centres = centres_alone(integral_scene(checker_scene(611)), {16, 0});
    EXPECT_FALSE(everywhere(centres, {}, [&](int x, int y) {
        return differs("R", value(centres, "R", x, y), 0.5, 0.1);
    }));
}

/// An edge of colour across pixels, magnified: a ramp of 5 pixels between the centres of texels.
TEST(IntegralStatistics, AnEdgeOfColourIsARamp) {
    Scene scene = checker_scene(1);
    scene.materials[0].textures["color"] =
        texture(write_texture("halves.exr", 8, [](int x, int, int) { return x < 4 ? 0.2 : 1.0; }));
    const Film film = honest(scene, {1024, 0});  // 8 texels of 5 pixels, the edge in the middle
    const auto integral = [](double x) {         // of the ramp from -2.5 to 2.5 up to x
        const double t = std::clamp(x, -2.5, 2.5);
        return 0.2 * x + 0.8 * ((t + 2.5) * (t + 2.5) / 10 + std::max(0.0, x - 2.5));
    };
    EXPECT_TRUE(everywhere(film, {}, [&](int x, int y) {
        const double left = x - 6.0;
        return differs("R", value(film, "R", x, y), integral(left + 1) - integral(left),
                       6 * value(film, "integral.error.R", x, y) + 1e-5);
    }));
}

using Pattern = std::function<SamplePlace(int x, int y, int sample)>;

/// Each replicate's first 2^k samples have one in each of 2^k parts of the pixel, however these are
/// cut; and over quads, places are spread evenly and tell nothing of the next replicate's.
testing::AssertionResult is_stratified(const Pattern& pattern) {
    constexpr int replicates = IntegralOptions::replicates;
    for (int replicate = 0; replicate < replicates; ++replicate)
        for (int k = 0; k <= 8; ++k)
            for (int kx = 0; kx <= k; ++kx) {
                std::vector<int> parts(std::size_t(1) << k, 0);
                for (int i = 0; i < 1 << k; ++i) {
                    const SamplePlace at = pattern(36, 8, replicate + replicates * i);
                    const int column = at.x >> (13 - kx), row = at.y >> (13 - (k - kx));
                    ++parts[static_cast<std::size_t>((column << (k - kx)) + row)];
                }
                if (std::any_of(parts.begin(), parts.end(), [](int n) { return n != 1; }))
                    return testing::AssertionFailure() << "no net of 2^" << k;
            }
    double x = 0, y = 0, both = 0, next = 0;
    constexpr int side = 64;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            const SamplePlace at = pattern(2 * i, 2 * j, 0), after = pattern(2 * i, 2 * j, 1);
            const double ox = at.x / 8192.0 - 0.5, oy = at.y / 8192.0 - 0.5;
            x += ox;
            y += oy;
            both += ox * oy;
            next += ox * (after.x / 8192.0 - 0.5);
        }
    const double of_sum = std::sqrt(side * side / 12.0);  // standard deviations
    if (std::abs(x) > 4 * of_sum || std::abs(y) > 4 * of_sum || std::abs(both) > 4 * side / 12.0 ||
        std::abs(next) > 4 * side / 12.0)
        return testing::AssertionFailure()
               << "not even: " << x << " " << y << " " << both << " " << next;
    return testing::AssertionSuccess();
}

TEST(IntegralPattern, IsStratifiedAndEven) {
    EXPECT_TRUE(is_stratified(sample_place));
    EXPECT_FALSE(is_stratified([](int x, int y, int sample) {  // one seed for all
        return sample_place(0 * x, 0 * y, sample);
    }));
    EXPECT_FALSE(is_stratified([](int x, int y, int sample) {  // samples at random
        return sample_place(x + 2 * sample, y, 0);
    }));
    EXPECT_FALSE(is_stratified([](int x, int y, int sample) {  // all replicates alike
        return sample_place(x, y,
                            sample / IntegralOptions::replicates * IntegralOptions::replicates);
    }));
}

}  // namespace
}  // namespace quadrel::render_tests
