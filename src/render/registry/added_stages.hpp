// Stages that the registry does not have from the start: the calling program's, and plugins'.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/table.hpp"
#include "quadrel/quad/plugin_table.hpp"
#include "quadrel/relief/registry.hpp"
#include "quadrel/render.hpp"

namespace quadrel {

/// Appends to all_stages(); the rows have been checked (registry.cpp).
void append_to_registry(std::span<const StageRow* const> rows);

/// The function of an added stage that goes with a table of kernels: on the table's lanes if there
/// are some, else on Quad<float>, which has the same bits; on Quad<double> for a table of doubles,
/// on Quad<Dual> for one of duals. Null if there is no such stage.
StageFunction find_added_kernel(const KernelTable& table, std::string_view id);

/// Whether the registry did not have a stage from the start.
bool is_added(std::string_view id);

/// Whether a stage, added or a judge, has no function of its own for the lanes of a table.
bool runs_on_plain_lanes(const KernelTable& table, std::string_view id);

/// select_kernels, and every plugin's part for their instruction set. Throws UsageError if the
/// caller asked for a set by name and a plugin has no part for it, InputError for a part that is
/// not the plugin's.
const KernelTable& select_kernels(const RenderOptions& options);

/// The plugins that were loaded, in order.
std::vector<std::filesystem::path> loaded_plugins();

/// "name.so SHA-256" of the main part of every loaded plugin, in the order of loading.
std::vector<std::string> plugin_hashes();

/// One part of a plugin, loaded for the rest of the process. Throws InputError (file, what was
/// found) for a file that is missing, no plugin, of another version, or not for `isa`.
const PluginTable* open_plugin(const std::filesystem::path& file, std::string_view isa);

/// The rows of all source files of a part, in order.
std::vector<const StageRow*> rows_of(const PluginTable& table);

}  // namespace quadrel
