// Outputs are never inputs of the command, and never one file twice, by whatever names.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include <functional>

#include "cli/bad_input.hpp"
#include "file/file_identity.hpp"
#include "film/films.hpp"

namespace quadrel::cli_tests {
namespace {

namespace fs = std::filesystem;
using testing_films::file_bytes;
using testing_films::TemporaryFolder;
using testing_films::write_bytes;

// ---- Names --------------------------------------------------------------------------------------

using Same = std::function<bool(const fs::path&, const fs::path&)>;

bool same_identity(const fs::path& a, const fs::path& b) {
    const auto x = identity_of(a), y = identity_of(b);
    return x && y && *x == *y;
}

/// Names of one file are found out, those of two files are not.
testing::AssertionResult tells_files_apart(const Same& same) {
    const TemporaryFolder folder;
    for (const char* name : {"a", "b"}) write_bytes(folder / name, "equal");
    fs::create_directory(folder / "sub");
    fs::create_directory_symlink("sub", folder / "sub-link");
    fs::create_symlink("a", folder / "link");
    fs::create_symlink("link", folder / "link-to-link");
    fs::create_symlink("../free", folder / "sub/link-to-free");
    fs::create_symlink("loop", folder / "loop");
    fs::create_hard_link(folder / "a", folder / "hard");
    const std::pair<const char*, const char*> one[] = {{"a", "a"},
                                                       {"a", "sub/../a"},
                                                       {"a", "link"},
                                                       {"a", "hard"},
                                                       {"link-to-link", "hard"},
                                                       {"free", "./free"},
                                                       {"sub/f", "sub-link/f"},
                                                       {"free", "sub/link-to-free"}};
    const std::pair<const char*, const char*> two[] = {
        {"a", "b"}, {"free", "sub/free"}, {"free", "free2"}, {"a", "free"}, {"loop", "loop"}};
    for (const auto& [x, y] : one)
        if (!same(folder / x, folder / y) || !same(folder / y, folder / x))
            return testing::AssertionFailure() << x << " and " << y << " are one file";
    for (const auto& [x, y] : two)
        if (same(folder / x, folder / y))
            return testing::AssertionFailure() << x << " and " << y << " are two files";
    for (const char* never : {"/dev/null", "/", "/proc/self", "/no/such/folder/a"})
        if (same(never, never)) return testing::AssertionFailure() << never << " is no file";
    return testing::AssertionSuccess();
}

TEST(FileIdentity, OfNamesLinksAndFreeNames) {
    EXPECT_TRUE(tells_files_apart(same_identity));
    // Names as text; resolved names, which hard links escape; inodes alone, which free names have
    // not; and folders left out of free names.
    EXPECT_FALSE(tells_files_apart([](const fs::path& a, const fs::path& b) {
        return same_identity(a, a) && a.lexically_normal() == b.lexically_normal();
    }));
    EXPECT_FALSE(tells_files_apart([](const fs::path& a, const fs::path& b) {
        return same_identity(a, a) && same_identity(b, b) &&
               fs::weakly_canonical(a) == fs::weakly_canonical(b);
    }));
    EXPECT_FALSE(tells_files_apart([](const fs::path& a, const fs::path& b) {
        return fs::exists(a) && fs::exists(b) && same_identity(a, b);
    }));
    EXPECT_FALSE(tells_files_apart([](const fs::path& a, const fs::path& b) {
        return same_identity(a, b) ||
               (!fs::exists(a) && !fs::exists(b) && a.filename() == b.filename());
    }));
}

// ---- Commands -----------------------------------------------------------------------------------

constexpr const char* gltf = R"({"asset": {"version": "2.0"},
    "images": [{"uri": "h.exr"}], "textures": [{"source": 0}],
    "materials": [{"occlusionTexture": {"index": 0}}],
    "buffers": [{"uri": "m.bin", "byteLength": 36}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                   "min": [0, 0, 0], "max": [1, 1, 0]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
    "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0})";

constexpr const char* scene = R"({"quadrel": 1, "size": [8, 8],
    "textures": {"t": {"file": "t.exr"}, "unused": {"file": "u.exr"}},
    "materials": {"textured": {"color": "t"}, "plain": {}},
    "objects": [{"mesh": {"file": "m.gltf"}, "material": "plain"},
                {"mesh": "quad", "material": "textured"}]})";

class SameFile : public testing::Test {
  protected:
    SameFile() {
        write_bytes(folder / "s.json", scene);
        write_bytes(folder / "m.gltf", gltf);
        const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
        write_bytes(folder / "m.bin",
                    std::string(reinterpret_cast<const char*>(corners), sizeof corners));
        const fs::path textures = fs::path(QUADREL_DATA_DIR) / "textures";
        for (const char* name : {"t.exr", "u.exr", "p.0.exr", "h.exr"})
            fs::copy_file(textures / "spikes_height.exr", folder / name);
        fs::create_hard_link(folder / "t.exr", folder / "hard.exr");
        fs::create_symlink("m.bin", folder / "link.bin");
        fs::create_directory_symlink(".", folder / "here");
    }

