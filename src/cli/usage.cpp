#include "cli/usage.hpp"

#include <CLI/CLI.hpp>

#include "io/suggest.hpp"

namespace quadrel::cli {
namespace {

std::vector<std::string> verbs_of(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* verb : app.get_subcommands(nullptr)) names.push_back(verb->get_name());
    return names;
}

/// Null if there is none.
const CLI::App* find_verb(const CLI::App& app, const std::string& name) {
    for (const CLI::App* verb : app.get_subcommands(nullptr))
        if (verb->get_name() == name) return verb;
    return nullptr;
}

std::vector<std::string> options_of(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

/// ", did you mean ...?" about the first option that the verb does not have; empty if it has all.
std::string option_hint(const CLI::App& app, const std::vector<std::string>& arguments) {
    const std::vector<std::string> known = options_of(app);
    for (const std::string& argument : arguments) {
        const std::string name = argument.substr(0, argument.find('='));
        if (!name.starts_with("--") || name == "--") continue;
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        const std::string nearest = nearest_word(name, known);
        return nearest.empty() ? "" : ", did you mean " + nearest + "?";
    }
    return "";
}

}  // namespace

SpelledVerb spelled_verb(const CLI::App& program, const std::vector<std::string>& arguments) {
    SpelledVerb verb{&program, program.get_name(), ""};
    for (const std::string& argument : arguments) {
        if (verbs_of(*verb.app).empty()) break;
        if (argument.starts_with("-")) continue;
        const CLI::App* next = find_verb(*verb.app, argument);
        if (next == nullptr) {
            verb.unknown = argument;
            break;
        }
        verb.app = next;
        verb.name += " " + argument;
    }
    return verb;
}

std::string with_help(const std::string& message, const SpelledVerb& verb) {
    if (message.find("(see `") != std::string::npos) return message;
    return message + " (see `" + verb.name + " --help`)";
}

std::string usage_message(const CLI::ParseError& error, const SpelledVerb& verb,
                          const std::vector<std::string>& arguments) {
    if (!verb.unknown.empty())
        return with_help(
            "found \"" + verb.unknown + "\", expected " + one_of(verb.unknown, verbs_of(*verb.app)),
            verb);
    return with_help(error.what() + option_hint(*verb.app, arguments), verb);
}

}  // namespace quadrel::cli
