#include "cli/common/usage.hpp"

#include <CLI/CLI.hpp>

#include "quadrel/error.hpp"
#include "text/suggest.hpp"

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

bool has_letter(const CLI::App& app, char letter) {
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_snames())
            if (name[0] == letter) return true;
    return false;
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Whether an argument names an option that the verb does not have.
bool is_unknown_option(const CLI::App& app, const std::string& argument) {
    if (argument.size() > 1 && argument[0] == '-' && is_letter(argument[1]))
        return !has_letter(app, argument[1]);
    const std::vector<std::string> known = options_of(app);
    return argument.starts_with("--") &&
           std::find(known.begin(), known.end(), argument) == known.end();
}

/// The first such, without what follows "="; empty if there is none.
std::string unknown_option(const CLI::App& app, const std::vector<std::string>& arguments) {
    for (const std::string& argument : arguments) {
        if (argument == "--") break;
        const std::string name = argument.substr(0, argument.find('='));
        if (is_unknown_option(app, name)) return name;
    }
    return "";
}

const CLI::App& program_of(const CLI::App& app) {
    const CLI::App* at = &app;
    while (at->get_parent() != nullptr) at = at->get_parent();
    return *at;
}

std::string option_message(const std::string& option, const SpelledVerb& verb) {
    const CLI::App& program = program_of(*verb.app);
    if (!is_unknown_option(program, option))
        return "found \"" + option + "\" after a verb, expected `" + program.get_name() + " " +
               option + "`";
    return "found \"" + option + "\", expected " + one_of(option, options_of(*verb.app));
}

/// What is wrong with arguments that leave words over, or lack some.
std::string words_message(const CLI::ParseError& error, const SpelledVerb& verb,
                          const std::vector<std::string>& arguments) {
    const std::string option = unknown_option(*verb.app, arguments);
    if (!option.empty()) return option_message(option, verb);
    const std::vector<std::string> verbs = verbs_of(*verb.app);
    if (!verbs.empty())
        return "found nothing after \"" + verb.name + "\", expected " + one_of("", verbs);
    const std::vector<std::string> extra = program_of(*verb.app).remaining(true);
    if (!extra.empty()) return "found \"" + extra.front() + "\", expected no more arguments";
    return error.what();
}

std::string option_name(const CLI::Option& option) {
    const std::vector<std::string>& letters = option.get_snames();
    return letters.empty() ? option.get_name() : "-" + letters[0];
}

}  // namespace

SpelledVerb spelled_verb(const CLI::App& program, const std::vector<std::string>& arguments) {
    SpelledVerb verb{&program, program.get_name(), std::nullopt};
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
    const bool of_words = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr ||
                          dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
    return with_help(of_words ? words_message(error, verb, arguments) : error.what(), verb);
}

std::string unknown_verb_message(const SpelledVerb& verb) {
    return with_help(
        "found \"" + *verb.unknown + "\", expected " + one_of(*verb.unknown, verbs_of(*verb.app)),
        verb);
}

std::vector<std::string> with_help_words(std::vector<std::string> arguments) {
    if (arguments.empty()) return arguments;
    if (arguments[0] == "version") arguments[0] = "--version";
    if (arguments[0] != "help") return arguments;
    while (!arguments.empty() && arguments[0] == "help") arguments.erase(arguments.begin());
    arguments.emplace_back("--help");
    return arguments;
}

std::vector<std::string> with_joined_addresses(std::vector<std::string> arguments) {
    for (std::size_t i = 0; i + 1 < arguments.size(); ++i) {
        const std::string& next = arguments[i + 1];
        const std::size_t colon = next.rfind(':');
        const bool port = colon != std::string::npos && colon + 1 < next.size() &&
                          next.find_first_not_of("0123456789", colon + 1) == std::string::npos;
        if (arguments[i] != "--tev" || !port) continue;
        arguments[i] += "=" + next;
        arguments.erase(arguments.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    }
    return arguments;
}

void refuse_empty_values(const CLI::App& verb, const std::vector<std::string>& arguments) {
    const std::vector<std::string> known = options_of(verb);
    for (const std::string& argument : arguments) {
        if (argument == "--") return;
        if (argument.find('=') + 1 != argument.size()) continue;
        const std::string name = argument.substr(0, argument.size() - 1);
        if (std::find(known.begin(), known.end(), name) != known.end())
            throw UsageError(name + ": found an empty text behind =, expected a value, or no =");
    }
}

void refuse_empty_arguments(const CLI::App& verb) {
    for (const CLI::Option* option : verb.get_options()) {
        const std::string type = option->get_type_name();
        if (type == "WORDS") continue;  // of a line that is being typed
        for (const std::string& text : option->results())
            if (text.empty())
                throw UsageError(option_name(*option) + ": found an empty text, expected " +
                                 (type == "TEXT" ? "a name or value" : type));
    }
}

}  // namespace quadrel::cli
