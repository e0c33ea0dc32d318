// Stage texts keep the rules for loops, so that a number type that writes shaders can run them.
#include <gtest/gtest.h>

#include "sources/loop_rules.hpp"
#include "sources/planted.hpp"

namespace quadrel::source_tests {
namespace {

/// What the words do, what look-ups and interpolation are on ranges and shaders alone, and what is
/// known of rows on ranges without their text: no text.
bool is_behind_words(const std::string& path) {
    static const std::regex words(
        "relief/trace/search/(beam|course|height_ceiling|near_surface)\\.hpp$|"
        "relief/(trace|shadow|frame)/(\\w+/)?range_|"
        "texture/(range|shader)/|quad/(range_interpolate|shader_io)\\.hpp$|relief/shader_words");
    return std::regex_search(path, words);
}

bool is_text(const SourceFile& file) {
    static const std::regex rooms("^include/quadrel/(relief|shade|texture|quad)/");
    return std::regex_search(file.path, rooms) && !is_behind_words(file.path);
}

testing::AssertionResult keeps_the_rules(const SourceFile& file) {
    const std::string code = bare_code(file.text);
    for (const Finding& found :
         {loop_finding(code), branch_finding(code), access_finding(file.path, code)})
        if (!found.empty()) return testing::AssertionFailure() << file.path << " " << found;
    return testing::AssertionSuccess();
}

SourceFile text_of(const std::string& code) { return {"include/quadrel/relief/x.hpp", code}; }

TEST(Loops, OfTextsAreWrittenWithWords) {
    int texts = 0;
    for (const SourceFile& file : project_sources()) {
        if (!is_text(file)) continue;
        EXPECT_TRUE(keeps_the_rules(file));
        ++texts;
    }
    EXPECT_GT(texts, 100);
}

TEST(Loops, ThatRulesAllow) {
    const char* const allowed[] = {
        "for (const auto k : steps<F>(0, n - 1)) {\n    s = number<F>(k) / n;\n"
        "    if (none(active)) break;\n}",
        "for (const auto k : rounds<F>()) if (none(a | b)) break;",
        "for (const auto k : steps<F>(1, 9)) { x = apply([&](F y) { return y; }, x); }",
        "if (when(tests)) { h = select(tests, f(), h); }",
        "for (int c = 0; c < 3; ++c) v[c] = c == 0 ? a : b;",
        "constexpr int taps = 4;\nfor (int tap = 0; tap < taps; ++tap) of[tap] = a;",
        "template <int channels, Number F>\nvoid f() {\n"
        "    for (int c = 0; c < channels; ++c) texel[c] = a;\n}",
        "for (int i = 0; i < io.frame().light_count; ++i) sum = sum + visible(i);",
        "for (const Int<F>& row : y.nodes) bound = max(bound, f(row));",
        "// while (any(active)) as the listing has it\nconst char* text = \"for (;;)\";"};
    for (const char* code : allowed) EXPECT_TRUE(keeps_the_rules(text_of(code))) << code;
}

TEST(Loops, ThatBreakTheRulesAreFound) {
    const char* const planted[] = {
        "for (int k = 0; k < params.steps; ++k) {}",
        "void f(int times) {\n    for (int k = 0; k < times; ++k) {}\n}",
        "for (int k = 0; k <= 64 && ray.searching(); ++k) {}",
        "for (bool first = true;; first = false) {}",
        "for (;;) {}",
        "while (left) {}",
        "do { x = x + F(1); } while (left);",
        "if (any(tests)) leaf();",
        "if (!any(active)) break;",
        "const bool left = any(active);",
        "if (none(active)) return;",
        "if (none(active) || i == most_steps) break;",
        "const bool left = !none(active);",
        "if (when(a) && deep) { b = a; }",
        "if (when(tests)) return store(N);",
        "const auto in = when(tests);",
        "for (const auto k : steps<F>(0, n)) { if (none(a)) return; }",
        "for (const auto k : steps<F>(0, n)) { return result; }",
        "for (const auto k : steps<F>(0, n)) { if (params.once) break; }",
        "for (const auto k : steps<F>(0, n)) { most = k == 0 ? a : max(most, a); }",
        "for (const auto k : steps<F>(0, n)) { w = exact ? F(0) : number<F>(k); }",
        "for (const auto k : steps<F>(0, n)) { w = weights[k]; }",
        "for (const auto k : steps<F>(0, n)) { if (k > 3) w = a; }",
        "for (const int k : steps<F>(0, n)) { w = a; }",
        "void f() {\n    F h, s(0);\n    for (const auto k : steps<F>(0, n)) { h = s; }\n}",
        "F f(const vec3<F>& P, const LightUniforms& light);",
        "vec3<F> eye(const FrameUniforms& frame);",
        "const F h = gather<F>(view.texels + view.offset[0], texel);",
        "const F h = gather<F>(view_.texels, texel);"};
    for (const char* code : planted)
        EXPECT_FALSE(keeps_the_rules(text_of(code)))
            << code << static_cast<int>(Planted::loop_without_words);
}

}  // namespace
}  // namespace quadrel::source_tests
