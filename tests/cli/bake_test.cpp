// quadrel bake: files, cache, messages.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "cli/process.hpp"
#include "film/films.hpp"
#include "quadrel/bake/baked_file.hpp"
#include "quadrel/bake/packed_map.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel::cli_tests {
namespace {

using testing_films::file_bytes;
using testing_films::TemporaryFolder;

constexpr const char* heights = QUADREL_DATA_DIR "/textures/spikes_height.exr";

/// The environment's cache for as long as this lives.
struct CacheFolder {
    CacheFolder() { setenv("XDG_CACHE_HOME", folder.path().c_str(), 1); }
    ~CacheFolder() { unsetenv("XDG_CACHE_HOME"); }
    std::size_t entries() const {
        const auto place = folder / "quadrel/baked";
        if (!std::filesystem::exists(place)) return 0;
        return static_cast<std::size_t>(
            std::distance(std::filesystem::directory_iterator(place), {}));
    }

    TemporaryFolder folder;
};

std::shared_ptr<const Texture> load_heights() {
    TextureOptions options;
    options.swizzle = "r";
    return make_texture(load_image(heights), options);
}

TEST(Bake, WritesWhatTheLibraryBakes) {
    const TemporaryFolder folder;
    const CacheFolder cache;
    const auto field = load_heights();
    SamplerState sampler;
    sampler.wrap_v = Wrap::clamp_to_edge;
    for (const char* kind : {"max-mip", "cone-cell", "normal-sobel"}) {
        const auto file = folder / (std::string(kind) + ".exr");
        const Outcome outcome = run({"bake", heights, "--kind", kind, "--wrap-v", "clamp-to-edge",
                                     "-o", file.string(), "-t", "1"});
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        const BakeKind which = bake_kind_from_name(kind);
        const auto map = load_baked(file, which, sampler, *field);
        EXPECT_EQ(map->id(), baked_id(*field, which, sampler));
        EXPECT_THROW(load_baked(file, which, SamplerState(), *field), InputError);
    }
    EXPECT_EQ(cache.entries(), 3u);
}

/// Equal files from the cache, without it, and on any number of threads.
TEST(Bake, TheCacheChangesNothing) {
    const TemporaryFolder folder;
    const CacheFolder cache;
    const auto bake_to = [&](const char* name, const std::vector<std::string>& more) {
        std::vector<std::string> line{"bake",       heights, "--kind",
                                      "cone-quick", "-o",    (folder / name).string()};
        line.insert(line.end(), more.begin(), more.end());
        EXPECT_EQ(run(line).code, 0);
        return file_bytes(folder / name);
    };
    const std::string plain = bake_to("a.exr", {"--no-cache"});
    EXPECT_EQ(cache.entries(), 0u);
    EXPECT_EQ(bake_to("b.exr", {"-t", "1"}), plain);
    EXPECT_EQ(cache.entries(), 1u);
    EXPECT_EQ(bake_to("c.exr", {"-t", "2"}), plain);
    EXPECT_NE(bake_to("d.exr", {"--param", "near_side=0"}), plain);
    EXPECT_EQ(cache.entries(), 2u);
}

TEST(Bake, WithoutAnOutputItFillsTheCache) {
    const CacheFolder cache;
    EXPECT_EQ(run({"bake", heights, "--kind", "max-mip"}).code, 0);
    EXPECT_EQ(cache.entries(), 1u);
}

/// A map that is written nowhere is no success; one that is in a file only is worth a warning.
TEST(Bake, WithoutAUsableCache) {
    const TemporaryFolder folder;
    const CacheFolder cache;
    testing_films::write_bytes(cache.folder / "quadrel", "no folder");
    const std::string out = (folder / "map.exr").string();
    Outcome outcome = run({"bake", heights, "--kind", "max-mip"});
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    outcome = run({"bake", heights, "--kind", "max-mip", "-o", out});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(std::filesystem::exists(out));
    EXPECT_EQ(outcome.err.compare(0, 9, "quadrel: "), 0) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 2) << outcome.err;
    outcome = run({"bake", heights, "--kind", "max-mip", "-o", out, "--no-cache"});
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    setenv("QUADREL_CACHE_MIB", "0", 1);
    EXPECT_EQ(run({"bake", heights, "--kind", "max-mip"}).code, 5);
    outcome = run({"bake", heights, "--kind", "max-mip", "-o", out});
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    unsetenv("QUADREL_CACHE_MIB");
}

