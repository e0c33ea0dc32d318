// The order of the rooms, and the one file that knows SIMD, as the sources stand.
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <regex>

#include "sources/planted.hpp"
#include "sources/source_tree.hpp"

namespace quadrel::source_tests {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;

AssertionResult keeps_simd_out(const SourceFile& file) {
    static const std::regex header(
        "#[ ]*include[ ]*[<\"](hwy/|immintrin|x86intrin|[a-z]mmintrin|arm_neon|arm_sve)");
    if (file.path == "include/quadrel/num/lanes.hpp") return AssertionSuccess();
    if (!std::regex_search(file.text, header)) return AssertionSuccess();
    return AssertionFailure() << file.path << " includes a SIMD header";
}

/// A room includes itself and those before it; public and private headers of a room are one. What
/// knows no rooms (tools) is none.
constexpr std::array rooms = {"text",   "file",   "num",   "texture", "scene", "raster",  "quad",
                              "relief", "shade",  "film",  "io",      "bake",  "kernels", "render",
                              "rules",  "export", "sweep", "modules", "cli"};

/// The rooms of the headers that stand in front of all folders.
const std::map<std::string, std::string> front = {
    {"check", "text"},   {"error", "text"},    {"compare", "film"},  {"plugin", "shade"},
    {"shader", "shade"}, {"testing", "shade"}, {"render", "render"}, {"prepare", "render"},
    {"probe", "render"}, {"stats", "render"},  {"errors", "render"}, {"error_pictures", "render"}};

/// Position in `rooms`; -1 for other folders.
int room_index(const std::string& name) {
    for (std::size_t i = 0; i < rooms.size(); ++i) {
        if (name == rooms[i]) return static_cast<int>(i);
    }
    return -1;
}

/// The room of a path from include/quadrel or src on: its first folder, or that of a front header.
std::string room_of(const std::string& path) {
    const std::size_t slash = path.find('/');
    if (slash != std::string::npos) return path.substr(0, slash);
    const auto found = front.find(path.substr(0, path.find('.')));
    return found == front.end() ? "" : found->second;
}

AssertionResult includes_no_later_room(const SourceFile& file) {
    static const std::regex own("^(include/quadrel|src)/(.*)$");
    static const std::regex include("#include \"(quadrel/)?([a-z_0-9/]+\\.hpp)\"");
    std::smatch match;
    if (!std::regex_search(file.path, match, own)) return AssertionSuccess();
    const int room = room_index(room_of(match[2]));
    if (room < 0) return AssertionSuccess();
    for (std::sregex_iterator i(file.text.begin(), file.text.end(), include), end; i != end; ++i) {
        if (room_index(room_of((*i)[2])) > room)
            return AssertionFailure() << file.path << " has " << i->str();
    }
    return AssertionSuccess();
}

/// Every header in front has a room, and every folder with sources is one or stands beside them.
AssertionResult is_placed(const SourceFile& file) {
    if (!file.path.starts_with("include/quadrel/")) return AssertionSuccess();
    const std::string room = room_of(file.path.substr(std::string("include/quadrel/").size()));
    if (room_index(room) >= 0) return AssertionSuccess();
    return AssertionFailure() << file.path << " is in no room";
}

TEST(Sources, KeepSimdInOneFile) {
    for (const SourceFile& file : project_sources()) EXPECT_TRUE(keeps_simd_out(file));
    EXPECT_FALSE(keeps_simd_out({"src/raster/clip.cpp", "#include <hwy/highway.h>\n"}))
        << static_cast<int>(Planted::simd_header_elsewhere);
    EXPECT_FALSE(keeps_simd_out({"include/quadrel/num/quad.hpp", "# include <xmmintrin.h>\n"}))
        << static_cast<int>(Planted::simd_header_elsewhere);
}

TEST(Sources, IncludeInTheOrderOfRooms) {
    for (const SourceFile& file : project_sources()) {
        EXPECT_TRUE(is_placed(file));
        EXPECT_TRUE(includes_no_later_room(file));
    }
}

TEST(Sources, IncludesThatRunBackAreFound) {
    const SourceFile planted[] = {
        {"include/quadrel/num/quad.hpp", "#include \"quadrel/scene/mesh.hpp\"\n"},
        {"src/raster/clip.cpp", "#include \"shade/x.hpp\"\n"},
        {"src/film/compare/compare.cpp", "#include \"io/exr/open.hpp\"\n"},
        {"src/bake/bake.cpp", "#include \"render/draw/batch.hpp\"\n"},
        {"include/quadrel/error.hpp", "#include \"quadrel/num/quad.hpp\"\n"},
        {"src/scene/teapot.cpp", "#include \"quadrel/render.hpp\"\n"}};
    for (const SourceFile& file : planted)
        EXPECT_FALSE(includes_no_later_room(file))
            << file.path << static_cast<int>(Planted::upward_include);
    EXPECT_FALSE(is_placed({"include/quadrel/somewhere/x.hpp", ""}));
    EXPECT_FALSE(is_placed({"include/quadrel/anything.hpp", ""}));
}

}  // namespace
}  // namespace quadrel::source_tests
