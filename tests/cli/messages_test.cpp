// Messages are best effort, and a reader that has gone is no error: neither changes an exit code or
// an output. No terminal obeys what a file holds.
#include <gtest/gtest.h>

#include <array>
#include <functional>

#include "cli/bad_input.hpp"
#include "film/films.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel::cli_tests {
namespace {

using testing_films::file_bytes;
using testing_films::smooth_film;
using testing_films::TemporaryFolder;
using testing_films::write_bytes;

/// What becomes of a descriptor in the child, before the program starts.
using Prepare = std::function<void()>;

int run_prepared(const std::vector<std::string>& arguments, const TemporaryFolder& folder,
                 const Prepare& prepare) {
    const pid_t child = fork();
    if (child == 0) {
        dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
        dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
        prepare();
        become_quadrel(arguments, folder.path());
    }
    return wait_for(child);
}

Prepare to_file(int descriptor, const std::string& file) {
    return [=] { dup2(open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), descriptor); };
}

Prepare closed(int descriptor) {
    return [=] { close(descriptor); };
}

/// A pipe whose reader has gone.
Prepare broken_pipe(int descriptor) {
    return [=] {
        std::array<int, 2> ends{};
        if (pipe(ends.data()) != 0) _exit(126);
        close(ends[0]);
        dup2(ends[1], descriptor);
    };
}

class Messages : public testing::Test {
  protected:
    Messages() {
        write_bytes(folder / "s.json", R"({"quadrel": 1, "size": [16, 16]})");
        write_exr(folder / "a.exr", smooth_film(1), {});
        write_exr(folder / "b.exr", smooth_film(2), {});
    }
    TemporaryFolder folder;
};

TEST_F(Messages, ThatDoNotGetOutChangeNothing) {
    const std::string out = (folder / "out.exr").string();
    ASSERT_EQ(run({"render", "s.json", "-o", out}, folder.path()).code, 0);
    const std::string whole = file_bytes(out);
    for (const Prepare& prepare : {to_file(2, "/dev/full"), closed(2), broken_pipe(2)}) {
        std::filesystem::remove(out);
        EXPECT_EQ(run_prepared({"render", "s.json", "-o", "out.exr", "--preview", "out.png"},
                               folder, prepare),
                  0);
        EXPECT_EQ(file_bytes(out), whole) << "and no message is in it";
        EXPECT_TRUE(std::filesystem::exists(folder / "out.png"));
        EXPECT_EQ(run_prepared({"mips", "a.exr", "-o", "m"}, folder, prepare), 0);
        EXPECT_EQ(run_prepared({"render", "none.json"}, folder, prepare), 3);
        EXPECT_EQ(run_prepared({"compare", "a.exr", "b.exr"}, folder, prepare), 1);
    }
}

TEST_F(Messages, OutputsNeverGetAClosedDescriptor) {
    const std::string out = (folder / "out.exr").string();
    ASSERT_EQ(run({"render", "s.json", "-o", out}, folder.path()).code, 0);
    const std::string whole = file_bytes(out);
    const Prepare all_closed = [] {
        for (const int descriptor : {0, 1, 2}) close(descriptor);
    };
    for (const Prepare& prepare : {closed(0), closed(1), all_closed}) {
        std::filesystem::remove(out);
        EXPECT_EQ(run_prepared({"render", "s.json", "-o", "out.exr"}, folder, prepare), 0);
        EXPECT_EQ(file_bytes(out), whole);
    }
    EXPECT_EQ(run_prepared({"list", "channels"}, folder, closed(1)), 5)
        << "data has no place to go";
}

TEST_F(Messages, AReaderThatHasGoneEndsTheProgramQuietly) {
    const std::string err = (folder / "err").string();
    const auto quietly = [&](const std::vector<std::string>& arguments) {
        const int code = run_prepared(arguments, folder, [&] {
            broken_pipe(1)();
            to_file(2, err)();
        });
        EXPECT_EQ(file_bytes(err), "") << arguments[0];
        return code;
    };
    EXPECT_EQ(quietly({"list", "channels"}), 0);
    EXPECT_EQ(quietly({"list", "algorithms", "--json"}), 0);
    EXPECT_EQ(quietly({"--help"}), 0);
    EXPECT_EQ(quietly({"render", "--help"}), 0);
    EXPECT_EQ(quietly({"info", "a.exr"}), 0);
    EXPECT_EQ(quietly({"compare", "a.exr", "a.exr"}), 0);
    EXPECT_EQ(quietly({"compare", "a.exr", "b.exr"}), 1) << "the verdict stays";
    EXPECT_EQ(quietly({"compare", "a.exr", "b.exr", "--json"}), 1);
    // A full disk is another matter.
    EXPECT_EQ(run_prepared({"compare", "a.exr", "b.exr"}, folder, to_file(1, "/dev/full")), 5);
}

