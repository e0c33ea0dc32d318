// What a wrong command line is told: the nearest verb or option, and whose help to read.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

namespace quadrel::cli {

/// The words that a command line's arguments spell of the tree of verbs.
struct SpelledVerb {
    const CLI::App* app;  ///< the last that is known: the program itself, a verb, a kind of list
    std::string name;     ///< "quadrel", "quadrel list"
    std::optional<std::string> unknown;  ///< the word after it that should be a verb and is none
};

SpelledVerb spelled_verb(const CLI::App& program, const std::vector<std::string>& arguments);

/// `message` and whose help to read, unless it names a command to look at itself.
std::string with_help(const std::string& message, const SpelledVerb& verb);

/// What to say of `verb.unknown`.
std::string unknown_verb_message(const SpelledVerb& verb);

/// "help VERB" as "VERB --help", "help" as "--help", "version" as "--version".
std::vector<std::string> with_help_words(std::vector<std::string> arguments);

/// "--tev HOST:PORT" as "--tev=HOST:PORT", since that option may stand without a value, in front of
/// a scene.
std::vector<std::string> with_joined_addresses(std::vector<std::string> arguments);

/// Throws UsageError for an option, or an argument that has to be there, that is the empty text: no
/// name, and not the same as none.
void refuse_empty_arguments(const CLI::App& verb);

/// The same for "--option=" with nothing behind it, which a flag would take for its default.
void refuse_empty_values(const CLI::App& verb, const std::vector<std::string>& arguments);

/// What to say of arguments that do not parse.
std::string usage_message(const CLI::ParseError& error, const SpelledVerb& verb,
                          const std::vector<std::string>& arguments);

}  // namespace quadrel::cli
