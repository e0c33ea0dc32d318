// prism-exact: never wrong by plain arithmetic and by rationals, the pyramid leaves out nothing,
// and what it says where the answer is known.
#include <cstdlib>

#include "effort.hpp"
#include "quadrel/num/quad.hpp"
#include "quadrel/relief/shell/stages.hpp"
#include "relief/exact/every_cell.hpp"
#include "relief/shell/prism_run.hpp"

namespace quadrel::test {
namespace {

using enum PrismFlaw;

constexpr PrismSurface prism_surfaces[] = {PrismSurface::bilinear, PrismSurface::tri_main,
                                           PrismSurface::tri_anti};

/// Batches of 256 rays a kind of map. Set QUADREL_PRISM_RAYS for more.
int prism_batches(int fewest) {
    const char* const rays = std::getenv("QUADREL_PRISM_RAYS");
    const long wanted = rays != nullptr ? std::atol(rays) : 0;
    return std::max(rounds(fewest), static_cast<int>(wanted / 256));
}

/// `check(run, lane, field)` on random rays.
template <PlainFloat T, class Check>
testing::AssertionResult on_prisms(PrismSurface surface, PrismFlaw flaw, int batches, int lanes,
                                   const Check& check) {
    for (int i = 0; i < batches; ++i) {
        PrismRun<T> run(static_cast<std::uint64_t>(i));
        run.search_exactly(surface, flaw);
        const oracle::Field field(run.heights.sampled);
        for (int lane = 0; lane < lanes; ++lane) {
            const std::string wrong = check(run, lane, field);
            if (!wrong.empty())
                return testing::AssertionFailure()
                       << "surface " << static_cast<int>(surface) << ", batch " << i << ", lane "
                       << lane << ": " << wrong;
        }
    }
    return testing::AssertionSuccess();
}

// ---- None wrong ---------------------------------------------------------------------------------

/// A surface that is higher by more than the error is met no later, a lower one no earlier; and
/// nothing gets through the bottom.
template <PlainFloat T>
testing::AssertionResult no_prism_hit_is_wrong(PrismSurface surface, int batches,
                                               PrismFlaw flaw = none) {
    using oracle::Real;
    return on_prisms<T>(
        surface, flaw, batches, batch_lanes, [&](auto& run, int lane, const oracle::Field& field) {
            const oracle::PrismPath path = oracle::prism_path(run.batch, lane, field);
            const Real error = path.height_error, off = path.end_error;
            const Real found = run.found(lane);
            const auto meet = [&](Real lift, Real until) {
                const Real t = oracle::meet_prism<Real>(field, path, surface, lift, until);
                return t <= until ? t * path.length : t;  // infinite, or of length 0
            };
            Real first = meet(error, 1 + off);
            Real last = meet(-error, 1 - off);
            if (path.to_floor || path.floor_is_near)
                first = std::min(first, path.length * (1 - off));
            if (path.to_floor && !path.floor_is_near)
                last = std::min(last, path.length * (1 + off));
            const Real rounding = 16 * std::numeric_limits<T>::epsilon() * path.length + 1e-30L;
            if (found >= first - rounding && found <= last + rounding) return std::string();
            return "found " + std::to_string(double(found)) + ", not in " +
                   std::to_string(double(first)) + " to " + std::to_string(double(last)) + " of " +
                   std::to_string(double(path.length));
        });
}

TEST(PrismExact, NoHitIsWrong) {
    for (const PrismSurface surface : prism_surfaces) {
        EXPECT_TRUE(no_prism_hit_is_wrong<float>(surface, prism_batches(14)));
        EXPECT_TRUE(no_prism_hit_is_wrong<double>(surface, prism_batches(6)));
        for (const PrismFlaw flaw : {wrong_split, swapped_entry_and_exit, other_surface})
            EXPECT_FALSE(no_prism_hit_is_wrong<float>(surface, 2, flaw)) << static_cast<int>(flaw);
    }
}

/// In double, a hit or a miss that is not flagged is the one that rationals decide on.
testing::AssertionResult unflagged_prism_hits_are_decided(PrismSurface surface, int batches,
                                                          PrismFlaw flaw = none) {
    return on_prisms<double>(
        surface, flaw, batches, rounds(24), [&](auto& run, int lane, const oracle::Field& field) {
            const oracle::PrismPath path = oracle::prism_path(run.batch, lane, field);
            if (path.floor_is_near || path.end_error > 1e-9L) return std::string();
            if (run.batch.integer(Value::hit_flags, lane) & HitFlag::ambiguous)
                return std::string();
            const oracle::Real found = run.found(lane);
            oracle::Real exact = oracle::meet_prism<mpq_class>(field, path, surface);
            if (exact <= 1) exact *= path.length;
            if (path.to_floor) exact = std::min(exact, path.length);
            if (found == exact || std::fabs(found - exact) <= 1e-7L * (1 + path.length))
                return std::string();
            // Where it leaves, a hit more or less is the exit's rounding.
            const bool at_exit = std::min(found, exact) >= path.length * (1 - 1e-9L);
            return at_exit
                       ? std::string()
                       : std::to_string(double(found)) + " for " + std::to_string(double(exact));
        });
}

TEST(PrismExact, UnflaggedHitsAreThoseOfRationals) {
    for (const PrismSurface surface : prism_surfaces) {
        EXPECT_TRUE(unflagged_prism_hits_are_decided(surface, prism_batches(4)));
        for (const PrismFlaw flaw : {wrong_split, swapped_entry_and_exit, other_surface})
            EXPECT_FALSE(unflagged_prism_hits_are_decided(surface, test::sanitized ? 16 : 2, flaw))
                << static_cast<int>(flaw);
    }
}

/// Rays that leave through the bottom have hit, whatever rounding makes of heights of 0.
testing::AssertionResult nothing_leaves_through_the_bottom(PrismFlaw flaw = none) {
    int leave = 0;
    auto result = on_prisms<float>(
        PrismSurface::bilinear, flaw, rounds(16), batch_lanes,
        [&](auto& run, int lane, const oracle::Field& field) {
            const oracle::PrismPath path = oracle::prism_path(run.batch, lane, field);
            if (!path.to_floor || path.floor_is_near) return std::string();
            ++leave;
            return run.found(lane) <= 2 * path.length ? "" : std::string("a miss");
        });
    if (result && leave < rounds(100)) return testing::AssertionFailure() << leave << " rays";
    return result;
}

TEST(PrismExact, NothingLeavesThroughTheBottom) {
    EXPECT_TRUE(nothing_leaves_through_the_bottom());
    EXPECT_FALSE(nothing_leaves_through_the_bottom(floor_forgotten));
}

// ---- The pyramid --------------------------------------------------------------------------------

/// Every cell on the way.
struct PrismWalk : PrismExact {
    template <class Io>
    void operator()(Io& io, const Params& params) const {
        PrismSearch<Io> search(io, static_cast<PrismSurface>(params.surface));
        search_every_cell(search);
        search.store();
    }
};

/// What the pyramid leaves out holds no hit: results have the bits of the walk over all cells.
template <PlainFloat T>
testing::AssertionResult pyramid_leaves_out_nothing(bool damaged) {
    for (int i = 0; i < rounds(12); ++i)
        for (const PrismSurface surface : prism_surfaces) {
            PrismRun<T> run(static_cast<std::uint64_t>(i) + 100);
            run.search_exactly(surface);
            Batch<T> walked = run.batch;
            const PrismExact::Params params{static_cast<std::int32_t>(surface)};
            walked.run(&run_stage<PrismWalk, Quad<T>>, &params);
            if (damaged && run.heights.sampled.view.width[0] > 4) {
                SampledTexture clipped = run.sampled_maxima;
                const auto lowered = std::make_unique<std::vector<float>>(
                    clipped.view.texels, clipped.view.texels + clipped.view.offset[1]);
                for (float& h : *lowered) h *= 0.7f;
                clipped.view.texels = lowered->data();
                clipped.view.levels = 1;
                run.batch.bind(TextureSlot::max_mip, clipped);
                run.batch.run("prism-exact", {{"surface", static_cast<int>(surface)}});
            }
            if (auto same = same_bits<T>(walked, run.batch, agreed_values); !same)
                return same << ", surface " << static_cast<int>(surface) << ", batch " << i;
        }
    return testing::AssertionSuccess();
}

TEST(PrismExact, ThePyramidLeavesOutNothing) {
    EXPECT_TRUE(pyramid_leaves_out_nothing<float>(false));
    EXPECT_TRUE(pyramid_leaves_out_nothing<double>(false));
    EXPECT_FALSE(pyramid_leaves_out_nothing<float>(true)) << "bounds that are too low";
}

// ---- Where the answer is known ------------------------------------------------------------------

/// A level surface is met at its level, or where a ray enters below it, or not at all.
testing::AssertionResult levels_are_met(float level, float searched) {
    Random random(3);
    const Map map = flat_map(searched, 8);
    const auto maxima = bake(*map.texture, BakeKind::max_mip, map.sampled.sampler);
    const SampledTexture sampled_maxima{maxima->view(), map.sampled.sampler};
    int hits = 0, misses = 0, below = 0;
    for (int i = 0; i < rounds(8) + 2; ++i) {
        Batch<float> batch;
        fill_prism_rays(batch, random);
        batch.bind(TextureSlot::height, map.sampled);
        batch.bind(TextureSlot::max_mip, sampled_maxima);
        batch.run("frame-shell");
        batch.run("prism-exact");
        const oracle::Field field(map.sampled);
        for (int lane = 0; lane < batch.lanes; ++lane) {
            const oracle::PrismPath path = oracle::prism_path(batch, lane, field);
            const bool hit = batch.integer(Value::hit_status, lane) == int(Status::hit);
            const double enters = double(path.z), leaves = double(path.z + path.rise);
            const double error = 1e-5 + 4 * double(path.height_error);
            const bool starts_below = enters < level - error;
            hits += hit;
            misses += !hit;
            below += starts_below;
            const bool meets = starts_below || leaves < level - error;
            if (meets != hit &&
                std::min(std::abs(enters - level), std::abs(leaves - level)) > error)
                return testing::AssertionFailure()
                       << "lane " << lane << ", from " << enters << " to " << leaves << ": " << hit;
            const double at = 1 - batch.real(Value::hit_s, lane);
            if (hit && std::abs(at - (starts_below ? enters : level)) > error && !path.to_floor)
                return testing::AssertionFailure() << "lane " << lane << ": met at " << at;
            const bool flagged = batch.integer(Value::hit_flags, lane) & HitFlag::start_below;
            if (hit && starts_below != flagged && std::abs(enters - level) > error)
                return testing::AssertionFailure() << "lane " << lane << ": flag " << flagged;
        }
    }
    if (hits < 50 || misses < 50 || below < 50)
        return testing::AssertionFailure() << hits << " " << misses << " " << below;
    return testing::AssertionSuccess();
}

TEST(PrismExact, LevelsAreMet) {
    for (const float level : {0.25f, 0.5f, 0.875f}) EXPECT_TRUE(levels_are_met(level, level));
    EXPECT_FALSE(levels_are_met(0.5f, 0.51f));
}

}  // namespace
}  // namespace quadrel::test
