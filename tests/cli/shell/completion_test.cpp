// Completion: everything that the program takes is offered, and nothing else, by its own tables and
// in real shells.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "cli/shell/shells.hpp"

namespace quadrel::cli_tests {
namespace {

using Words = std::vector<std::string>;
using Names = std::set<std::string>;

struct Offer {
    std::map<std::string, std::string> meanings;  ///< by word
    bool files = false;
    std::string endings;
    bool has(const std::string& word) const { return meanings.contains(word); }
    Names names() const {
        Names names;
        for (const auto& [word, meaning] : meanings) names.insert(word);
        return names;
    }
};

Offer offer(const Words& line) {
    Words words{"completion", "words", "--"};
    words.insert(words.end(), line.begin(), line.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    Offer offer;
    std::istringstream lines(outcome.out);
    for (std::string text; std::getline(lines, text);) {
        const std::size_t tab = text.find('\t');
        EXPECT_NE(tab, std::string::npos) << text;
        const std::string word = text.substr(0, tab), rest = text.substr(tab + 1);
        if (word == ":files") {
            offer.files = true;
            offer.endings = rest;
            continue;
        }
        EXPECT_TRUE(word.starts_with(line.back())) << word;
        EXPECT_TRUE(offer.meanings.emplace(word, rest).second) << word << " twice";
    }
    return offer;
}

/// Names in `quadrel list KIND --json` under `key`.
Names listed(const std::string& kind, const std::string& key, const std::string& room = "") {
    Names names;
    for (const auto& row : nlohmann::json::parse(run({"list", kind, "--json"}).out))
        if (room.empty() || row["kind"] == room) names.insert(row[key]);
    return names;
}

/// Options that a help text names: "  -o,--output OUT.exr".
Names options_in(const std::string& help) {
    Names names;
    std::istringstream lines(help.substr(0, help.find("Examples:")));
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("  -")) continue;
        std::istringstream words(line.substr(2, line.find_first_of(" {", 3) - 2));
        for (std::string word; std::getline(words, word, ',');) names.insert(word);
    }
    return names;
}

TEST(Completion, OffersEveryVerbAndOption) {
    const Names verbs = offer({""}).names();
    EXPECT_TRUE(verbs.contains("render") && verbs.contains("help"));
    const std::string help = run({"--help"}).out;
    for (const std::string& verb : verbs) {
        if (verb == "help" || verb == "version") continue;
        EXPECT_NE(help.find("\n  " + verb + " "), std::string::npos) << verb;
        if (verb == "list" || verb == "completion") continue;  // its options are of what follows
        const Names known = options_in(run({verb, "--help"}).out);
        EXPECT_GT(known.size(), 1u) << verb;
        EXPECT_EQ(offer({verb, "-"}).names(), known) << verb;
    }
    EXPECT_EQ(offer({"ren"}).names(), Names{"render"});
    EXPECT_EQ(offer({"help", "rend"}).names(), Names{"render"});
    EXPECT_EQ(offer({"list", ""}).names(), (Names{"algorithms", "channels", "presets", "scenes"}));
    EXPECT_EQ(offer({"list", "scenes", "--js"}).names(), Names{"--json"});
}

TEST(Completion, OffersScenesAndFiles) {
    const Offer scenes = offer({"render", ""});
    EXPECT_EQ(scenes.names(), listed("scenes", "name"));
    EXPECT_TRUE(scenes.files);
    EXPECT_EQ(scenes.endings, ".json .glib ");
    EXPECT_TRUE(offer({"render", "-D", "size=[8,8]", "rows/l"}).has("rows/linear"));
    EXPECT_EQ(offer({"render", "a", "--preview", ""}).endings, ".png ");
    EXPECT_EQ(offer({"view", "a", "-o", ""}).endings, ".html ");
    EXPECT_TRUE(offer({"compare", "a", ""}).files);
    // All arguments are there: what may follow are options.
    EXPECT_TRUE(offer({"render", "bricks-45", ""}).has("--channels"));
    EXPECT_TRUE(offer({"render", "--", "-"}).meanings.empty());
}

TEST(Completion, OffersChannelsOneAfterTheOther) {
    Names channels;
    for (const std::string& name : listed("channels", "name"))
        if (name.find('<') == std::string::npos) channels.insert(name);
    const Names offered = offer({"render", "a", "--channels", ""}).names();
    for (const std::string& channel : channels) EXPECT_TRUE(offered.contains(channel)) << channel;
    EXPECT_TRUE(offered.contains("hit") && offered.contains("light.diffuse"));
    EXPECT_TRUE(offer({"render", "a", "--channels", "R,G,hit.st"}).has("R,G,hit.status"));
    EXPECT_TRUE(offer({"render", "a", "--channels=R,hit.st"}).has("--channels=R,hit.status"));
    EXPECT_TRUE(offer({"compare", "a", "b", "--abs", "N."}).has("N.X="));
    // What is offered is taken; groups, too.
    for (const char* const name : {"hit", "light.diffuse", "exact.dhitUVdx", "certified"}) {
        EXPECT_TRUE(offered.contains(name)) << name;
        EXPECT_EQ(run({"render", "bricks-45", "--explain", "--channels", name}).code, 0) << name;
    }
}

TEST(Completion, OffersKeysOfScenes) {
    const Names first = offer({"render", "bricks-45", "-D", ""}).names();
    EXPECT_TRUE(first.contains("size=") && first.contains("material.") &&
                first.contains("objects[0]."));
    EXPECT_TRUE(offer({"render", "x", "-Dcamera.f"}).has("-Dcamera.fov_y="));
    EXPECT_TRUE(offer({"render", "x", "--define=camera.f"}).has("--define=camera.fov_y="));
    EXPECT_EQ(
        offer({"render", "x", "-D", "camera.type="}).names(),
        (Names{"camera.type=matrices", "camera.type=orthographic", "camera.type=perspective"}));
    EXPECT_EQ(offer({"render", "x", "-D", "material.relief.preset=godot"}).names(),
              (Names{"material.relief.preset=godot-deep", "material.relief.preset=godot-simple"}));
    EXPECT_EQ(offer({"render", "x", "-D", "objects[0].vis"}).names(), Names{"objects[0].visible="});
    EXPECT_TRUE(offer({"render", "x", "-D", "no.such.key"}).meanings.empty());
    EXPECT_TRUE(offer({"render", "x", "-D", "camera.fov_y="}).meanings.empty());
    EXPECT_EQ(offer({"explain", "camera.fo"}).names(), Names{"camera.fov_y"});
    EXPECT_TRUE(offer({"explain", "hit.sta"}).has("hit.status"));
}

TEST(Completion, OffersStagesAndTheirParameters) {
    Names traces;
    for (const std::string& id : listed("algorithms", "id", "trace"))
        traces.insert("material.relief.trace=" + id);
    traces.insert("material.relief.trace=none");
    EXPECT_EQ(offer({"render", "bricks-45", "-D", "material.relief.trace="}).names(), traces);
    // Of the stage that is chosen, by the line or by the scene.
    const Words line = {"render", "bricks-45",       "-D", "material.relief.trace=linear",
                        "-D",     "material.relief."};
    EXPECT_TRUE(offer(line).has("material.relief.steps="));
    EXPECT_FALSE(offer(line).has("material.relief.mode="));
    EXPECT_TRUE(offer({"render", "bricks-45", "-D", "material.relief.preset=three-relief", "-D",
                       "material.relief.trace.mo"})
                    .has("material.relief.trace.mode="));
    EXPECT_TRUE(offer({"export", "--stage", "trace/cone-c"}).has("trace/cone-cell"));
    EXPECT_TRUE(offer({"bake", "a", "--kind", "max"}).has("max-mip"));
    EXPECT_EQ(offer({"render", "a", "--isa", "avx"}).names(), (Names{"avx2", "avx512"}));
    EXPECT_EQ(offer({"render", "a", "--isa=avx5"}).names(), Names{"--isa=avx512"});
}

/// Names of a scene's own.
TEST(Completion, OffersNamesThatTheSceneHas) {
    const testing_films::TemporaryFolder folder;
    testing_films::write_bytes(folder / "s.json", R"({"quadrel": 1, // with a comment
        "materials": {"stone": {}, "glass": {"relief": {"trace": "qdm"}}}})");
    const std::string scene = (folder / "s.json").string();
    EXPECT_EQ(offer({"render", scene, "-D", "materials."}).names(),
              (Names{"materials.glass.", "materials.stone."}));
    EXPECT_TRUE(offer({"render", scene, "-D", "materials.glass.relief.dep"})
                    .has("materials.glass.relief.depth="));
    testing_films::write_bytes(folder / "s.json", "{\"materials\": ");
    EXPECT_TRUE(offer({"render", scene, "-D", "materials."}).meanings.empty());
}

