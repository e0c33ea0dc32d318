// Exported functions in each language before glslangValidator, Debian's reference compiler.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace quadrel::export_tests {
namespace {

struct Language {
    const char *file, *options;
};
constexpr Language languages[] = {{"all.glsl.frag", "-S frag"},
                                  {"all.es.frag", "-S frag"},
                                  {"all.uniforms.frag", "-S frag"},
                                  {"all.hlsl.frag", "-D -V -S frag -e main -o /dev/null"}};

bool is_valid(const std::string& file, const std::string& options) {
    return std::system(("glslangValidator " + options + " '" + file + "' > /dev/null").c_str()) ==
           0;
}

TEST(Export, EachLanguageCompiles) {
    if (std::system("glslangValidator --version > /dev/null 2>&1") != 0)
        GTEST_SKIP() << "glslangValidator (Debian: glslang-tools) is not installed";
    const std::string folder = std::string(QUADREL_EXPORTED_FOLDER) + "/";
    for (const Language& language : languages)
        EXPECT_TRUE(is_valid(folder + language.file, language.options)) << language.file;
    // One with an error is refused.
    const std::string wrong = folder + "wrong.frag";
    std::ofstream(wrong) << "#version 330 core\nvoid main() { int i = 1.5; }\n";
    EXPECT_FALSE(is_valid(wrong, "-S frag"));
}

/// Lines that choose by `NAME` behind `if (!NAME) break;`, before it changes or the loop ends.
std::vector<std::string> choices_of_what_is_known(std::istream& shader) {
    const std::string leave = "if (!", end = ") break;";
    std::vector<std::string> found;
    std::string known;
    std::size_t depth = 0;
    for (std::string line; std::getline(shader, line);) {
        const std::size_t first = std::min(line.find_first_not_of(' '), line.size());
        if (first < depth || line.find(known + " = ") != std::string::npos) known.clear();
        if (!known.empty() && line.find(" " + known + " ? ") != std::string::npos)
            found.push_back(line);
        if (line.compare(first, leave.size(), leave) != 0 || !line.ends_with(end)) continue;
        known = line.substr(first + leave.size(), line.size() - first - leave.size() - end.size());
        depth = first;
    }
    return found;
}

TEST(Export, WhatIsKnownBehindAWayOutIsNotAsked) {
    std::ifstream shader(std::string(QUADREL_EXPORTED_FOLDER) + "/all.glsl.frag");
    for (const std::string& line : choices_of_what_is_known(shader)) ADD_FAILURE() << line;
    // A choice too many is seen, and one of what has changed since is none.
    std::istringstream planted(
        "    if (!on) break;\n    x = on ? y : x;\n    on = x < 1.0;\n    x = on ? y : x;\n");
    EXPECT_EQ(choices_of_what_is_known(planted).size(), 1u);
}

TEST(Export, LinesAreShort) {
    for (const char* file : {"all.glsl.frag", "all.es.frag", "all.hlsl.frag", "each.wgsl"}) {
        std::ifstream shader(std::string(QUADREL_EXPORTED_FOLDER) + "/" + file);
        int lines = 0;
        for (std::string line; std::getline(shader, line); ++lines)
            EXPECT_LE(line.size(), 120u) << file << ": " << line;
        EXPECT_GT(lines, 1000) << file;
    }
}

}  // namespace
}  // namespace quadrel::export_tests
