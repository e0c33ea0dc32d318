// No transcendental function of a mathematical library is called: not in the sources, and not in
// what they are compiled to. Such functions give other bits on other CPUs and library versions.
// std::fmod and std::ldexp are exact and therefore allowed.
#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "num/command.hpp"
#include "num/module_loader.hpp"
#include "num/planted.hpp"
#include "sources/source_tree.hpp"

namespace quadrel::num_tests {
namespace {

using source_tests::project_sources;
using source_tests::SourceFile;
using source_tests::without_comments;

const std::string functions =
    "(sin|cos|tan|asin|acos|atan|atan2|sincos|sinh|cosh|tanh|asinh|acosh|atanh|exp|exp2|exp10|"
    "expm1|log|log2|log10|log1p|pow|hypot|cbrt|erf|erfc|tgamma|lgamma)[fl]?";

testing::AssertionResult calls_no_libm(const SourceFile& file) {
    // GLM's functions that call the library's, and Highway's, which differ between targets.
    static const std::regex forbidden(
        "(^|[^A-Za-z0-9_])(std::|glm::|::)" + functions + "[ \n]*\\(|using std::" + functions +
        ";|(^|[^A-Za-z0-9_:])(sin|cos|tan|exp|exp2|log|log2|pow|atan2|hypot)f[ ]*\\(|"
        "glm::(perspective|perspectiveFov|infinitePerspective|rotate|angleAxis|slerp|eulerAngle)|"
        "hwy/contrib/math|__builtin_" +
        functions);
    std::smatch match;
    const std::string code = without_comments(file.text);
    if (!std::regex_search(code, match, forbidden)) return testing::AssertionSuccess();
    const auto line = 1 + std::count(code.begin(), code.begin() + match.position(), '\n');
    return testing::AssertionFailure() << file.path << ":" << line << ": " << match.str();
}

/// Of nm's list of undefined symbols, one per line: "                 U sin@GLIBC_2.2.5".
testing::AssertionResult needs_no_libm(const std::string& undefined_symbols) {
    static const std::regex forbidden("U (__)?" + functions + "(_finite)?(@.*)?");
    std::istringstream lines(undefined_symbols);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t start = line.find("U ");
        if (start != std::string::npos && std::regex_match(line.substr(start), forbidden)) {
            return testing::AssertionFailure() << line;
        }
    }
    return testing::AssertionSuccess();
}

TEST(NoLibm, IsCalledInTheSources) {
    for (const SourceFile& file : project_sources()) EXPECT_TRUE(calls_no_libm(file));
}
TEST(NoLibm, IsNeededByTheLibrary) {
    EXPECT_TRUE(needs_no_libm(output_of(QUADREL_NM " -u " QUADREL_LIBRARY)));
}
TEST(NoLibm, IsNeededByTheModules) {
    for (const std::string& isa : built_isas()) {
        EXPECT_TRUE(needs_no_libm(output_of(QUADREL_NM " -Du " + module_path(isa)))) << isa;
    }
}

TEST(NoLibm, CatchesPlantedErrors) {
    for (const char* text :
         {"x = std::sin(y);", "x=::exp2f(y)", "x = powf(y, 2)", "m = glm::perspective(a, b, c, d);",
          "#include <hwy/contrib/math/math-inl.h>", "glm::pow (v, w)", "using std::tan;",
          "__builtin_cos(x)"}) {
        EXPECT_FALSE(calls_no_libm({"planted", text})) << static_cast<int>(Planted::libm_call);
    }
    for (const char* line : {"                 U sin", "U pow@GLIBC_2.29", " U exp2f\n U free"}) {
        EXPECT_FALSE(needs_no_libm(line)) << static_cast<int>(Planted::libm_symbol);
    }
    EXPECT_TRUE(calls_no_libm({"fine", "x = quadrel::sin(y) + sin(z); // std::sin(x)"}));
    EXPECT_TRUE(needs_no_libm(" U sinister\n U fmod\n U sqrt"));
}

}  // namespace
}  // namespace quadrel::num_tests
