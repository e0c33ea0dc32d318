#include "cli/shell/typed_line.hpp"

#include <CLI/CLI.hpp>

namespace quadrel::cli {
namespace {

const CLI::App* find_sub_verb(const CLI::App& app, const std::string& name) {
    for (const CLI::App* verb : app.get_subcommands(nullptr))
        if (verb->get_name() == name) return verb;
    return nullptr;
}

/// Whether words that follow its value are values, too.
bool takes_many(const CLI::Option& option) {
    return option.get_allow_extra_args() && option.get_items_expected_max() > 1;
}

/// A word that begins an option: "--size", "--size=8x8", "-t", "-t4".
struct OptionWord {
    const CLI::Option* option = nullptr;
    std::string before;  ///< up to its value, if that is part of the word
    bool has_value = false;
};

OptionWord read_option(const CLI::App& verb, const std::string& word) {
    if (word.starts_with("--")) {
        const std::size_t end = word.find('=');
        const bool has_value = end != std::string::npos;
        return {find_option(verb, word.substr(0, end)), has_value ? word.substr(0, end + 1) : word,
                has_value};
    }
    const std::string name = word.substr(0, 2);
    return {find_option(verb, name), name, word.size() > 2};
}

bool begins_option(const std::string& word) { return word.size() > 1 && word[0] == '-'; }

class LineReader {
  public:
    explicit LineReader(const CLI::App& program) { line_.at = &program; }

    void pass(const std::string& word) {
        if (!line_.only_values && word == "--") {
            line_.only_values = true;
            line_.option = nullptr;
        } else if (line_.option != nullptr &&
                   (!begins_option(word) || !takes_many(*line_.option))) {
            take_value(word);
        } else if (!line_.only_values && begins_option(word)) {
            begin_option(word);
        } else {
            pass_plain(word);
        }
    }

    TypedLine end(const std::string& word) {
        line_.begun = word;
        const bool is_value = line_.only_values || !begins_option(word);
        if (is_value) return line_;
        if (line_.option != nullptr && !takes_many(*line_.option)) return line_;
        line_.option = nullptr;
        const OptionWord read = read_option(*line_.at, word);
        if (read.option == nullptr || !read.has_value) return line_;
        line_.option = read.option;
        line_.before = read.before;
        line_.begun = word.substr(read.before.size());
        return line_;
    }

  private:
    void take_value(const std::string& word) {
        keep_define(*line_.option, word);
        if (!takes_many(*line_.option)) line_.option = nullptr;
    }

    void begin_option(const std::string& word) {
        const OptionWord read = read_option(*line_.at, word);
        line_.option = nullptr;
        if (read.option == nullptr || !takes_value(*read.option)) return;
        line_.option = read.option;
        if (read.has_value) take_value(word.substr(read.before.size()));
    }

    void pass_plain(const std::string& word) {
        const CLI::App* const sub = find_sub_verb(*line_.at, word);
        if (sub != nullptr)
            line_.at = sub;
        else if (!is_help(word))
            line_.positional.push_back(word);
    }

    /// "help VERB" is completed as the verb's name is.
    bool is_help(const std::string& word) const {
        return line_.at->get_parent() == nullptr && word == "help";
    }

    void keep_define(const CLI::Option& option, const std::string& value) {
        if (option.check_name("-D")) line_.defines.push_back(value);
    }

    TypedLine line_;
};

}  // namespace

const CLI::Option* find_option(const CLI::App& verb, const std::string& name) {
    for (const CLI::Option* option : verb.get_options())
        if (option->nonpositional() && option->check_name(name)) return option;
    return nullptr;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

TypedLine read_line(const CLI::App& program, const std::vector<std::string>& words) {
    LineReader reader(program);
    for (std::size_t i = 0; i + 1 < words.size(); ++i) reader.pass(words[i]);
    return reader.end(words.empty() ? "" : words.back());
}

}  // namespace quadrel::cli
