// What timing does to a drawing (nothing), and how look-ups in lockstep are counted.
#include "sweep/measure.hpp"

#include <gtest/gtest.h>

#include <bit>

#include "kernels/select.hpp"
#include "quadrel/scene/load.hpp"
#include "render/plan/prepared.hpp"

namespace quadrel::sweep_tests {
namespace {

using namespace quadrel::sweep;

TEST(Measure, AClockChangesNoBitAndCountsNothing) {
    const Scene scene = load_scene("rows/linear", {"size=[24,20]"});
    const RenderOptions options;
    const PreparedRender prepared = prepare_render(scene, options, select_kernels("float", "auto"));
    DrawRecord timed, counted;
    const Film film = draw(prepared, options, &timed, Recording::times);
    EXPECT_EQ(film_hash(film), film_hash(draw(prepared, options, nullptr, Recording::nothing)));
    EXPECT_GT(timed.stages.at("linear").wall_ns, 0);
    EXPECT_EQ(total(timed.stages).fetches, 0u);
    EXPECT_EQ(timed.quads, 0u);
    draw(prepared, options, &counted, Recording::counts);
    EXPECT_GT(total(counted.stages).fetches, 0u);
    EXPECT_EQ(timed.stages.size(), counted.stages.size());
}

/// 9 x 4 pixels: a block of 8 x 4, and a column that is one of its own.
Film film_of(const std::vector<std::uint32_t>& fetches) {
    Film film;
    film.frame = film.window = {0, 0, 9, 4};
    film.add("A", ChannelType::float32, std::bit_cast<std::uint32_t>(1.0f));
    film.add("hit.fetches", ChannelType::uint32).bits = fetches;
    return film;
}

TEST(Measure, ABlockTakesAsLongAsItsLongest) {
    std::vector<std::uint32_t> fetches(36, 2);
    EXPECT_EQ(search_cost(film_of(fetches)).mean, 2);
    EXPECT_EQ(search_cost(film_of(fetches)).lockstep, 2);
    fetches[3] = 10;
    EXPECT_DOUBLE_EQ(search_cost(film_of(fetches)).mean, (35 * 2 + 10) / 36.0);
    EXPECT_DOUBLE_EQ(search_cost(film_of(fetches)).lockstep, (32 * 10 + 4 * 2) / 36.0);
    Film covered = film_of(fetches);
    covered.planes[0].bits[3] = 0;  // nobody waits for what is not drawn
    EXPECT_EQ(search_cost(covered).lockstep, 2);
}

}  // namespace
}  // namespace quadrel::sweep_tests
