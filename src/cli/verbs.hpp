// The verbs of the command line, one file each. A verb adds its subcommand and says, when that was
// chosen, what is to be run.
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <memory>
#include <string_view>

#include "quadrel/error.hpp"

namespace quadrel::cli {

/// What the chosen verb does once the whole command line is parsed.
using Action = std::function<ExitCode()>;

void add_render(CLI::App& app, Action& action);
void add_list(CLI::App& app, Action& action);
void add_info(CLI::App& app, Action& action);
void add_compare(CLI::App& app, Action& action);
void add_probe(CLI::App& app, Action& action);
void add_sheet(CLI::App& app, Action& action);
void add_mips(CLI::App& app, Action& action);
void add_bake(CLI::App& app, Action& action);
void add_errors(CLI::App& app, Action& action);
void add_explain(CLI::App& app, Action& action);
void add_sweep(CLI::App& app, Action& action);
void add_advise(CLI::App& app, Action& action);
void add_export(CLI::App& app, Action& action);
void add_view(CLI::App& app, Action& action);
void add_join(CLI::App& app, Action& action);
void add_man(CLI::App& app, Action& action);
void add_completion(CLI::App& app, Action& action);

bool is_verb(std::string_view name);

/// Describing the options of all verbs takes most of the time of starting.
enum class VerbsAdded { none, one, all };

/// The program with its verbs, or with `only` one of them, to be parsed with or to be described.
/// `action` must outlive it.
std::unique_ptr<CLI::App> make_program(Action& action, VerbsAdded added,
                                       std::string_view only = "");

}  // namespace quadrel::cli