/// A render makes its maps all the same, and says it once.
TEST(Bake, ARenderWithoutAUsableCacheWarnsOnce) {
    const TemporaryFolder folder;
    const CacheFolder cache;
    const auto lines = [&](const std::string& verb) {
        const Outcome outcome =
            run({verb, "rows/cone-cell", "--size", "8x8", "-o",
                 (folder / (verb == "sheet" ? "a.png" : "a.exr")).string(), "--quiet"});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        if (outcome.err.empty()) return 0;
        EXPECT_TRUE(outcome.err.starts_with("quadrel: warning: the map is not kept in the cache: "))
            << outcome.err;
        return static_cast<int>(std::count(outcome.err.begin(), outcome.err.end(), '\n'));
    };
    testing_films::write_bytes(cache.folder / "quadrel", "no folder");
    EXPECT_EQ(lines("render"), 1);
    EXPECT_EQ(lines("sheet"), 1);
    setenv("QUADREL_CACHE_MIB", "0", 1);
    EXPECT_EQ(lines("render"), 0) << "not wanted";
    unsetenv("QUADREL_CACHE_MIB");
    std::filesystem::remove(cache.folder / "quadrel");
    EXPECT_EQ(lines("render"), 0);
    EXPECT_EQ(cache.entries(), 1u);
}

/// Lines of a file that begin with the words.
std::vector<std::string> lines_with(const std::filesystem::path& file, const std::string& words) {
    std::istringstream text(file_bytes(file));
    std::vector<std::string> found;
    for (std::string line; std::getline(text, line);)
        if (line.starts_with(words)) found.push_back(line);
    return found;
}

/// In a folder where `data` and `build` are those of the source tree.
TEST(Bake, ReadmesLinesRunAsPrinted) {
    const TemporaryFolder folder;
    const CacheFolder cache;
    const std::filesystem::path sources = std::filesystem::path(QUADREL_DATA_DIR).parent_path();
    std::filesystem::create_directory_symlink(QUADREL_DATA_DIR, folder / "data");
    std::filesystem::create_directories(folder / "build/release");
    std::filesystem::create_symlink(QUADREL_EXECUTABLE, folder / "build/release/quadrel");
    const auto lines = lines_with(sources / "README.md", "build/release/quadrel bake");
    EXPECT_GE(lines.size(), 2u);
    for (const std::string& line : lines) {
        const std::string command = "cd '" + folder.path().string() + "' && " + line + " >log 2>&1";
        EXPECT_EQ(std::system(command.c_str()), 0) << line << "\n" << file_bytes(folder / "log");
    }
    EXPECT_TRUE(lines_with(sources / "README.md", "quadrel bake").empty()) << "not of this form";
}

TEST(Bake, PacksForOtherPrograms) {
    const TemporaryFolder folder;
    const CacheFolder cache;
    const auto packed = (folder / "packed.png").string();
    ASSERT_EQ(
        run({"bake", heights, "--kind", "cone-quick", "--packed", packed, "--packing", "gg3"}).code,
        0);
    const PackedMap map = load_packed(packed, Packing::normal_cone_depth);
    EXPECT_EQ(map.cones->view().width[0], load_heights()->view().width[0]);
}

/// What a table by direction takes is said when it is made, and why one that is not made is not.
TEST(Bake, SaysTheMemoryOfTablesByDirection) {
    const TemporaryFolder folder;
    const CacheFolder cache;
    const auto bake_table = [&](const char* slices, const char* kind) {
        return run({"bake", heights, "--kind", kind, "--param", "columns=8", "--param",
                    "directions=32", "--param", slices, "-o", (folder / "t.exr").string()});
    };
    // 8 x 8 columns, 16 slices, 32 x 32 directions: 2^20 floats, and a little.
    const Outcome made = bake_table("slices=16", "ddm");
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_NE(made.err.find("8 x 8 columns, 16 slices, 32 x 32 directions: 4 MiB"),
              std::string::npos)
        << made.err;
    EXPECT_EQ(
        run({"bake", heights, "--kind", "max-mip", "--no-cache", "-o", (folder / "m.exr").string()})
            .err.find("MiB"),
        std::string::npos);
}

/// A tetrahedron, in OBJ; without its last face it is open.
std::string tetrahedron(bool closed) {
    std::string text = "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";
    return closed ? text + "f 2 3 4\n" : text;
}

TEST(Bake, PeelsAMesh) {
    const TemporaryFolder folder;
    std::ofstream(folder / "t.obj") << tetrahedron(true);
    const std::string out = (folder / "t.exr").string();
    const Outcome outcome =
        run({"bake", "--kind", "depth-layers", "--mesh", (folder / "t.obj").string(), "--size",
             "8x8", "--margin", "0", "-o", out});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("\"thickness\": 4, \"tile\": 4"), std::string::npos) << outcome.err;
    const ExrFile file = read_exr(out);
    EXPECT_EQ(file.attributes.at("quadrel:bake.kind"), "depth-layers");
    // Above (x, y) it begins at z = 4 - x - y and ends at 0.
    const std::size_t near = file.film.index(1, 2), outside = file.film.index(6, 6);
    EXPECT_NEAR(file.film.find("R")->as_float(near), (0.75 + 1.25) / 4, 1e-6);
    EXPECT_EQ(file.film.find("G")->as_float(near), 1);
    EXPECT_EQ(file.film.find("R")->as_float(outside), file.film.find("G")->as_float(outside));
    // From the other side, looking along z.
    ASSERT_EQ(run({"bake", "--kind", "depth-layers", "--mesh", (folder / "t.obj").string(),
                   "--size", "8x8", "--margin", "0", "--towards", "0,0,1", "-o", out})
                  .code,
              0);
    const ExrFile back = read_exr(out);
    EXPECT_EQ(back.film.find("R")->as_float(back.film.index(6, 2)), 0);
}

