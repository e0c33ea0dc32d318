// The order of the rooms, and the one file that knows SIMD, as the sources stand.
#include <gtest/gtest.h>

#include <array>
#include <regex>

#include "num/planted.hpp"
#include "num/source_tree.hpp"

namespace quadrel::num_tests {
namespace {

testing::AssertionResult keeps_simd_out(const SourceFile& file) {
    static const std::regex header(
        "#[ ]*include[ ]*[<\"](hwy/|immintrin|x86intrin|[a-z]mmintrin|arm_neon|arm_sve)");
    if (file.path == "include/quadrel/num/lanes.hpp") return testing::AssertionSuccess();
    if (!std::regex_search(file.text, header)) return testing::AssertionSuccess();
    return testing::AssertionFailure() << file.path << " includes a SIMD header";
}

/// In the order of the data flow: a room includes itself and those before it.
constexpr std::array rooms = {"num",  "texture", "scene", "raster",
                              "quad", "relief",  "shade", "film"};

/// Position in `rooms`; -1 for other folders (io, cli, kernels...), which may include any room.
int room_index(const std::string& name) {
    for (std::size_t i = 0; i < rooms.size(); ++i) {
        if (name == rooms[i]) return static_cast<int>(i);
    }
    return -1;
}

testing::AssertionResult includes_no_later_room(const SourceFile& file) {
    static const std::regex own("^(include/quadrel|src)/([a-z]+)/");
    static const std::regex include("#include \"(quadrel/)?([a-z_]+)/");
    std::smatch match;
    if (!std::regex_search(file.path, match, own)) return testing::AssertionSuccess();
    const int room = room_index(match[2]);
    if (room < 0) return testing::AssertionSuccess();
    for (std::sregex_iterator i(file.text.begin(), file.text.end(), include), end; i != end; ++i) {
        if (room_index((*i)[2]) > room) {
            return testing::AssertionFailure() << file.path << " has " << i->str();
        }
    }
    return testing::AssertionSuccess();
}

TEST(Sources, KeepSimdInOneFile) {
    for (const SourceFile& file : project_sources()) EXPECT_TRUE(keeps_simd_out(file));
}
TEST(Sources, IncludeInTheOrderOfRooms) {
    for (const SourceFile& file : project_sources()) EXPECT_TRUE(includes_no_later_room(file));
}
TEST(Sources, CatchPlantedErrors) {
    EXPECT_FALSE(keeps_simd_out({"src/raster/clip.cpp", "#include <hwy/highway.h>\n"}))
        << static_cast<int>(Planted::simd_header_elsewhere);
    EXPECT_FALSE(keeps_simd_out({"include/quadrel/num/quad.hpp", "# include <xmmintrin.h>\n"}))
        << static_cast<int>(Planted::simd_header_elsewhere);
    EXPECT_FALSE(includes_no_later_room(
        {"include/quadrel/num/quad.hpp", "#include \"quadrel/scene/mesh.hpp\"\n"}))
        << static_cast<int>(Planted::upward_include);
    EXPECT_FALSE(includes_no_later_room({"src/raster/clip.cpp", "#include \"shade/x.hpp\"\n"}))
        << static_cast<int>(Planted::upward_include);
}

}  // namespace
}  // namespace quadrel::num_tests
