// Edge functions along runs of quads: the values of the single quads, whatever their size.
#include <bit>
#include <cmath>

#include "raster/support.hpp"

namespace quadrel::test {
namespace {

using RunEdges = std::function<void(const ScreenTriangle&, int x, int y, int quads, double* e0,
                                    double* e1, double* e2)>;

void real_runs(const ScreenTriangle& triangle, int x, int y, int quads, double* e0, double* e1,
               double* e2) {
    attribute_edges(triangle, x, y, quads, e0, e1, e2);
}

/// Edge functions of all sizes; the largest have values beyond what double holds exactly.
ScreenTriangle random_edges(Random& random) {
    const double size = std::exp2(random.uniform(0, 40));
    const auto whole = [&](double reach) {
        return static_cast<std::int64_t>(random.uniform(-reach, reach));
    };
    ScreenTriangle triangle;
    for (EdgeFunction& edge : triangle.edge)
        edge = {whole(size), random.below(8) == 0 ? 0 : whole(size), whole(size * 0x1p20), 0};
    return triangle;
}

testing::AssertionResult same_at_every_quad(const RunEdges& runs) {
    Random random;
    constexpr int most = 64;
    for (int trial = 0; trial < 400; ++trial) {
        const ScreenTriangle triangle = random_edges(random);
        const int x = 2 * random.below(8000), y = 2 * random.below(8000);
        const int quads = 1 + random.below(most);
        std::vector<double> found[3];
        for (auto& edge : found) edge.assign(4 * most, 0);
        runs(triangle, x, y, quads, found[0].data(), found[1].data(), found[2].data());
        for (int q = 0; q < quads; ++q) {
            double expected[3][4];
            attribute_edges(triangle, quad_centres(x + 2 * q, y), expected[0], expected[1],
                            expected[2]);
            for (int i = 0; i < 3; ++i)
                for (int lane = 0; lane < 4; ++lane)
                    if (std::bit_cast<std::uint64_t>(found[i][std::size_t(4 * q + lane)]) !=
                        std::bit_cast<std::uint64_t>(expected[i][lane]))
                        return testing::AssertionFailure()
                               << "edge " << i << ", quad " << q << " of " << quads << ", lane "
                               << lane << ": " << found[i][std::size_t(4 * q + lane)]
                               << ", expected " << expected[i][lane];
        }
    }
    return testing::AssertionSuccess();
}

/// Steps in T from lanes that are `right` and `up` pixels apart, by `step` pixels a quad.
template <class T>
RunEdges stepping(int right, int up, int step) {
    return [=](const ScreenTriangle& triangle, int x, int y, int quads, double* e0, double* e1,
               double* e2) {
        double* const out[3] = {e0, e1, e2};
        for (int i = 0; i < 3; ++i) {
            const EdgeFunction& edge = triangle.edge[std::size_t(i)];
            for (int lane = 0; lane < 4; ++lane) {
                auto at = static_cast<T>(
                    edge((x + (lane & 1) * right) * std::int64_t(subpixel_units) + 128,
                         (y + (lane >> 1) * up) * std::int64_t(subpixel_units) + 128));
                for (int q = 0; q < quads; ++q) {
                    out[i][4 * q + lane] = static_cast<double>(at);
                    at += static_cast<T>(edge.a * subpixel_units * step);
                }
            }
        }
    };
}

TEST(QuadRuns, HaveTheEdgesOfTheirQuads) { EXPECT_TRUE(same_at_every_quad(real_runs)); }

TEST(QuadRuns, WrongStepsAreNoticed) {
    EXPECT_TRUE(same_at_every_quad(stepping<std::int64_t>(1, 1, 2)));
    EXPECT_FALSE(same_at_every_quad(stepping<double>(1, 1, 2))) << "rounded on the way";
    EXPECT_FALSE(same_at_every_quad(stepping<float>(1, 1, 2)));
    EXPECT_FALSE(same_at_every_quad(stepping<std::int64_t>(1, 1, 1))) << "by a pixel";
    EXPECT_FALSE(same_at_every_quad(stepping<std::int64_t>(1, -1, 2))) << "rows swapped";
}

}  // namespace
}  // namespace quadrel::test
