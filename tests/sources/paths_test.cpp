// Each path of this project that a comment or a README names leads somewhere.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

#include "sources/planted.hpp"
#include "sources/source_tree.hpp"

namespace quadrel::source_tests {
namespace {

namespace fs = std::filesystem;

/// Where a path may begin, from the top; and beside the file that names it.
const std::vector<std::string> bases = {"",      "include/quadrel", "include", "src",
                                        "tests", "bench",           "data"};

/// What looks like a path of this project and is another's, the name of a benchmark, or made by
/// the build.
const std::set<std::string> others = {
    "scene/resources/material.cpp",
    "src/scene/shader-lib/glsl/chunks/standard/frag/parallax.js",
    "src/nodes/accessors/AccessorsUtils.js",
    "kernels/thesis",
    "kernels/.*against",
    "bake/cone-",
    "quadrel/baked",
    "tests/num_ulp_exhaustive",
};

/// The first folders of paths: with another one, words with a slash between them are no path.
const std::set<std::string>& first_folders() {
    static const std::set<std::string> folders = [] {
        std::set<std::string> names;
        for (const std::string& base : bases)
            for (const auto& entry : fs::directory_iterator(project() / base)) {
                const std::string name = entry.path().filename().string();
                if (entry.is_directory() && name[0] != '.' && name != "build") names.insert(name);
            }
        return names;
    }();
    return folders;
}

/// Whether `folder` has something of that name, in which * stands for any text.
bool has(const fs::path& folder, const std::string& name) {
    if (name.find('*') == std::string::npos) return fs::exists(folder / name);
    const std::regex pattern(std::regex_replace(std::regex_replace(name, std::regex("\\."), "\\."),
                                                std::regex("\\*"), ".*"));
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none))
        if (std::regex_match(entry.path().filename().string(), pattern)) return true;
    return false;
}

/// As it stands, or as a source file without its ending.
bool leads_somewhere(const fs::path& base, const std::string& path) {
    const fs::path whole = base / path;
    for (const char* ending : {"", ".hpp", ".cpp", ".cpp.in"})
        if (has(whole.parent_path(), whole.filename().string() + ending)) return true;
    return false;
}

/// The part of a line that is prose.
std::string prose(const std::string& path, const std::string& line) {
    if (path.ends_with(".md")) return line;
    const std::string mark = path.ends_with("pp") || path.ends_with(".in") ? "//" : "#";
    const std::size_t start = line.find(mark);
    if (start == std::string::npos || line.find('"') < start) return "";
    return line.substr(start + mark.size());
}

std::string without_tail(std::string path) {
    while (path.ends_with('/') || path.ends_with('.')) path.pop_back();
    return path;
}

testing::AssertionResult names_what_is_there(const SourceFile& file) {
    static const std::regex pattern(
        "(^|[^A-Za-z0-9_/.:<~{$*-])(([A-Za-z0-9_*.-]+/)+[A-Za-z0-9_*.-]*)");
    std::istringstream lines(file.text);
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        const std::string text = prose(file.path, line);
        for (std::sregex_iterator i(text.begin(), text.end(), pattern), end; i != end; ++i) {
            const std::string path = without_tail((*i)[2]);
            if (!first_folders().contains(path.substr(0, path.find('/'))) || others.contains(path))
                continue;
            bool found = leads_somewhere((project() / file.path).parent_path(), path);
            for (const std::string& base : bases)
                found = found || leads_somewhere(project() / base, path);
            if (!found)
                return testing::AssertionFailure()
                       << fmt::format("{}:{} names {}", file.path, number, path);
        }
    }
    return testing::AssertionSuccess();
}

std::vector<SourceFile> texts() {
    std::vector<SourceFile> files =
        project_files({"include", "src", "tests", "bench", "data"},
                      {".hpp", ".cpp", ".in", ".md", "CMakeLists.txt", ".cmake"});
    std::ifstream in(project() / "README.md");
    files.push_back({"README.md", std::string(std::istreambuf_iterator<char>(in), {})});
    return files;
}

TEST(Paths, LeadSomewhere) {
    for (const SourceFile& file : texts()) EXPECT_TRUE(names_what_is_there(file));
}

TEST(Paths, ThatLeadNowhereAreFound) {
    const SourceFile planted[] = {
        {"README.md", "See [the code](src/nowhere.cpp)."},
        {"src/README.md", "text\n`io/exr_open` decides\n"},
        {"src/README.md", "`io/nothing_*.cpp` reads"},
        {"include/quadrel/error.hpp", "#pragma once\n// As relief/trace/steep.hpp has it.\n"},
        {"src/CMakeLists.txt", "# Written by cmake/Nothing.cmake.\n"}};
    for (const SourceFile& file : planted)
        EXPECT_FALSE(names_what_is_there(file))
            << file.text << static_cast<int>(Planted::path_to_nowhere);
    EXPECT_TRUE(names_what_is_there({"README.md", "red and/or blue, `src/io/exr/*.cpp`, src/io."}));
}

}  // namespace
}  // namespace quadrel::source_tests
