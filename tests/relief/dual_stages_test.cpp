// Every stage that runs on dual numbers: the bits of doubles, derivatives that central differences
// of three steps come near to, axes that may be turned, and exact hits by the implicit formula.
#include <gtest/gtest.h>

#include "num/dual_support.hpp"
#include "quadrel/texture/sampler.hpp"
#include "relief/dual_batch.hpp"

namespace quadrel::test {
namespace {

using num_tests::step_errors;
using num_tests::StepErrors;

/// A stage on duals, with what is done wrong before and behind it.
struct DualStage {
    std::string id;
    std::function<void(DualBatch&)> before{}, after{};
    Parameters set{};

    const StageInfo& text() const { return *find_stage(id); }
    std::vector<std::max_align_t> parameters() const {
        std::vector<std::max_align_t> params(text().params_size / sizeof(std::max_align_t) + 1);
        text().set_defaults(params.data());
        for (const ParameterText& p : text().parameters)
            if (const auto to = set.find(std::string(p.name)); to != set.end())
                p.set(params.data(), to->second);
        return params;
    }
    void run(DualBatch& batch) const {
        const auto params = parameters();
        if (before) before(batch);
        batch.run(find_kernel(dual_kernels(), id), params.data());
        if (after) after(batch);
    }
    Batch<double> run_moved(DualBatch& batch, int axis, double t) const {
        Batch<double> moved = batch.moved(axis, t);
        const auto params = parameters();
        moved.run(Batch<double>::stage_function(id), params.data());
        return moved;
    }
};

/// Few quads show as much as many, and one march takes 65536 steps.
constexpr int tested_lanes = 32;

/// Light that just vanishes is where shading that saturates has a corner.
void leave_corners(Batch<double>& batch) {
    for (int lane = 0; lane < batch.lanes; ++lane)
        for (int light = 0; light < max_lights; ++light) {
            double& visible = batch.real(Value::shadow_visibility, lane, 0, light);
            visible = 0.2 + 0.6 * visible;
        }
}

/// The inputs of a seed, in double, and their variation.
struct Inputs {
    StageInputs single;
    Batch<double> wide;
    Random random;
    DualBatch duals;

    explicit Inputs(int seed)
        : single(seed),
          wide(in_double(single.batch)),
          random(std::uint64_t(seed)),
          duals((wide.own_depth = true, leave_corners(wide), wide), random) {
        for (int lane = tested_lanes; lane < wide.lanes; ++lane) wide.active[std::size_t(lane)] = 0;
    }
};

/// Calls look(value, lane, component) for every output of a lane that runs.
template <class Look>
void each_output(const StageInfo& stage, Batch<double>& batch, const Look& look) {
    for (const Value v : stage.outputs)
        for (int lane = 0; lane < batch.lanes; ++lane)
            for (int c = 0; batch.active[std::size_t(lane)] && c < info(v).components; ++c)
                look(v, lane, c);
}

bool same_value(DualBatch& found, Batch<double>& expected, Value v, int lane, int c) {
    if (info(v).kind == ValueKind::integer)
        return found.integer(v, lane) == expected.integer(v, lane);
    const double a = found.real(v, lane, c).value, b = expected.real(v, lane, c);
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (a != a && b != b);
}

testing::AssertionResult has_the_bits_of_doubles(const DualStage& stage) {
    Inputs inputs(20);
    Batch<double> plain = stage.run_moved(inputs.duals, 0, 0);
    stage.run(inputs.duals);
    const char* differs = nullptr;
    each_output(stage.text(), plain, [&](Value v, int lane, int c) {
        if (!same_value(inputs.duals, plain, v, lane, c)) differs = info(v).name.data();
    });
    if (differs) return testing::AssertionFailure() << differs;
    return testing::AssertionSuccess();
}

/// How many derivatives were looked at, and how many central differences do not come near to.
struct Tally {
    int all = 0, off = 0;
    std::string last;  ///< value that is off
    testing::AssertionResult few() const {
        if (15 * off <= all) return testing::AssertionSuccess();
        return testing::AssertionFailure()
               << off << " of " << all << " derivatives are off, such as that of " << last;
    }
};

/// The stage a step along an axis to either side, for three steps.
class Steps {
  public:
    /// What reads maps changes from one texel to the next, and searches from one step: only short
    /// steps stay within.
    Steps(const DualStage& stage, DualBatch& batch, int axis)
        : step_(stage.text().textures.empty()                         ? 0x1p-5
                : stage.text().text.room == std::string_view("trace") ? 0x1p-16
                                                                      : 0x1p-11) {
        for (int k = 0; k < 3; ++k)
            for (const double sign : {-1.0, 1.0})
                moved_.push_back(stage.run_moved(batch, axis, sign * step_ / (1 << k)));
    }
    StepErrors errors(Value v, int lane, int c, double derivative) {
        const auto f = [&](double t) {
            const int k = std::abs(t) == step_ ? 0 : std::abs(t) == step_ / 2 ? 1 : 2;
            return moved_[static_cast<std::size_t>(2 * k + (t > 0))].real(v, lane, c);
        };
        const double noise = 0x1p-46 * (0.1 + std::abs(f(step_)));
        return step_errors(f, derivative, step_, noise);
    }

