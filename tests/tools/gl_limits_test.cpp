// What llvmpipe draws beside what it may draw: sRGB8, which it decodes by an approximation that no
// text of OpenGL's grants, within the setting that data/limits gives for it.
#include <gtest/gtest.h>

#include "export/scene/export_scene.hpp"
#include "film/films.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/film/legal.hpp"
#include "quadrel/render.hpp"
#include "quadrel/scene/load.hpp"
#include "tools/program.hpp"

namespace quadrel::tools_tests {
namespace {

using testing_films::TemporaryFolder;

const std::vector<std::string> colours = {"R", "G", "B"};

/// Values that are outside of their ranges.
std::uint64_t failing(const Scene& scene, const std::string& limits, const Film& drawn) {
    RenderOptions options;
    options.channels = colours;
    options.limits = limits;
    std::uint64_t failing = 0;
    const LegalReference reference = take_apart(render(scene, options), "reference");
    for (const LegalChannelReport& channel : judge(reference, drawn, {}).channels)
        failing += channel.counts[static_cast<std::size_t>(LegalVerdict::fail)];
    return failing;
}

TEST(GlLimits, HoldDecodedSrgb) {
    const TemporaryFolder folder;
    const std::string exported = (folder / "scene").string(), image = (folder / "gl.exr").string();
    for (const char* const name : {"sampler-wrap-repeat", "sampler-mag-linear"}) {
        const Scene scene = load_scene(name);
        SceneExport options;
        options.channels = colours;
        std::filesystem::remove_all(exported);
        export_scene(scene, options, exported);
        const Outcome outcome =
            run_command("ASAN_OPTIONS=detect_leaks=0 " QUADREL_GL " --llvmpipe " + exported +
                        " -o " + image + " 2>&1");
        if (outcome.code == 3 && outcome.out.find("EGL") != std::string::npos)
            GTEST_SKIP() << outcome.out;
        ASSERT_EQ(outcome.code, 0) << outcome.out;
        const Film drawn = read_exr(image).film;
        EXPECT_EQ(failing(scene, "gl,srgb=0.35", drawn), 0u) << name;
        EXPECT_GT(failing(scene, "gl,srgb=0.1", drawn), 0u) << name;
        EXPECT_GT(failing(scene, "gl", drawn), 0u) << name;
        EXPECT_EQ(failing(scene, "webgpu", drawn), 0u) << name;
    }
}

}  // namespace
}  // namespace quadrel::tools_tests
