// Chains of stages: found in plans, the same as their stages one by one, and run again so where a
// stage may have broken a promise.
#include "kernels/chain.hpp"

#include <gtest/gtest.h>

#include "kernels/chains/plain.hpp"
#include "quad/stage_bench.hpp"
#include "render/films.hpp"
#include "render/plan/chains.hpp"
#include "render/plan/prepared.hpp"
#include "render/registry/added_stages.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

using F = Quad<float>;

/// Stores one number, whatever it is.
template <Value v, std::uint32_t bits>
struct Stores : StageDefaults {
    static constexpr StageText text{"stores", "trace", "a number", "-"};
    static constexpr std::array<Value, 0> inputs{};
    static constexpr auto outputs = values(v);
    template <class Io>
    void operator()(Io& io, const Params&) const {
        if constexpr (info(v).kind == ValueKind::integer)
            io.template store<v>(Int<F>(static_cast<std::int32_t>(bits)), io.light());
        else
            io.template store<v>(F(std::bit_cast<float>(bits)), io.light());
    }
};

/// Stores a ray parameter and a status.
template <std::uint32_t parameter, Status status>
struct Hits : StageDefaults {
    static constexpr StageText text{"hits", "trace", "a hit", "-"};
    static constexpr std::array<Value, 0> inputs{};
    static constexpr auto outputs = values(Value::hit_s, Value::hit_status);
    template <class Io>
    void operator()(Io& io, const Params&) const {
        io.template store<Value::hit_s>(F(std::bit_cast<float>(parameter)));
        io.template store<Value::hit_status>(Int<F>(static_cast<std::int32_t>(status)));
    }
};

/// Whether all is well with a chain of that stage alone, its values planned or not.
template <class Stage>
bool keeps_promises(bool planned = true) {
    quad_tests::StageBench<float> bench;
    for (const Value v : Stage::outputs)
        if (planned) bench.want(v);
    const NoParams none;
    const ChainStage link{&none, 0, 1};
    return run_chain<Chain<Stage>, F>(&bench.call(), &link);
}

template <Value v, std::uint32_t last, std::uint32_t beyond>
void expect_limit() {
    EXPECT_TRUE((keeps_promises<Stores<v, last>>())) << info(v).name;
    EXPECT_FALSE((keeps_promises<Stores<v, beyond>>())) << info(v).name;
    EXPECT_TRUE((keeps_promises<Stores<v, beyond>>(false))) << info(v).name << ", not planned";
}

constexpr std::uint32_t no_number = 0x7fc00000u, one_half = 0x3f000000u, minus_half = 0xbf000000u;

TEST(Chains, NoticeBrokenPromises) {
    expect_limit<Value::frame_status, 7, 8>();
    expect_limit<Value::hit_status, 7, 0xffffffffu>();
    expect_limit<Value::frame_flags, 15, 16>();
    expect_limit<Value::hit_flags, 63, 64>();
    expect_limit<Value::hit_steps, 0x7fffffffu, 0xffffffffu>();
    expect_limit<Value::hit_fetches, 0x7fffffffu, 0x80000000u>();
    expect_limit<Value::shadow_steps, 0, 0xffffffffu>();
    expect_limit<Value::relief_depth, one_half, minus_half>();
    EXPECT_FALSE((keeps_promises<Hits<no_number, Status::hit>>()));
    EXPECT_TRUE((keeps_promises<Hits<no_number, Status::no_frame>>()));
    EXPECT_TRUE((keeps_promises<Hits<one_half, Status::hit>>()));
}

Scene lit_scene(const std::string& trace, int lights) {
    Scene scene = empty_scene(38, 27);
    set_pixel_camera(scene);
    scene.lights.resize(static_cast<std::size_t>(lights));
    Material material = relief_material("relief", false);
    material.trace = stage(trace, "materials.relief.relief.trace");
    material.surface.id = "none";
    material.shadow = stage("none", "materials.relief.relief.shadow");
    material.shade.id = "shade-lambert";
    scene.materials = {material};
    add_object(scene, triangle({-100, -100, -5}, {100, -100, -5}, {0, 100, -5}), 0);
    return scene;
}

RenderOptions options_for(const std::string& isa) {
    RenderOptions options;
    options.threads = 1;
    options.isa = isa;
    return options;
}

/// Stages of the plan, and those of them that chains run.
std::pair<std::size_t, std::size_t> chained(const Scene& scene, const std::string& isa) {
    const RenderOptions options = options_for(isa);
    const MaterialPlan plan =
        plan_render(scene, options, select_kernels(options)).plan.materials[0];
    std::size_t n = 0, end = 0;
    for (const PlannedChain& chain : plan.chains) {
        EXPECT_GE(chain.first, end);
        end = chain.end;
        n += chain.end - chain.first;
    }
    EXPECT_EQ(plan.in_arrays & ~plan.values, ValueSet());
    EXPECT_EQ(plan.wanted & ~plan.in_arrays, ValueSet());
    return {plan.stages.size(), n};
}

TEST(Chains, AreFoundInPlans) {
    for (const int lights : {1, 2, 3}) {
        EXPECT_EQ(chained(lit_scene("offset-limit", lights), "scalar").second, 0u);
        if (select_kernels(options_for("auto")).chains->count == 0) continue;  // no lanes here
        const auto [stages, all] = chained(lit_scene("offset-limit", lights), "auto");
        EXPECT_EQ(all, stages);
        const auto [others, around] = chained(lit_scene("parallax", lights), "auto");
        EXPECT_EQ(around, others - 1) << "all but the search";
    }
}

/// What a chain says that is not to be believed, and leaves behind.
bool spoil(const StageCall* call, const ChainStage*) {
    for (int slot = 0; slot < slot_count; ++slot)
        if (call->values[slot]) std::fill_n(static_cast<float*>(call->values[slot]), 16, 77.0f);
    return false;
}
bool spoil_and_keep(const StageCall* call, const ChainStage* links) {
    spoil(call, links);
    return true;
}

TEST(Chains, OfBrokenPromisesAreRunAgain) {
    const Scene scene = lit_scene("offset-limit", 1);
    const RenderOptions options = options_for("auto");
    const auto drawn = [&](ChainFunction run) {
        PreparedRender prepared = prepare_render(scene, options, select_kernels(options));
        MaterialPlan& plan = prepared.plan.materials[0];
        plan.chains = {{0, plan.stages.size() - 1, run}};
        plan.in_arrays = plan.values;
        return draw(prepared, options, nullptr);
    };
    PreparedRender one_by_one = prepare_render(scene, options, select_kernels(options));
    one_by_one.plan.shortcuts = no_shortcuts;
    const Film expected = draw(one_by_one, options);
    EXPECT_TRUE(same_bits(expected, drawn(spoil)));
    EXPECT_FALSE(same_bits(expected, drawn(spoil_and_keep)));
}

}  // namespace
}  // namespace quadrel::render_tests