  private:
    double step_;
    std::vector<Batch<double>> moved_;
};

testing::AssertionResult is_differentiated(const DualStage& stage) {
    Inputs inputs(20);
    Batch<double> plain = stage.run_moved(inputs.duals, 0, 0);
    Steps x(stage, inputs.duals, 0), y(stage, inputs.duals, 1);
    stage.run(inputs.duals);
    Tally tally;
    each_output(stage.text(), plain, [&](Value v, int lane, int c) {
        if (info(v).kind == ValueKind::integer || !std::isfinite(plain.real(v, lane, c))) return;
        const Dual& found = inputs.duals.real(v, lane, c);
        const int off =
            !x.errors(v, lane, c, found.dx).fall() + !y.errors(v, lane, c, found.dy).fall();
        tally.all += 2;
        tally.off += off;
        if (off > 0) tally.last = info(v).name;
    });
    return tally.few();
}

void swap_axes(DualBatch& batch) {
    batch.change_axes([](double& dx, double& dy) { std::swap(dx, dy); });
}

void turn_axes(DualBatch& batch) {
    batch.change_axes([](double& dx, double& dy) {
        const double x = 0.6 * dx + 0.8 * dy;
        dy = 0.6 * dy - 0.8 * dx;
        dx = x;
    });
}

/// Inputs along turned axes give outputs along turned axes.
testing::AssertionResult turns_with_the_axes(const DualStage& stage) {
    Inputs inputs(21), other(21);
    stage.run(inputs.duals);
    turn_axes(inputs.duals);
    turn_axes(other.duals);
    stage.run(other.duals);
    Tally tally;
    each_output(stage.text(), inputs.wide, [&](Value v, int lane, int c) {
        if (info(v).kind == ValueKind::integer) return;
        const Dual &a = inputs.duals.real(v, lane, c), &b = other.duals.real(v, lane, c);
        const double size = std::abs(a.dx) + std::abs(a.dy);
        ++tally.all;
        tally.off += std::isfinite(size) &&
                     !(std::abs(a.dx - b.dx) + std::abs(a.dy - b.dy) <= 1e-7 * (1 + size));
    });
    return tally.few();
}

testing::AssertionResult for_every_dual_stage(
    const std::function<testing::AssertionResult(const DualStage&)>& check) {
    int stages = 0;
    auto result = testing::AssertionSuccess();
    for (const std::string_view id : kernel_ids(dual_kernels())) {
        ++stages;
        const auto found = check({std::string(id)});
        if (!found)
            result = testing::AssertionFailure()
                     << result.message() << id << ": " << found.message() << "\n";
    }
    return stages > 50 ? result : testing::AssertionFailure() << "only " << stages << " stages";
}

/// What declares duals has a kernel on them, and lists them among its number types.
TEST(DualStages, AreWhatTheRegistrySays) {
    for (const StageInfo& stage : all_stages()) {
        const bool declared = stage.number_types.back() == "dual";
        EXPECT_EQ(declared, find_kernel(dual_kernels(), stage.text.id) != nullptr) << stage.text.id;
        EXPECT_EQ(stage.number_types.size(), declared ? 3u : 2u) << stage.text.id;
    }
}

TEST(DualStages, HaveTheBitsOfDoubles) {
    EXPECT_TRUE(for_every_dual_stage(has_the_bits_of_doubles));
    EXPECT_FALSE(has_the_bits_of_doubles({"displace", {}, [](DualBatch& batch) {
                                              batch.real(Value::hit_P, 5).value *= 1 + 0x1p-52;
                                          }}));
}

TEST(DualStages, HaveTheirDerivatives) { EXPECT_TRUE(for_every_dual_stage(is_differentiated)); }

TEST(DualStages, WrongDerivativesAreCaught) {
    const auto wrong_edge = [](DualBatch& batch) {
        for (EdgeSlopes& slopes : batch.slopes()) std::swap(slopes.dx[0], slopes.dx[1]);
    };
    const auto no_variation = [](DualBatch& batch) {
        batch.change_axes([](double& dx, double& dy) { dx = dy = 0; });
    };
    for (const DualStage& stage :
         {DualStage{"interpolate", wrong_edge}, DualStage{"interpolate", {}, swap_axes},
          DualStage{"frame-gram", {}, swap_axes}, DualStage{"texel-exact", {}, swap_axes},
          DualStage{"differentiate", no_variation}, DualStage{"linear", {}, swap_axes},
          DualStage{"h2n-patch", {}, swap_axes}, DualStage{"shade-phong", {}, swap_axes},
          DualStage{"shade-thesis", no_variation}})
        EXPECT_FALSE(is_differentiated(stage)) << stage.id;
}

TEST(DualStages, DerivativesTurnWithTheAxes) {
    EXPECT_TRUE(for_every_dual_stage(turns_with_the_axes));
    EXPECT_FALSE(turns_with_the_axes({"frame-gram", {}, [](DualBatch& batch) {
                                          batch.change_axes([](double& dx, double&) { dx *= 1.5; });
                                      }}));
}

/// ds of F = h(uv + t K) - (1 - s) = 0, t = s - s of the polygon: minus what F varies by at a fixed
/// s, over its slope in s.
double implicit_derivative(const SampledTexture& map, const vec2<Dual>& uv, const vec2<Dual>& K,
                           double t, int axis) {
    const auto along = [&](const Dual& x) { return DualBatch::along(x, axis); };
    const auto height = [&](const vec2<double>& in_s, const vec2<double>& fixed) {
        const auto varies = [&](const Dual& from, const Dual& shift, double a, double b) {
            return with_derivatives(Quad<Dual>(from.value + t * shift.value), a, b);
        };
        return texture_lod(map, {},
                           vec2<Quad<Dual>>(varies(uv.x, K.x, in_s.x, fixed.x),
                                            varies(uv.y, K.y, in_s.y, fixed.y)),
                           Quad<Dual>(0.0))
            .x;
    };
    const auto h = height({K.x.value, K.y.value},
                          {along(uv.x) + t * along(K.x), along(uv.y) + t * along(K.y)});
    return -exact_dy(h).lane[0] / (exact_dx(h).lane[0] + 1);
}

testing::AssertionResult hits_by_the_implicit_formula(const DualStage& stage) {
    Tally tally;
    for (int seed = 20; seed < 23; ++seed) {
        Inputs inputs(seed);
        DualBatch& batch = inputs.duals;
        const double top = 1.0 - static_cast<double>(inputs.wide.material.seat);
        stage.run(batch);
        for (int lane = 0; lane < tested_lanes; ++lane) {
            const Dual s = batch.real(Value::hit_s, lane);
            if (batch.integer(Value::hit_status, lane) != int(Status::hit) || s.value <= 1e-3 ||
                s.value >= 0.999)
                continue;
            for (int axis = 0; axis < 2; ++axis) {
                const double expected = implicit_derivative(
                    *inputs.wide.bound(TextureSlot::height),
                    {batch.real(Value::uv, lane, 0), batch.real(Value::uv, lane, 1)},
                    {batch.real(Value::K, lane, 0), batch.real(Value::K, lane, 1)}, s.value - top,
                    axis);
                const double found = DualBatch::along(s, axis);
                ++tally.all;
                tally.off += !(std::abs(found - expected) <= 1e-6 * (0.01 + std::abs(expected)));
            }
        }
    }
    if (tally.all < 40) return testing::AssertionFailure() << "only " << tally.all << " hits";
    return tally.few();
}

TEST(DualStages, ExactHitsHaveTheImplicitDerivative) {
    for (const char* id :
         {"texel-exact", "max-mip", "cone-cell", "rmq-leap", "ddm", "cone-robust-exact"})
        EXPECT_TRUE(hits_by_the_implicit_formula({id})) << id;
    EXPECT_FALSE(hits_by_the_implicit_formula({"linear"}));
}

/// Of how many hits the derivatives are those of a root that is settled by few chords.
testing::AssertionResult settles(const DualStage& few, const DualStage& many) {
    Tally tally;
    for (int seed = 20; seed < 23; ++seed) {
        Inputs inputs(seed), other(seed);
        few.run(inputs.duals);
        many.run(other.duals);
        for (int lane = 0; lane < tested_lanes; ++lane) {
            const Dual &a = inputs.duals.real(Value::hit_s, lane),
                       &b = other.duals.real(Value::hit_s, lane);
            if (std::abs(a.value - b.value) > 1e-12) continue;
            ++tally.all;
            tally.off += !(std::abs(a.dx - b.dx) + std::abs(a.dy - b.dy) <=
                           1e-3 * (std::abs(a.dx) + std::abs(a.dy)));
        }
    }
    if (tally.all < 60) return testing::AssertionFailure() << "only " << tally.all << " hits";
    return tally.few();
}

TEST(DualStages, ChordsBeyondTheRootChangeNoDerivative) {
    EXPECT_TRUE(
        settles({"secant", {}, {}, {{"iterations", 8}}}, {"secant", {}, {}, {{"iterations", 64}}}));
    EXPECT_TRUE(settles({"interval", {}, {}, {{"iterations", 48}}},
                        {"interval", {}, {}, {{"iterations", 64}}}));
    EXPECT_FALSE(settles(
        {"secant", {}, {}, {{"iterations", 8}}},
        {"secant",
         {},
         [](DualBatch& batch) { batch.change_axes([](double& dx, double&) { dx *= 1.5; }); },
         {{"iterations", 64}}}));
}

/// The steps of a lattice stay where they are while the ray moves.
TEST(DualStages, StepsOfALatticeDoNotVary) {
    for (const char* id : {"linear", "relief-binary"}) {
        Inputs inputs(21);
        DualStage{id}.run(inputs.duals);
        for (int lane = 0; lane < tested_lanes; ++lane) {
            const Dual& s = inputs.duals.real(Value::hit_s, lane);
            EXPECT_EQ(s.dx, 0) << id;
            EXPECT_EQ(s.dy, 0) << id;
        }
    }
}

}  // namespace
}  // namespace quadrel::test