    std::map<std::string, std::string> contents() const {
        std::map<std::string, std::string> all;
        for (const auto& entry : fs::directory_iterator(folder.path()))
            if (!entry.is_directory()) all[entry.path().filename()] = file_bytes(entry);
        return all;
    }

    /// Exit code 2, a line that names both, and every file as it was.
    testing::AssertionResult refuses(const std::vector<std::string>& arguments,
                                     const std::vector<std::string>& says) const {
        const auto before = contents();
        const auto result =
            complains(run(arguments, folder.path()), {arguments.back(), arguments, 2, says});
        if (result && contents() != before)
            return testing::AssertionFailure() << "a file has changed";
        return result;
    }

    TemporaryFolder folder;
};

TEST_F(SameFile, InputsOfARender) {
    // Of h.exr the mesh file has no use for want of texture coordinates.
    for (const char* input : {"s.json", "m.gltf", "m.bin", "t.exr", "u.exr", "h.exr"}) {
        const std::string other = std::string("here/") + input;
        EXPECT_TRUE(refuses({"render", "s.json", "-o", input}, {"-o", input, "input"}));
        EXPECT_TRUE(refuses({"render", "s.json", "-o", "/dev/null", "--preview", other},
                            {"--preview", other, input}));
        EXPECT_TRUE(refuses({"render", "s.json", "-o", "/dev/null", "--stats", other},
                            {"--stats", other, input}));
    }
    EXPECT_TRUE(refuses({"render", "s.json", "-o", "hard.exr"}, {"hard.exr", "t.exr"}));
    EXPECT_TRUE(refuses({"render", "s.json", "-o", "link.bin"}, {"link.bin", "m.bin"}));
    const TemporaryFolder elsewhere;
    EXPECT_FALSE(refuses({"render", "s.json", "-o", (elsewhere / "free.exr").string()}, {}));
    EXPECT_TRUE(fs::exists(elsewhere / "free.exr")) << "the check itself fails";
}

/// The name that nobody has chosen may be a texture's.
TEST_F(SameFile, TheOutputThatIsNotGiven) {
    fs::copy_file(folder / "s.json", folder / "t.json");
    EXPECT_TRUE(refuses({"render", "t.json"}, {"-o t.exr", "input"}));
}

/// Standard output is a file like others where a shell has led it into one, and a pipe takes one
/// output. Exit codes stand in a file, since a pipe line has that of its end.
TEST_F(SameFile, StandardOutputLedElsewhere) {
    const auto code = [&](const std::string& options, const std::string& end) {
        const std::string line =
            fmt::format("cd '{}' && ('{}' render s.json {} 2>err; echo $? >code) {}",
                        folder.path().string(), QUADREL_EXECUTABLE, options, end);
        EXPECT_EQ(std::system(line.c_str()), 0) << line;
        return std::stoi(file_bytes(folder / "code"));
    };
    const std::string texture = file_bytes(folder / "t.exr");
    EXPECT_EQ(code("-o -", ">>t.exr"), 2);
    EXPECT_NE(file_bytes(folder / "err").find("-o - /dev/stdout is the input"), std::string::npos);
    EXPECT_EQ(file_bytes(folder / "t.exr"), texture);
    EXPECT_EQ(code("-o - --preview /dev/stdout", "| cat >both"), 2);
    EXPECT_EQ(code("-o - --stats /dev/stdout", ">both"), 2);
    EXPECT_EQ(file_bytes(folder / "both"), "");
    EXPECT_EQ(code("-o - --preview p.png", "| cat >one"), 0);
    EXPECT_EQ(code("-o /dev/stdout", "| cat >piped"), 0);
    EXPECT_EQ(code("-o /dev/stdout", ">redirected"), 0) << "a regular file without extension";
    EXPECT_EQ(file_bytes(folder / "piped"), file_bytes(folder / "one"));
    EXPECT_EQ(file_bytes(folder / "redirected"), file_bytes(folder / "one"));
    // What others have written to the same descriptor stays.
    EXPECT_EQ(code("-o -", ">>redirected"), 0);
    EXPECT_EQ(code("-o /dev/stdout", ">>redirected"), 0);
    EXPECT_EQ(code("-o /dev/fd/7", "7>>redirected"), 0);
    EXPECT_EQ(file_bytes(folder / "redirected").size(), 4 * file_bytes(folder / "one").size());
    EXPECT_EQ(code("-o -", ">one"), 0);
    EXPECT_EQ(code("-o - --preview /dev/null", ">/dev/null"), 0);
}

TEST_F(SameFile, PluginsAreInputs) {
    const fs::path plugin(QUADREL_BROKEN_PLUGIN);
    EXPECT_EQ(
        run({"render", "s.json", "--plugin", plugin.string(), "-o", plugin.string()}, folder.path())
            .code,
        2);
    for (const auto& entry : fs::directory_iterator(plugin.parent_path())) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with(plugin.stem().string()) || entry.path().extension() != ".so")
            continue;
        EXPECT_TRUE(refuses({"render", "s.json", "--plugin", plugin.string(), "-o", "a.exr",
                             "--stats", entry.path().string()},
                            {"--stats", name}));
    }
}

