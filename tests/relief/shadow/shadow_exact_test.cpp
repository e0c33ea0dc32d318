// shadow-exact and shadow-oracle against the field's own values along the light ray, in double:
// between two borders of cells they are a quadratic, which three of them determine.
#include "relief/shadow/lit_batch.hpp"

namespace quadrel::test {
namespace {

/// The field less the light ray's height over t from the bilinear surface at the hit's UV, t = 0
/// included, where it is 0.
class Excess {
  public:
    Excess(LitBatch& lit, const Map& map, int lane)
        : field_(map.sampled),
          uv_(lit.batch.vector2(Value::hit_uv, lane)),
          K_(lit.light_shift(lane)),
          z_(at_texel(uv_)) {}

    /// At its greatest over every quadratic behind the first, and of the first divided by t.
    struct Greatest {
        double first = -1, later = -1;
    };
    Greatest greatest() const {
        const std::vector<double> borders = all_borders();
        Greatest most;
        for (std::size_t i = 1; i < borders.size(); ++i) {
            const double from = borders[i - 1], to = borders[i];
            if (to - from < 1e-12) continue;
            const double middle = (from + to) / 2, length = to - from;
            const double q0 = i == 1 ? 0 : value(from), q1 = value(middle), q2 = value(to);
            const double B = (4 * q1 - 3 * q0 - q2) / length;
            const double A = (2 * q0 - 4 * q1 + 2 * q2) / (length * length);
            if (i == 1) {
                most.first = std::max(B, A * length + B);
                continue;
            }
            const double vertex = -B / (2 * A);
            most.later = std::max({most.later, q0, q2});
            if (A < 0 && vertex > 0 && vertex < length)
                most.later = std::max(most.later, q0 + B * vertex / 2);
        }
        return most;
    }

  private:
    double at_texel(const dvec2& uv) const {
        return static_cast<double>(
            field_.bilinear(uv.x * field_.width - 0.5, uv.y * field_.height - 0.5));
    }
    double value(double t) const { return at_texel(uv_ + K_ * t) - (z_ + t); }

    /// Parameters where the ray changes cells, with both ends, ascending.
    std::vector<double> all_borders() const {
        const double end = 1 - z_;
        std::vector<double> borders = {0, end};
        const auto add = [&](double start, double rate) {
            const double low = std::min(start, start + rate * end);
            const double high = std::max(start, start + rate * end);
            for (double i = std::ceil(low); i <= high && rate != 0; ++i)
                borders.push_back((i - start) / rate);
        };
        add(uv_.x * field_.width - 0.5, K_.x * field_.width);
        add(uv_.y * field_.height - 0.5, K_.y * field_.height);
        std::erase_if(borders, [&](double t) { return t < 0 || t > end; });
        std::sort(borders.begin(), borders.end());
        return borders;
    }

    oracle::Field field_;
    dvec2 uv_, K_;
    double z_;
};

/// Dark where the field rises above the ray by more than rounding explains, lit where it does not.
testing::AssertionResult decides_exactly(const StageUnderTest<float>& shadow,
                                         const Parameters& parameters = {}) {
    int dark = 0, clear = 0, undecided = 0, in_first = 0;
    const char* const maps[] = {"fractal", "checker of 8", "white noise", "sinusoid"};
    for (int seed = 0; seed < 24; ++seed) {
        const Map map = stress(maps[seed % 4], seed);
        LitBatch lit(map, seed);
        lit.light(0.7 * seed, 0.02 + 0.05 * seed);
        std::vector<Excess::Greatest> truth;
        for (int lane = 0; lane < lit.batch.lanes; ++lane)
            truth.push_back(Excess(lit, map, lane).greatest());
        shadow.run(lit.batch, parameters);
        for (int lane = 0; lane < lit.batch.lanes; ++lane) {
            const auto [first, later] = truth[static_cast<std::size_t>(lane)];
            // q / t is steep where the ray's part is short; rounding of t = 0 is divided by it.
            const bool is_dark = first > 1e-2 || later > 1e-4;
            if (!is_dark && (first > -1e-2 || later > -1e-4)) {
                ++undecided;
                continue;
            }
            is_dark ? ++dark : ++clear;
            in_first += is_dark && later < -1e-4;
            if (lit.visibility(lane) != (is_dark ? 0 : 1))
                return testing::AssertionFailure()
                       << shadow.id << ": " << lit.visibility(lane) << " where q is " << first
                       << ", " << later << ", seed " << seed << ", lane " << lane;
        }
    }
    if (dark < 200 || clear < 200 || in_first < 20 || undecided > (dark + clear) / 5)
        return testing::AssertionFailure()
               << dark << " dark, " << clear << " clear, " << undecided << " undecided";
    return testing::AssertionSuccess();
}

TEST(ShadowExact, DecidesAsTheFieldDoes) {
    EXPECT_TRUE(decides_exactly({"shadow-exact"}));
    EXPECT_TRUE(decides_exactly({"shadow-oracle"}));
    // What marches: misses, and starts too high.
    EXPECT_FALSE(decides_exactly({"shadow-march-thesis"}, {{"steps", 1000}}));
    EXPECT_FALSE(decides_exactly({"shadow-cone"}));
    const auto nudge = [](Batch<float>& b) {
        for (int lane = 0; lane < b.lanes; ++lane) b.real(Value::J, lane, 1) *= 1.1f;
    };
    EXPECT_FALSE(decides_exactly({"shadow-exact", nudge}));
}

/// Whether the search for the hit stopped on the surface or a little below does not matter.
TEST(ShadowExact, StartsOnTheSurface) {
    const Map map = stress("fractal", 3);
    for (const char* id : {"shadow-exact", "shadow-oracle"}) {
        LitBatch lit(map, 3);
        lit.light(1, 0.3);
        lit.batch.run(id);
        std::vector<float> before;
        for (int lane = 0; lane < lit.batch.lanes; ++lane) {
            before.push_back(lit.visibility(lane));
            lit.batch.real(Value::hit_s, lane) += 0.03f;
            lit.batch.real(Value::hit_h, lane) -= 0.03f;
        }
        lit.batch.run(id);
        for (int lane = 0; lane < lit.batch.lanes; ++lane)
            EXPECT_EQ(lit.visibility(lane), before[static_cast<std::size_t>(lane)]);
    }
}

}  // namespace
}  // namespace quadrel::test
