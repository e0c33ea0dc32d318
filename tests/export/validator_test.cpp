// Exported functions in each language before glslangValidator, Debian's reference compiler.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>

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
