#include "cli/shell/manual.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "cli/common/examples.hpp"
#include "cli/explain/environment.hpp"
#include "cli/explain/exit_codes.hpp"
#include "cli/shell/roff.hpp"
#include "cli/shell/typed_line.hpp"
#include "cli/shell/values.hpp"
#include "io/document/keys.hpp"
#include "quadrel/film/channels.hpp"

namespace quadrel::cli {
namespace {

constexpr const char* source = "quadrel " QUADREL_VERSION;

/// What stands for the value: "OUT.exr", "float|double", "INT in [0 - 1024]".
std::string value_text(const CLI::Option& option) {
    std::string type = option.get_type_name();
    const std::vector<std::string> words = listed_words(type);
    if (!words.empty()) {
        std::string text;
        for (const std::string& word : words) text += (text.empty() ? "" : "|") + word;
        return text;
    }
    const std::size_t colon = type.find(":INT in");
    return colon == type.npos ? type : type.substr(colon + 1);
}

/// "-o, --output OUT.exr".
std::string option_term(const CLI::Option& option) {
    std::string term;
    for (const std::string& name : option.get_snames())
        term += (term.empty() ? "" : ", ") + roff_bold("-" + name);
    for (const std::string& name : option.get_lnames())
        term += (term.empty() ? "" : ", ") + roff_bold("--" + name);
    return takes_value(option) ? term + " " + roff_italic(value_text(option)) : term;
}

std::string option_meaning(const CLI::Option& option) {
    std::string text = option.get_description();
    if (!option.get_default_str().empty()) text += " (default " + option.get_default_str() + ")";
    return text;
}

/// "quadrel render scene [options]".
std::string synopsis(const CLI::App& verb) {
    std::string text;
    for (const CLI::App* at = &verb; at != nullptr; at = at->get_parent())
        text = roff_bold(at->get_name()) + (text.empty() ? "" : " ") + text;
    for (const CLI::Option* const option : verb.get_options()) {
        if (option->nonpositional()) continue;
        std::string name = roff_italic(option->get_name(true));
        if (option->get_items_expected_max() > 1) name += "...";
        text += option->get_required() ? " " + name : " [" + name + "]";
    }
    return text + " [" + roff_italic("options") + "]";
}

void add_arguments(const CLI::App& verb, RoffPage& page) {
    for (const CLI::Option* const option : verb.get_options())
        if (!option->nonpositional())
            page.item(roff_italic(option->get_name(true)), option_meaning(*option));
    for (const CLI::Option* const option : verb.get_options())
        if (option->nonpositional()) page.item(option_term(*option), option_meaning(*option));
}

void add_exit_status(RoffPage& page) {
    page.section("Exit status");
    for (const ExitCodeText& row : exit_codes())
        page.item(roff_bold(std::to_string(row.code)), row.meaning);
}

void add_environment(RoffPage& page) {
    page.section("Environment");
    for (const EnvironmentText& row : environment_variables())
        page.item(roff_bold(row.name), row.meaning);
}

void add_verb_examples(const std::string& verb, RoffPage& page) {
    page.section("Examples");
    for (const Example& example : examples())
        if (verb == example.verb)
            page.item(roff_text(fmt::format("quadrel {} {}", verb, example.arguments)),
                      example.meaning);
}

void add_see_also(const std::vector<std::string>& pages, RoffPage& page) {
    page.section("See also");
    std::string lines;
    for (std::size_t i = 0; i < pages.size(); ++i)
        lines += ".BR " + pages[i] + (i + 1 < pages.size() ? "," : "") + "\n";
    page.raw(lines);
}

/// What stands in a verb's help in front of its examples, without what has a section of its own.
std::string details_of(const CLI::App& verb) {
    const std::string footer = verb.get_footer(), codes = exit_code_help();
    std::string details = footer.substr(0, footer.find("Examples:"));
    if (const std::size_t found = details.find(codes); found != details.npos)
        details.erase(found, codes.size());
    while (details.ends_with('\n')) details.pop_back();
    return details;
}

std::string page_name(const CLI::App& verb) { return "quadrel-" + verb.get_name(); }

ManualPage verb_page(const CLI::App& verb) {
    const std::string name = page_name(verb);
    RoffPage page(name, 1, source);
    page.section("Name");
    page.raw(roff_text(name) + " \\- " + roff_text(verb.get_description()) + "\n");
    page.section("Synopsis");
    const auto kinds = verb.get_subcommands(nullptr);
    if (kinds.empty()) page.raw(synopsis(verb) + "\n");
    for (const CLI::App* const kind : kinds) page.raw(synopsis(*kind) + "\n");
    page.section("Options");
    add_arguments(verb, page);
    for (const CLI::App* const kind : kinds) {
        page.subsection(verb.get_name() + " " + kind->get_name());
        page.paragraph(kind->get_description());
        add_arguments(*kind, page);
    }
    if (const std::string details = details_of(verb); !details.empty()) {
        page.section("Details");
        page.listing(details);
    }
    add_verb_examples(verb.get_name(), page);
    add_exit_status(page);
    add_environment(page);
    add_see_also({"quadrel (1)", "quadrel\\-scene (5)", "quadrel\\-channels (7)"}, page);
    return {name, 1, page.text()};
}

ManualPage program_page(const CLI::App& program) {
    RoffPage page("quadrel", 1, source);
    page.section("Name");
    page.raw("quadrel \\- " + roff_text(program.get_description()) + "\n");
    page.section("Synopsis");
    page.raw(roff_bold("quadrel") + " " + roff_italic("verb") + " [" + roff_italic("arguments") +
             "] [" + roff_italic("options") + "]\n");
    page.section("Verbs");
    page.paragraph(
        "Each has a page of its own, such as `quadrel-render`, and `quadrel help VERB`.");
    std::vector<std::string> others;
    for (const CLI::App* const verb : program.get_subcommands(nullptr)) {
        page.item(roff_bold(verb->get_name()), verb->get_description());
        others.push_back(roff_text(page_name(*verb)) + " (1)");
    }
    page.section("Options");
    add_arguments(program, page);
    add_exit_status(page);
    add_environment(page);
    others.insert(others.end(), {"quadrel\\-scene (5)", "quadrel\\-channels (7)"});
    add_see_also(others, page);
    return {"quadrel", 1, page.text()};
}

std::string key_text(const SceneKey& row) {
    std::string text = std::string(row.value);
    if (!row.standard.empty()) text += ". Default: " + std::string(row.standard);
    if (!row.meaning.empty()) text += ". " + std::string(row.meaning);
    return text + ".";
}

ManualPage scene_page() {
    RoffPage page("quadrel-scene", 5, source);
    page.section("Name");
    page.raw("quadrel\\-scene \\- scene files of quadrel\n");
    page.section("Description");
    page.paragraph(
        "JSON with comments, whose first key is `\"quadrel\": 1`. Values can be given on the "
        "command line, too: `-D material.relief.steps=256`. Below, the keys of each kind of "
        "object; `quadrel explain` knows them as well.");
    std::string_view section;
    for (const SceneKey& row : scene_keys()) {
        if (row.section != section) page.section(section = row.section);
        page.item(roff_bold(row.key), key_text(row));
    }
    add_see_also({"quadrel (1)", "quadrel\\-explain (1)", "quadrel\\-channels (7)"}, page);
    return {"quadrel-scene", 5, page.text()};
}

ManualPage channels_page() {
    RoffPage page("quadrel-channels", 7, source);
    page.section("Name");
    page.raw("quadrel\\-channels \\- what images of quadrel can hold\n");
    page.section("Description");
    page.paragraph("Channels for `--channels`, float32 where nothing else is said.");
    for (const ChannelInfo& channel : channel_table())
        page.item(roff_bold(channel.name),
                  fmt::format("{} ({}{})", channel.meaning, channel.unit,
                              channel.type == ChannelType::float32 ? "" : "; uint32"));
    add_see_also({"quadrel (1)", "quadrel\\-render (1)"}, page);
    return {"quadrel-channels", 7, page.text()};
}

}  // namespace

std::vector<ManualPage> manual_pages(const CLI::App& program) {
    std::vector<ManualPage> pages = {program_page(program)};
    for (const CLI::App* const verb : program.get_subcommands(nullptr))
        pages.push_back(verb_page(*verb));
    pages.push_back(scene_page());
    pages.push_back(channels_page());
    return pages;
}

}  // namespace quadrel::cli
