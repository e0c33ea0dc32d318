// A stage's mistake in a render: exit code 4 and a command to copy that shows it again.
#include <gtest/gtest.h>

#include <cstdlib>

#include "cli/process.hpp"
#include "text/shell_word.hpp"

namespace quadrel::cli_tests {
namespace {

using testing_films::TemporaryFolder;

constexpr const char* scene_text = R"({
    "quadrel": 1,
    "size": [64, 48],
    "camera": {"eye": [0, 0, 2]},
    "materials": {"stone": {"relief": {"trace": "test-broken", "frame": "none",
                                       "surface": "none", "shadow": "none"}}},
    "objects": [{"mesh": {"shape": "quad", "size": 2}, "material": "stone"}]
})";

constexpr const char* fault = "test-broken stored hit.status = 9 in lane ";

Outcome run_in_shell(std::string command, const std::filesystem::path& folder) {
    const TemporaryFolder logs;
    command.replace(0, std::string("quadrel").size(), shell_word(QUADREL_EXECUTABLE));
    const int status = std::system(("cd " + shell_word(folder.string()) + " && " + command + " >" +
                                    shell_word((logs / "out").string()) + " 2>" +
                                    shell_word((logs / "err").string()))
                                       .c_str());
    return {WEXITSTATUS(status), testing_films::file_bytes(logs / "out"),
            testing_films::file_bytes(logs / "err")};
}

/// The end of the one line that a failed check prints.
std::string command_in(const std::string& message) {
    const std::string words = "to reproduce: ";
    const std::size_t at = message.find(words);
    if (at == std::string::npos || message.find('\n') != message.size() - 1) return "";
    return message.substr(at + words.size(), message.size() - 1 - at - words.size());
}

TEST(Reproduce, TheCommandOfAFailedCheckFailsTheSameWay) {
    const TemporaryFolder folder;
    testing_films::write_bytes(folder / "it's a scene.json", scene_text);
    for (const std::vector<std::string>& options :
         std::vector<std::vector<std::string>>{{},
                                               {"-D", "conventions=\"vulkan\"", "--size", "50x30"},
                                               {"--isa", "scalar", "-t", "1"},
                                               {"--number", "double", "-D", "samples=4"}}) {
        std::vector<std::string> line{
            "render", "it's a scene.json", "--plugin", QUADREL_BROKEN_PLUGIN, "-o",
            "a.exr",  "--channels",        "hit"};
        line.insert(line.end(), options.begin(), options.end());
        const Outcome render = run(line, folder.path());
        EXPECT_EQ(render.code, 4) << render.err;
        EXPECT_NE(render.err.find(fault), std::string::npos) << render.err;
        const std::string command = command_in(render.err);
        EXPECT_TRUE(command.starts_with("quadrel probe ")) << render.err;
        const Outcome probe = run_in_shell(command, folder.path());
        EXPECT_EQ(probe.code, 4) << command << "\n" << probe.err;
        EXPECT_NE(probe.err.find(fault), std::string::npos) << probe.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "a.exr"));
    }
}

/// Where the stage keeps its promise, the same command ends well.
TEST(Reproduce, AnotherPixelIsFine) {
    const TemporaryFolder folder;
    testing_films::write_bytes(folder / "scene.json", scene_text);
    const Outcome left = run({"probe", "scene.json", "--pixel", "20,24", "--plugin",
                              QUADREL_BROKEN_PLUGIN, "--number", "float", "--isa", "scalar"},
                             folder.path());
    EXPECT_EQ(left.code, 0) << left.err;
    EXPECT_NE(left.out.find("test-broken"), std::string::npos);
}

}  // namespace
}  // namespace quadrel::cli_tests
