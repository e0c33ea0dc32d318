// Files and scenes that something is wrong with, and those that nothing is wrong with.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "cli/bad_input.hpp"
#include "film/films.hpp"
#include "quadrel/film/exr.hpp"
#include "texture/files.hpp"

namespace quadrel::cli_tests {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;
using testing_films::file_bytes;
using testing_films::TemporaryFolder;
using testing_films::write_bytes;

/// One channel "Y" of these values, row by row.
inline void write_heights(const std::filesystem::path& file, int width, int height,
                          const std::vector<float>& values) {
    Film film{{0, 0, width, height}, {0, 0, width, height}, {}};
    film.add("Y", ChannelType::float32);
    for (std::size_t i = 0; i < film.planes[0].bits.size(); ++i)
        film.planes[0].bits[i] = std::bit_cast<std::uint32_t>(values[i % values.size()]);
    write_exr(file, film, {});
}

inline const std::string corners = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n";
inline const std::string face = "f 1/1 2/2 3/3\n";

class BadInputs : public testing::Test {
  protected:
    BadInputs() {
        constexpr float nan = std::numeric_limits<float>::quiet_NaN();
        constexpr float infinity = std::numeric_limits<float>::infinity();
        write_heights(folder / "h.exr", 4, 4, {0.5f, 0.75f, 0.25f});
        write_heights(folder / "nan.exr", 3, 2, {1, 1, 1, 1, nan, 1});
        write_heights(folder / "infinite.exr", 3, 2, {1, 1, infinity, 1, 1, 1});
        write_heights(folder / "one.exr", 1, 1, {0.5f});
        write_heights(folder / "column.exr", 1, 13, {0.5f, 0.25f});
        write_heights(folder / "odd.exr", 7, 5, {0.5f, 0.25f});
        const std::string whole = file_bytes(folder / "h.exr");
        write_bytes(folder / "truncated.exr", whole.substr(0, whole.size() / 2));
        write_bytes(folder / "header.exr", whole.substr(0, 60));
        write_bytes(folder / "empty", "");
        write_bytes(folder / "empty.exr", "");
        write_bytes(folder / "text.png", "this is no image");
        const auto png = test::make_png(8, 8, 8, test::PngColour::grey, std::string(64, 'x'));
        write_bytes(folder / "truncated.png", png.substr(0, png.size() - 30));
        write_bytes(folder / "good.obj", corners + face);
        write_bytes(folder / "bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        write_bytes(folder / "nan.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n");
        write_bytes(folder / "beyond.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
        write_bytes(folder / "none.obj", "# nothing\n");
        write_bytes(folder / "mesh.stl", "solid\n");
        write_bytes(folder / "text.glb", "not glTF");
        write_bytes(folder / "truncated.glb", std::string("glTF\2\0\0\0\xff\0\0\0", 12));
    }

    /// A scene of these members, in a file of its own.
    std::string scene(const std::string& members, const std::string& name = "s.json") const {
        const std::string rest = members.empty() ? "" : ",\n" + members;
        write_bytes(folder / name, "{\"quadrel\": 1, \"size\": [16, 16]" + rest + "}");
        return name;
    }
    static std::string relief(const std::string& texture) {
        return "\"material\": {\"height\": {" + texture + "}}, \"objects\": [{\"mesh\": \"quad\"}]";
    }
    static std::string with_mesh(const std::string& file) {
        return "\"objects\": [{\"mesh\": {\"file\": \"" + file + "\"}}]";
    }

    /// Whether `render` refuses the scene, leaving the folder as it was.
    AssertionResult refuses(const std::string& what, const std::string& members,
                            const std::vector<std::string>& says) const {
        return refuses({what, {"render", scene(members), "-o", "out.exr"}, 3, says});
    }
    AssertionResult refuses(const BadInput& bad) const {
        const std::size_t before = folder.count();
        const AssertionResult result = complains(run(bad.arguments, folder.path()), bad);
        if (result && folder.count() != before)
            return AssertionFailure() << bad.what << ": something is left behind";
        return result;
    }
    /// Renders; the output, or nothing and a failure.
    Film renders(const std::string& members, std::vector<std::string> options = {}) const {
        options.insert(options.begin(), {"render", scene(members), "-o", "out.exr"});
        const Outcome outcome = run(options, folder.path());
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome.code == 0 ? read_exr(folder / "out.exr").film : Film{};
    }

    TemporaryFolder folder;
};

}  // namespace quadrel::cli_tests
