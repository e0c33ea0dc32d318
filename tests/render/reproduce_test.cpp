// A stage that breaks a promise, or throws, ends the render with the command that shows the quad.
#include <stdexcept>

#include "kernels/table.hpp"
#include "render/films.hpp"
#include "render/plan/prepared.hpp"
#include "render/scenes.hpp"
#include "text/shell_word.hpp"

namespace quadrel::render_tests {
namespace {

/// What a planted stage does after the real one has run.
using Mistake = void (*)(const StageCall&);

StageFunction real_stage = nullptr;
Mistake mistake = nullptr;

void mistaken_stage(const StageCall* call) {
    real_stage(call);
    mistake(*call);
}

template <class T>
T* array(const StageCall& call, Value v) {
    return static_cast<T*>(call.values[slot_of(v)]);
}

/// A triangle that fills the frame of 18 x 12, conventions as given: the picture's pixels are its
/// own.
Scene full_scene(Conventions conventions = Conventions::gl) {
    Scene scene = empty_scene(18, 12);
    scene.conventions = conventions;
    scene.file = "a folder/it's.json";
    scene.overrides = {"size=[18,12]", "material.depth=0.5"};
    set_pixel_camera(scene);
    scene.materials = {relief_material("relief", false)};
    add_object(scene, triangle({-100, -100, -5}, {100, -100, -5}, {0, 100, -5}), 0);
    return scene;
}

/// Renders with `stage` making that mistake.
void render_mistaken(const Scene& scene, const std::string& stage, Mistake what,
                     const std::string& number = "float") {
    RenderOptions options;
    options.channels = {"hit", "R"};
    options.threads = 1;
    PreparedRender prepared = prepare_render(
        scene, options, number == "float" ? scalar_float_kernels() : scalar_double_kernels());
    for (PlannedStage& planned : prepared.plan.materials[0].stages) {
        if (stage != planned.info->text.id) continue;
        real_stage = planned.run;
        mistake = what;
        planned.run = mistaken_stage;
    }
    draw(prepared, options);
}

/// The command for a pixel of the scene above.
std::string command(int x, int y, const std::string& number = "float") {
    return fmt::format(
        "to reproduce: quadrel probe 'a folder/it'\\''s.json' --pixel {},{} -D 'size=[18,12]' -D "
        "material.depth=0.5 --number {} --isa scalar\n",
        x, y, number);
}

/// A pattern that matches `text` and little else.
std::string pattern(std::string text) {
    for (char& c : text)
        if (std::string_view("[]\\'()").find(c) != std::string_view::npos) c = '.';
    return text;
}

struct BrokenPromise {
    const char* stage;
    const char* text;  ///< of the message, before the place
    Mistake mistake;
};

// Lane 33 is the right one of the first row of quad 8, the last at the window's bottom or top.
const BrokenPromise broken_promises[] = {
    {"linear", "linear stored hit.status = 8 in lane 1, expected a status, 0 to 7",
     [](const StageCall& call) { array<std::int32_t>(call, Value::hit_status)[33] = 8; }},
    {"linear", "linear stored hit.steps = -1 in lane 1, expected a count",
     [](const StageCall& call) { array<std::int32_t>(call, Value::hit_steps)[33] = -1; }},
    {"linear", "linear stored hit.flags = 64 in lane 1, expected flags",
     [](const StageCall& call) { array<std::int32_t>(call, Value::hit_flags)[33] = 64; }},
    {"linear", "linear stored hit.s is NaN in lane 1 with status HIT",
     [](const StageCall& call) {
         array<std::int32_t>(call, Value::hit_status)[33] = 1;
         array<float>(call, Value::hit_s)[33] = std::nanf("");
     }},
    {"depth-constant", "depth-constant stored relief_depth = -1 in lane 1, expected 0 or more",
     [](const StageCall& call) { array<float>(call, Value::relief_depth)[33] = -1; }},
    {"frame-gram", "frame-gram stored frame_status = 77 in lane 1, expected a status",
     [](const StageCall& call) { array<std::int32_t>(call, Value::frame_status)[33] = 77; }},
};

TEST(ReproduceDeathTest, ABrokenPromiseNamesThePixelsProbe) {
    for (const BrokenPromise& broken : broken_promises) {
        const std::string expected =
            fmt::format("internal check failed: .*{}.*{}", broken.text, pattern(command(16, 11)));
        EXPECT_EXIT(render_mistaken(full_scene(), broken.stage, broken.mistake),
                    testing::ExitedWithCode(4), expected);
    }
}

TEST(ReproduceDeathTest, RowsOfTheImageCountFromTheTop) {
    EXPECT_EXIT(
        render_mistaken(full_scene(Conventions::vulkan), "linear", broken_promises[0].mistake),
        testing::ExitedWithCode(4), pattern(command(16, 0)));
}

TEST(ReproduceDeathTest, DoublesAreLookedAtToo) {
    EXPECT_EXIT(render_mistaken(
                    full_scene(), "linear",
                    [](const StageCall& call) {
                        array<std::int32_t>(call, Value::hit_status)[33] = 1;
                        array<double>(call, Value::hit_s)[33] = std::nan("");
                    },
                    "double"),
                testing::ExitedWithCode(4), pattern(command(16, 11, "double")));
}

/// What is allowed: padding lanes, and hits of rays that are no rays.
TEST(Reproduce, OtherOddValuesPass) {
    for (const Mistake allowed :
         std::vector<Mistake>{[](const StageCall& call) {
                                  auto* status = array<std::int32_t>(call, Value::hit_status);
                                  for (int lane = 0; lane < call.lanes; ++lane)
                                      if (call.active[lane] == 0) status[lane] = 99;
                              },
                              [](const StageCall& call) {
                                  array<float>(call, Value::K)[5] = std::nanf("");
                                  array<float>(call, Value::hit_s)[5] = std::nanf("");
                              },
                              [](const StageCall& call) {
                                  array<std::int32_t>(call, Value::hit_status)[5] = 6;
                                  array<float>(call, Value::hit_s)[5] = std::nanf("");
                              }})
        EXPECT_NO_THROW(render_mistaken(full_scene(), "linear", allowed));
}

/// The quad among many that throws is found by running them alone.
TEST(Reproduce, AnExceptionNamesThePixelsProbe) {
    const auto throws_at_quad_eight = [](const StageCall& call) {
        const float* const x = array<float>(call, Value::P);
        const auto* const y = static_cast<const float*>(call.values[slot_of(Value::P) + 1]);
        for (int lane = 0; lane < call.lanes; ++lane)
            if (x[lane] > 7 && y[lane] < -4) throw std::logic_error("planted");
    };
    try {
        render_mistaken(full_scene(), "linear", throws_at_quad_eight);
        FAIL() << "nothing thrown";
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(std::string(error.what()) + "\n", "planted; " + command(16, 11));
    }
}

TEST(Reproduce, WordsForAShell) {
    EXPECT_EQ(shell_word("a/b-c_d.json"), "a/b-c_d.json");
    EXPECT_EQ(shell_word(""), "''");
    EXPECT_EQ(shell_word("a b"), "'a b'");
    EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
    EXPECT_EQ(shell_word("$x"), "'$x'");
}

}  // namespace
}  // namespace quadrel::render_tests