// ---- Control characters -------------------------------------------------------------------------

bool obeyed(const std::string& text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto c = static_cast<unsigned char>(text[i]);
        const bool c1 =
            c == 0xc2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xa0;
        if ((c < ' ' && c != '\n') || c == 0x7f || c1) return true;
    }
    return false;
}

TEST_F(Messages, NoTerminalObeysNamesFromFiles) {
    EXPECT_TRUE(obeyed("a\x1b[2J") &&
                obeyed("a\xc2\x9b"
                       "2J") &&
                obeyed("\x7f"));
    EXPECT_FALSE(obeyed("a\nb \xc3\xa9"));
    const std::string bad =
        "x\x1b[2J\x7f\xc2\x9b\xff"
        "2J\ny";
    Film film = smooth_film(1);
    film.add(bad, ChannelType::float32);
    write_exr(folder / "c.exr", film, {{"quadrel:note" + bad, bad}});
    std::filesystem::copy_file(folder / "a.exr", folder / (bad + ".exr"));
    std::filesystem::copy_file(folder / "s.json", folder / (bad + ".json"));
    for (const std::vector<std::string>& line :
         std::vector<std::vector<std::string>>{{"info", "c.exr"},
                                               {"info", "c.exr", "--json"},
                                               {"compare", "c.exr", "a.exr"},
                                               {"compare", "c.exr", "a.exr", "--json"},
                                               {"compare", "c.exr", bad + ".exr"},
                                               {"info", bad + ".json"},
                                               {"info", bad + ".json", "--json"},
                                               {"probe", bad + ".json", "--pixel", "3,3"},
                                               {"probe", bad + ".json", "--pixel", "3,3", "--json"},
                                               {"render", bad + ".json", "--explain"},
                                               {"render", bad + ".json"},
                                               {"render", "s.json", "-D", bad + "=1"},
                                               {"render", "s.json", "-D", bad},
                                               {"list", bad},
                                               {"sheet", bad + ".exr", "-o", bad + ".png"},
                                               {"info", bad}}) {
        const Outcome outcome = run(line, folder.path());
        EXPECT_NE(outcome.code, 4) << line[0] << " " << outcome.err;
        EXPECT_FALSE(obeyed(outcome.out)) << line[0] << " " << line[1] << ": " << outcome.out;
        EXPECT_FALSE(obeyed(outcome.err)) << line[0] << " " << line[1] << ": " << outcome.err;
    }
    // A name cannot make up lines either.
    const std::string text = run({"info", "c.exr"}, folder.path()).out;
    EXPECT_EQ(text.find("\ny"), std::string::npos) << text;
}

/// A key of the size of a file stays a line that can be read.
TEST_F(Messages, LongKeysAreCut) {
    for (const std::string& assignment : {std::string(100000, 'k'), std::string(100000, 'k') + "=1",
                                          "camera." + std::string(100000, 'k') + "=1"}) {
        const Outcome outcome = run({"render", "s.json", "-D", assignment}, folder.path());
        EXPECT_TRUE(outcome.code == 2 || outcome.code == 3) << outcome.code;
        EXPECT_LT(outcome.err.size(), 1500u);
        EXPECT_NE(outcome.err.find("kkk..."), std::string::npos) << outcome.err;
    }
}

// ---- Places that are gone -----------------------------------------------------------------------

TEST_F(Messages, AVanishedWorkingDirectory) {
    const std::string scene = (folder / "s.json").string();
    const auto run_in_vanished = [&](const std::vector<std::string>& arguments) {
        const std::filesystem::path place = folder / "gone";
        std::filesystem::create_directory(place);
        return run_prepared(arguments, folder, [=, this] {
            to_file(2, (folder / "err").string())();
            // Started here, and not in the folder of the test.
            if (chdir(place.c_str()) != 0 || rmdir(place.c_str()) != 0) _exit(126);
            become_quadrel(arguments);
        });
    };
    EXPECT_EQ(run_in_vanished({"render", scene}), 5) << file_bytes(folder / "err");
    EXPECT_EQ(run_in_vanished({"render", scene, "-o", "a.exr"}), 5);
    EXPECT_EQ(run_in_vanished({"render", "s.json", "-o", "/dev/null"}), 3);
    EXPECT_EQ(run_in_vanished({"render", scene, "-o", (folder / "whole.exr").string()}), 0);
    EXPECT_EQ(run_in_vanished({"mips", (folder / "a.exr").string(), "-o", "m"}), 5);
    EXPECT_EQ(run_in_vanished({"list", "scenes"}), 0);
}

TEST_F(Messages, AnEmptyPluginName) {
    const BadInput bad{"empty", {"render", "s.json", "--plugin", ""}, 2, {"--plugin"}};
    EXPECT_TRUE(complains(run(bad.arguments, folder.path()), bad));
}

}  // namespace
}  // namespace quadrel::cli_tests