TEST(Completion, IsQuickEnoughToTypeBy) {
    const auto begin = std::chrono::steady_clock::now();
    offer({"render", "bricks-45", "-D", "material.relief."});
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
}

// ---- In shells ----------------------------------------------------------------------------------

/// `quadrel explain hit.status` typed with two tabs, once `setup` is done.
void expect_completion(const std::string& shell, const std::string& setup) {
    if (!is_installed(shell.substr(0, shell.find(' '))))
        GTEST_SKIP() << shell << " is not installed";
    const ProgramFolder folder;
    testing_films::write_bytes(folder / "my picture.exr", "none");
    ShellTerminal terminal(folder, shell);
    terminal.type("PS1='re''ady> '\n");
    ASSERT_TRUE(terminal.shows("ready> ")) << terminal.seen();
    terminal.type(setup + "; echo do''ne\n");
    ASSERT_TRUE(terminal.shows("done")) << terminal.seen();
    terminal.type("quadrel expl\thit.sta\t\n");
    EXPECT_TRUE(terminal.shows("hit.status: channel")) << terminal.seen();
    // Words that go on: a key, then its value; a list; a file with a blank.
    terminal.type(
        "quadrel render bricks-4\t-D material.relief.sea\t0.5 --expl\t --channels=hit.sta\t\n");
    EXPECT_TRUE(terminal.shows("channels: hit.status")) << terminal.seen();
    terminal.type("quadrel info my\t; echo co''de $?\n");
    EXPECT_TRUE(terminal.shows("code 3")) << terminal.seen();
    EXPECT_NE(terminal.seen().find("my picture.exr: found"), std::string::npos) << terminal.seen();
}