TEST(Bake, ComplainsInOneLine) {
    const TemporaryFolder folder;
    const CacheFolder cache;
    const std::string out = (folder / "map.exr").string();
    const std::string open = (folder / "open.obj").string(), whole = (folder / "t.obj").string();
    std::ofstream(open) << tetrahedron(false);
    std::ofstream(whole) << tetrahedron(true);
    const std::pair<std::vector<std::string>, int> lines[] = {
        {{"bake", heights}, 2},
        {{"bake", heights, "--kind", "conic", "-o", out}, 2},
        {{"bake", heights, "--kind", "cone", "--param", "c_max", "-o", out}, 2},
        {{"bake", heights, "--kind", "cone", "--param", "c_max=wide", "-o", out}, 2},
        {{"bake", heights, "--kind", "cone", "--param", "c_max=-1", "-o", out}, 2},
        {{"bake", heights, "--kind", "cone", "--param", "slices=3", "-o", out}, 2},
        {{"bake", heights, "--kind", "cone", "--wrap", "around", "-o", out}, 2},
        {{"bake", heights, "--kind", "max-mip", "--no-cache"}, 2},
        {{"bake", heights, "--kind", "max-mip", "--packed", out}, 2},
        {{"bake", heights, "--kind", "cone-quick", "--packed", out, "--packing", "gg4"}, 2},
        {{"bake", heights, "--kind", "cone-rabbid", "--packed", out, "--packing", "gg3"}, 2},
        {{"bake", heights, "--kind", "cone-quick", "--packed", (folder / "a.jpg").string()}, 2},
        {{"bake", "--kind", "cone", "-o", out}, 2},
        {{"bake", heights, "--kind", "cone", "--mesh", whole, "-o", out}, 2},
        {{"bake", heights, "--kind", "layer-bounds", "--channel", "a", "-o", out}, 2},
        {{"bake", "--kind", "depth-layers", "-o", out}, 2},
        {{"bake", "--kind", "depth-layers", "--mesh", whole}, 2},
        {{"bake", heights, "--kind", "depth-layers", "--mesh", whole, "-o", out}, 2},
        {{"bake", "--kind", "depth-layers", "--mesh", whole, "--param", "a=1", "-o", out}, 2},
        {{"bake", "--kind", "depth-layers", "--mesh", whole, "--packed", out}, 2},
        {{"bake", "--kind", "depth-layers", "--mesh", whole, "--towards", "0,0", "-o", out}, 2},
        {{"bake", "--kind", "depth-layers", "--mesh", whole, "--towards", "0,0,0", "-o", out}, 2},
        {{"bake", "--kind", "depth-layers", "--mesh", whole, "--margin", "0.5", "-o", out}, 2},
        {{"bake", "--kind", "depth-layers", "--mesh", whole, "--solids", "7", "-o", out}, 2},
        {{"bake", "--kind", "depth-layers", "--mesh", whole, "--solids", "0", "-o", out}, 2},
        {{"bake", "--kind", "depth-layers", "--mesh", whole, "--size", "20000x2", "-o", out}, 2},
        {{"bake", "--kind", "depth-layers", "--mesh", open, "-o", out}, 3},
        {{"bake", "--kind", "depth-layers", "--mesh", "none.obj", "-o", out}, 3},
        {{"bake", "--kind", "depth-layers", "--mesh", "teapot", "-o", out}, 3},
        {{"bake", "none.exr", "--kind", "cone", "-o", out}, 3},
        {{"bake", heights, "--kind", "max-mip", "--channel", "a", "-o", out}, 3},
        {{"bake", heights, "--kind", "max-mip", "-o", "/none/map.exr"}, 5}};
    for (const auto& [line, code] : lines) {
        const Outcome outcome = run(line);
        std::string text;
        for (const std::string& word : line) text += word + " ";
        EXPECT_EQ(outcome.code, code) << text << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_EQ(outcome.err.compare(0, 9, "quadrel: "), 0) << outcome.err;
        EXPECT_FALSE(std::filesystem::exists(out)) << text;
    }
}

TEST(Bake, HelpNamesEveryKindAndParameter) {
    const Outcome outcome = run({"bake", "--help"});
    EXPECT_EQ(outcome.code, 0);
    for (const BakeKindInfo& info : bake_kinds()) {
        EXPECT_NE(outcome.out.find(std::string("  ") + info.name + " "), std::string::npos)
            << info.name;
        for (const BakeParameter& parameter : info.parameters)
            EXPECT_NE(outcome.out.find(parameter.name), std::string::npos) << parameter.name;
    }
}

}  // namespace
}  // namespace quadrel::cli_tests
