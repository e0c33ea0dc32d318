#include "cli/shell/words.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/shell/typed_line.hpp"
#include "cli/shell/values.hpp"
#include "cli/verbs.hpp"

namespace quadrel::cli {
namespace {

void add_verbs(const CLI::App& app, Candidates& to) {
    for (const CLI::App* const verb : app.get_subcommands(nullptr))
        to.add(verb->get_name(), verb->get_description());
    if (app.get_parent() != nullptr) return;
    to.add("help", "the same as --help");
    to.add("version", "the same as --version");
}

void add_options(const CLI::App& verb, Candidates& to) {
    for (const CLI::Option* const option : verb.get_options()) {
        for (const std::string& name : option->get_lnames())
            to.add("--" + name, option->get_description());
        for (const std::string& name : option->get_snames())
            to.add("-" + name, option->get_description());
    }
}

/// The positional argument that stands next; null if all are there.
const CLI::Option* next_argument(const TypedLine& line) {
    std::size_t left = line.positional.size();
    for (const CLI::Option* const option : line.at->get_options()) {
        if (option->nonpositional()) continue;
        const auto most = static_cast<std::size_t>(option->get_items_expected_max());
        if (left < most) return option;
        left -= most;
    }
    return nullptr;
}

void keep_begun(const std::string& begun, Candidates& candidates) {
    std::erase_if(candidates.words,
                  [&](const Candidate& candidate) { return !candidate.word.starts_with(begun); });
}

}  // namespace

Candidates complete(const std::vector<std::string>& words) {
    Action none;
    const auto program = make_program(none, VerbsAdded::all);
    const TypedLine line = read_line(*program, words);
    Candidates candidates;
    if (line.option != nullptr)
        add_values_of(*line.option, line, candidates);
    else if (!line.only_values && line.begun.starts_with('-'))
        add_options(*line.at, candidates);
    else if (!line.at->get_subcommands(nullptr).empty())
        add_verbs(*line.at, candidates);
    else if (const CLI::Option* const argument = next_argument(line))
        add_values_of(*argument, line, candidates);
    else if (!line.only_values)
        add_options(*line.at, candidates);
    keep_begun(line.before + line.begun, candidates);
    return candidates;
}

}  // namespace quadrel::cli