TEST_F(SameFile, TwoOutputs) {
    EXPECT_TRUE(refuses({"render", "s.json", "-o", "a", "--preview", "./a"}, {"-o a", "./a"}));
    EXPECT_TRUE(refuses({"render", "s.json", "-o", "a", "--stats", "here/a"}, {"--stats here/a"}));
    EXPECT_TRUE(refuses({"render", "s.json", "-o", "a", "--preview", "b", "--stats", "b"},
                        {"--preview b", "--stats b"}));
    write_bytes(folder / "old", "x");
    fs::create_hard_link(folder / "old", folder / "old2");
    EXPECT_TRUE(refuses({"render", "s.json", "-o", "old", "--preview", "old2"}, {"old2"}));
    EXPECT_TRUE(
        refuses({"bake", "h.exr", "--kind", "cone-quick", "-o", "a.exr", "--packed", "here/a.exr"},
                {"-o a.exr", "--packed here/a.exr"}));
}

TEST_F(SameFile, OtherVerbs) {
    EXPECT_TRUE(refuses({"bake", "h.exr", "--kind", "max-mip", "-o", "h.exr"}, {"h.exr"}));
    EXPECT_TRUE(refuses({"bake", "h.exr", "--kind", "cone", "--packed", "here/h.exr"}, {"h.exr"}));
    EXPECT_TRUE(refuses({"compare", "t.exr", "u.exr", "--heatmap", "u.exr"}, {"u.exr"}));
    EXPECT_TRUE(refuses({"compare", "h.exr", "u.exr", "--heatmap", "here/h.exr"}, {"h.exr"}));
    EXPECT_TRUE(refuses({"compare", "h.exr", "u.exr", "--blame", "s.json", "--heatmap", "m.bin"},
                        {"m.bin"}));
    EXPECT_TRUE(refuses({"mips", "p.0.exr", "-o", "p"}, {"p.0.exr"}));
    EXPECT_TRUE(refuses({"sheet", "t.exr", "s.json", "-o", "here/t.exr"}, {"t.exr"}));
    EXPECT_TRUE(refuses({"sheet", "s.json", "-o", "m.bin"}, {"m.bin"}));
    EXPECT_TRUE(refuses({"sheet", ".", "-o", "s.json"}, {"s.json"}));
}

/// Devices, and pipes (standard output is one here), are no files.
TEST_F(SameFile, DevicesMayBeNamedTwice) {
    EXPECT_EQ(run({"render", "s.json", "-o", "/dev/null", "--preview", "/dev/null", "--stats",
                   "/dev/null"},
                  folder.path())
                  .code,
              0);
    EXPECT_EQ(run({"bake", "h.exr", "--kind", "cone-quick", "-o", "/dev/null"}, folder.path()).code,
              0);
}

}  // namespace
}  // namespace quadrel::cli_tests