TEST(Completion, InBash) {
    expect_completion("bash --norc --noprofile -i", "source <(quadrel completion bash)");
}

TEST(Completion, InZsh) {
    expect_completion("zsh -f -i",
                      "autoload -Uz compinit; compinit -u -D; source <(quadrel completion zsh)");
}

/// Fish says itself what it would offer.
TEST(Completion, InFish) {
    if (!is_installed("fish")) GTEST_SKIP() << "fish is not installed";
    const ProgramFolder folder;
    testing_films::write_bytes(folder / "picture.exr", "none");
    testing_films::write_bytes(folder / "picture.txt", "none");
    const auto offered = [&](const std::string& line) {
        return output_of("cd '" + folder.path() + "' && env " + folder.environment() +
                         "fish --no-config -c 'quadrel completion fish | source; complete -C \"" +
                         line + "\"'");
    };
    EXPECT_EQ(offered("quadrel expl"),
              "explain\tdocument a scene key, channel, stage, parameter, preset or exit code\n");
    EXPECT_NE(offered("quadrel render --chan").find("--channels\t"), std::string::npos);
    EXPECT_NE(offered("quadrel render bricks-45 --channels R,hit.sta").find("R,hit.status\t"),
              std::string::npos);
    EXPECT_NE(
        offered("quadrel render bricks-45 --channels=R,hit.sta").find("--channels=R,hit.status\t"),
        std::string::npos);
    EXPECT_NE(offered("quadrel render x -D material.relief.sea").find("material.relief.seat="),
              std::string::npos);
    EXPECT_EQ(offered("quadrel render x -o pic"), "picture.exr\n");
    EXPECT_NE(offered("quadrel info pic").find("picture.txt"), std::string::npos);
}

TEST(Completion, WrongCommandLinesAreOneLine) {
    for (const Words& words : std::vector<Words>{{"completion"}, {"completion", "tcsh"}}) {
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.code, 2);
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
}

}  // namespace
}  // namespace quadrel::cli_tests
