// Stages from plugins and from the calling program: found, planned, run, with the same bits.
#include <algorithm>

#include "built_isas.hpp"
#include "num/command.hpp"
#include "plugin/planted.hpp"
#include "plugin/support.hpp"
#include "quadrel/error.hpp"
#include "quadrel/probe.hpp"
#include "stages/stages.hpp"

namespace quadrel::plugin_tests {
namespace {

/// The plugin's stages once more, compiled with the program, under ids of their own.
struct OwnWaves : ::plugin_tests::Waves {
    static constexpr StageText text{"own-waves", "trace", "as test-waves", "these tests"};
};
struct OwnTilt : ::plugin_tests::Tilt {
    static constexpr StageText text{"own-tilt", "surface", "as test-tilt", "these tests"};
};
struct OwnStripes : ::plugin_tests::Stripes {
    static constexpr StageText text{"own-stripes", "shade", "as test-stripes", "these tests"};
};
struct LateTilt : ::plugin_tests::Tilt {
    static constexpr StageText text{"late-tilt", "surface", "as test-tilt", "these tests"};
};
/// Planted::other_result
struct WrongTilt : ::plugin_tests::Tilt {
    static constexpr StageText text{"wrong-tilt", "surface", "as test-tilt", "these tests"};
    template <class Io>
    void operator()(Io& io, const Params&) const {
        io.template store<Value::N>(io.template load<Value::frame_normal>());
    }
};

const Choice from_plugin{"test-waves", "test-tilt", "test-stripes"};
const Choice of_program{"own-waves", "own-tilt", "own-stripes"};

class Plugin : public testing::Test {
  protected:
    void SetUp() override {
        load_plugin(plugin("quadrel-test-stages"));
        register_stages<OwnWaves, OwnTilt, OwnStripes, WrongTilt>();
    }
};

testing::AssertionResult same_pictures(const Choice& a, const Choice& b, const std::string& isa,
                                       const std::string& number = "float") {
    return same_bits(render_all(relief_scene(a), "scalar", number),
                     render_all(relief_scene(b), isa, number));
}

TEST_F(Plugin, HasTheSameBitsOnEveryInstructionSet) {
    const std::vector<std::string> isas = built_isas();
    for (const std::string& isa : isas) {
        EXPECT_TRUE(same_pictures(from_plugin, from_plugin, isa)) << isa;
        EXPECT_TRUE(same_pictures(from_plugin, of_program, isa)) << isa;
        EXPECT_FALSE(same_pictures(from_plugin, {"test-waves", "wrong-tilt", "test-stripes"}, isa))
            << isa << static_cast<int>(Planted::other_result);
    }
}

TEST_F(Plugin, RunsInDouble) {
    EXPECT_TRUE(same_pictures(from_plugin, of_program, "auto", "double"));
    EXPECT_FALSE(same_bits(render_all(relief_scene(from_plugin), "auto", "float"),
                           render_all(relief_scene(from_plugin), "auto", "double")));
}

TEST_F(Plugin, TakesParametersOfScenes) {
    const auto with_phase = [](const Choice& choice, double phase) {
        Scene scene = relief_scene(choice);
        scene.materials[0].trace.parameters = {{"phase", phase}, {"steps", 9}};
        return render_all(scene, "auto");
    };
    EXPECT_TRUE(same_bits(with_phase(from_plugin, 1.5), with_phase(of_program, 1.5)));
    EXPECT_FALSE(same_bits(with_phase(from_plugin, 1.5), with_phase(of_program, 1.25)))
        << static_cast<int>(Planted::other_parameters);
    EXPECT_THROW(with_phase(from_plugin, 8), InputError);
}

TEST_F(Plugin, IsListed) {
    const StageInfo* waves = find_stage("test-waves");
    ASSERT_NE(waves, nullptr);
    EXPECT_STREQ(waves->text.summary, "heights under a wave");
    EXPECT_EQ(waves->parameters.size(), 2u);
    EXPECT_STREQ(waves->parameters[1].unit, "rad");
    EXPECT_EQ(waves->textures.size(), 1u);
    EXPECT_TRUE(std::ranges::equal(waves->outputs, trace_outputs));
    EXPECT_EQ(&all_stages()[static_cast<std::size_t>(waves - all_stages().data())], waves);
    EXPECT_EQ(find_stage("test-nothing"), nullptr);
}

/// What was handed out before stays where it is.
TEST_F(Plugin, LeavesTheRegistryInPlace) {
    const StageInfo* linear = find_stage("linear");
    const StageInfo* waves = find_stage("test-waves");
    register_stages<LateTilt>();
    EXPECT_EQ(find_stage("linear"), linear);
    EXPECT_EQ(find_stage("test-waves"), waves);
    EXPECT_NE(find_stage("late-tilt"), nullptr);
}

TEST_F(Plugin, AddedAgainChangesNothing) {
    const std::size_t count = all_stages().size();
    load_plugin(plugin("quadrel-test-stages"));
    load_plugin(std::filesystem::path(QUADREL_PLUGINS) / ".." / "plugins" /
                "quadrel-test-stages.so");
    register_stages<OwnWaves, OwnTilt>();
    EXPECT_EQ(all_stages().size(), count);
}

// ---- Probe and plan -----------------------------------------------------------------------------

TEST_F(Plugin, IsProbedWithTheBitsOfTheRender) {
    const Scene scene = relief_scene(from_plugin);
    const Film film = render_all(scene, built_isas().front());
    int compared = 0;
    for (const int x : {12, 21, 25}) {
        const ProbeReport report = probe(scene, x, 16);
        for (const ProbeFragment& fragment : report.fragments) {
            if (fragment.visible[static_cast<std::size_t>(report.lane)] == 0) continue;
            for (const ProbeStage& stage : fragment.stages) {
                if (stage.id != "test-waves") continue;
                EXPECT_GE(stage.steps.size(), 1u);
                EXPECT_EQ(stage.steps.size(), stage.fetches.size());
                for (const ProbeValue& value : stage.outputs) {
                    const Plane* plane = film.find(value.name);
                    if (plane == nullptr || value.integer) continue;
                    const float shown = value.real[static_cast<std::size_t>(report.lane)];
                    EXPECT_EQ(plane->bits[film.index(x, 16)], std::bit_cast<std::uint32_t>(shown))
                        << value.name;
                    ++compared;
                }
            }
        }
    }
    EXPECT_GT(compared, 6);
}

TEST_F(Plugin, IsPlannedLikeAnyStage) {
    const Scene scene = relief_scene(from_plugin);
    RenderOptions options;
    options.channels = {"hit.U"};
    const std::string plan = explain(scene, options);
    EXPECT_NE(plan.find("runs test-waves"), std::string::npos) << plan;
    EXPECT_NE(plan.find("leaves out stage test-stripes"), std::string::npos) << plan;
}

/// Lanes for what comes from a plugin; the program's own stages say that they have none.
TEST_F(Plugin, PlanSaysWhatRunsOnPlainLanes) {
    RenderOptions options;
    options.channels = {"hit.U"};
    options.isa = built_isas().front();
    if (options.isa == "scalar") GTEST_SKIP() << "plain lanes only";
    const auto plan = [&](const Choice& choice) { return explain(relief_scene(choice), options); };
    EXPECT_NE(plan(of_program).find("runs own-waves on plain lanes:"), std::string::npos);
    EXPECT_NE(plan(from_plugin).find("runs test-waves:"), std::string::npos);
    EXPECT_NE(plan(of_program).find("runs frame-gram:"), std::string::npos);
}

// ---- Shared objects -----------------------------------------------------------------------------

testing::AssertionResult exports_its_table_alone(const std::string& symbols) {
    const bool one = std::count(symbols.begin(), symbols.end(), '\n') == 1;
    if (one && symbols.find(" quadrel_plugin\n") != std::string::npos)
        return testing::AssertionSuccess();
    return testing::AssertionFailure() << symbols;
}

TEST_F(Plugin, ExportsItsTableAlone) {
    std::vector<std::string> parts = {"quadrel-test-stages"};
    for (const std::string& isa : built_isas())
        if (isa != "scalar") parts.push_back("quadrel-test-stages-" + isa);
    for (const std::string& part : parts) {
        const std::string command = QUADREL_NM " -D --defined-only " + plugin(part).string();
        EXPECT_TRUE(exports_its_table_alone(num_tests::output_of(command))) << part;
    }
    EXPECT_FALSE(exports_its_table_alone("1180 W quadrel_plugin\n2000 W _ZN7quadrel3dotE\n"))
        << static_cast<int>(Planted::leaked_symbol);
}

// ---- The example of README.md -------------------------------------------------------------------

/// Its own row, and the one that computes the same; every channel, on every instruction set.
TEST(Readme, ExampleIsTheLinearSearch) {
    load_plugin(plugin("quadrel-test-readme"));
    const Film linear = render_all(relief_scene({"linear", "", ""}), "scalar");
    for (const std::string& isa : built_isas())
        EXPECT_TRUE(same_bits(linear, render_all(relief_scene({"my-steep", "", ""}), isa))) << isa;
    Scene fewer = relief_scene({"my-steep", "", ""});
    fewer.materials[0].trace.parameters = {{"steps", 20}};
    EXPECT_FALSE(same_bits(linear, render_all(fewer, "scalar")));
    EXPECT_TRUE(same_bits(render_all(relief_scene({"linear", "", ""}), "auto", "double"),
                          render_all(relief_scene({"my-steep", "", ""}), "auto", "double")));
}

}  // namespace
}  // namespace quadrel::plugin_tests
