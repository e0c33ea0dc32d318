// quadrel completion: what makes shells complete its command lines.
#include <CLI/CLI.hpp>
#include <memory>

#include "cli/common/console.hpp"
#include "cli/shell/scripts.hpp"
#include "cli/shell/words.hpp"
#include "cli/verbs.hpp"
#include "text/printable.hpp"

namespace quadrel::cli {
namespace {

/// A line a word: the word, a tab, what it means; ":files" and how they may end for names of files.
ExitCode print_words(const std::vector<std::string>& words) {
    const Candidates candidates = complete(words);
    for (const Candidate& candidate : candidates.words)
        print_bytes(printable(candidate.word) + "\t" + printable(candidate.meaning) + "\n");
    if (!candidates.files) return ExitCode::ok;
    std::string line = ":files\t";
    for (const std::string& kind : candidates.kinds) line += kind + " ";
    print_bytes(line + "\n");
    return ExitCode::ok;
}

}  // namespace

void add_completion(CLI::App& app, Action& action) {
    CLI::App* verb =
        app.add_subcommand("completion", "print what makes a shell complete command lines");
    verb->require_subcommand(1);
    for (const ShellScript& script : shell_scripts()) {
        CLI::App* const shell = verb->add_subcommand(
            script.shell, "the script for " + std::string(script.shell) + ", to be sourced");
        shell->callback([&script, &action] {
            action = [&script] {
                print_bytes(script.text);
                return ExitCode::ok;
            };
        });
    }
    CLI::App* const words = verb->add_subcommand(
        "words", "what may stand next on a line; for the scripts, which ask the program itself");
    const auto line = std::make_shared<std::vector<std::string>>();
    words
        ->add_option("line", *line,
                     "the words behind the program's name up to the one that is typed, which may "
                     "be empty; -- in front of them")
        ->type_name("WORDS");
    words->callback([line, &action] { action = [line] { return print_words(*line); }; });
}

}  // namespace quadrel::cli
