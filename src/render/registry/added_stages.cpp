#include "render/registry/added_stages.hpp"

#include <fmt/format.h>

#include <deque>
#include <map>
#include <mutex>

#include "file/read_file.hpp"
#include "kernels/select.hpp"
#include "quadrel/error.hpp"
#include "render/registry/stage_check.hpp"
#include "text/hash.hpp"

namespace quadrel {
namespace {

namespace fs = std::filesystem;

/// A plugin, and its functions by instruction set.
struct Plugin {
    fs::path file;
    std::string hash;  ///< SHA-256 of the file
    std::vector<const StageRow*> rows;
    std::map<std::string, std::vector<const StageRow*>, std::less<>> parts;
};

struct AddedStages {
    std::mutex mutex;
    std::vector<const StageRow*> rows;
    std::deque<Plugin> plugins;
};

AddedStages& added() {
    static AddedStages stages;
    return stages;
}

const StageRow* find_row(const std::vector<const StageRow*>& rows, std::string_view id) {
    for (const StageRow* row : rows)
        if (id == row->text.id) return row;
    return nullptr;
}

/// The first fault among rows that are to be added together.
std::optional<StageFault> first_fault(const std::vector<const StageRow*>& rows) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (auto fault = find_fault(*rows[i], all_stages())) return fault;
        const std::vector<const StageRow*> before(rows.begin(), rows.begin() + std::ptrdiff_t(i));
        if (find_row(before, rows[i]->text.id))
            return StageFault{rows[i]->text.id, "the same id twice", "an id of its own"};
    }
    return std::nullopt;
}

void add(AddedStages& stages, const std::vector<const StageRow*>& rows) {
    append_to_registry(rows);
    stages.rows.insert(stages.rows.end(), rows.begin(), rows.end());
}

fs::path part_file(const Plugin& plugin, std::string_view isa) {
    return plugin.file.parent_path() / fmt::format("{}-{}{}", plugin.file.stem().string(), isa,
                                                   plugin.file.extension().string());
}

/// The part for an instruction set must have been built from the same stages.
void check_part(const Plugin& plugin, const fs::path& file,
                const std::vector<const StageRow*>& part) {
    for (const StageRow* row : plugin.rows) {
        const StageRow* other = find_row(part, row->text.id);
        if (other == nullptr || other->params_size != row->params_size ||
            other->input_count != row->input_count || other->output_count != row->output_count)
            throw InputError(file.string(), row->text.id,
                             other == nullptr ? "no such stage" : "another form of this stage",
                             "that of " + plugin.file.string() + ": rebuild the plugin");
    }
}

/// Loads a plugin's part for `isa` unless it is there; false if there is no such file.
bool load_part(Plugin& plugin, const std::string& isa) {
    if (plugin.parts.contains(isa)) return true;
    const fs::path file = part_file(plugin, isa);
    std::error_code error;
    if (!fs::exists(file, error)) return false;
    const std::vector<const StageRow*> part = rows_of(*open_plugin(file, isa));
    check_part(plugin, file, part);
    plugin.parts[isa] = part;
    return true;
}

/// What a plugin has for an instruction set; null where it has none, or where the stage is not its.
const StageRow* row_of_plugins(const AddedStages& stages, const StageRow* row,
                               std::string_view isa) {
    for (const Plugin& plugin : stages.plugins) {
        const auto part = plugin.parts.find(isa);
        if (part != plugin.parts.end() && find_row(plugin.rows, row->text.id) == row)
            return find_row(part->second, row->text.id);
    }
    return nullptr;
}

}  // namespace

void register_rows(std::span<const StageRow> span) {
    AddedStages& stages = added();
    const std::lock_guard lock(stages.mutex);
    std::vector<const StageRow*> rows;
    for (const StageRow& row : span) {
        const StageRow* known = find_row(stages.rows, row.text.id);
        if (known == nullptr || known->run != row.run) rows.push_back(&row);
    }
    if (const auto fault = first_fault(rows))
        throw UsageError(fmt::format("stage \"{}\": found {}, expected {}", fault->stage,
                                     fault->found, fault->expected));
    add(stages, rows);
}

void load_plugin(const fs::path& file) {
    AddedStages& stages = added();
    const std::lock_guard lock(stages.mutex);
    std::error_code error;
    const fs::path full = fs::absolute(file, error);
    const fs::path path = error ? file : fs::weakly_canonical(full, error);
    for (const Plugin& plugin : stages.plugins)
        if (plugin.file == path) return;
    Plugin plugin{path, "", rows_of(*open_plugin(file, "scalar")), {}};
    // Loaded when a render first needs them.
    for (const std::string& isa : isa_names()) note_input(part_file(plugin, isa));
    plugin.hash = sha256_hex(read_whole_file(path));
    if (const auto fault = first_fault(plugin.rows))
        throw InputError(file.string(), fmt::format("stage \"{}\"", fault->stage), fault->found,
                         fault->expected);
    add(stages, plugin.rows);
    stages.plugins.push_back(std::move(plugin));
}

std::vector<fs::path> loaded_plugins() {
    AddedStages& stages = added();
    const std::lock_guard lock(stages.mutex);
    std::vector<fs::path> files;
    for (const Plugin& plugin : stages.plugins) files.push_back(plugin.file);
    return files;
}

std::vector<std::string> plugin_hashes() {
    AddedStages& stages = added();
    const std::lock_guard lock(stages.mutex);
    std::vector<std::string> out;
    for (const Plugin& plugin : stages.plugins)
        out.push_back(plugin.file.filename().string() + " " + plugin.hash);
    return out;
}

StageFunction find_added_kernel(const KernelTable& table, std::string_view id) {
    AddedStages& stages = added();
    const std::lock_guard lock(stages.mutex);
    const StageRow* row = find_row(stages.rows, id);
    if (row == nullptr) return nullptr;
    if (table.scalar_bytes == sizeof(double)) return row->run_double;
    if (table.scalar_bytes == sizeof(Dual)) return row->run_dual;
    const StageRow* lanes = row_of_plugins(stages, row, table.isa);
    return (lanes != nullptr ? lanes : row)->run;
}

bool is_added(std::string_view id) {
    AddedStages& stages = added();
    const std::lock_guard lock(stages.mutex);
    return find_row(stages.rows, id) != nullptr;
}

bool runs_on_plain_lanes(const KernelTable& table, std::string_view id) {
    AddedStages& stages = added();
    const std::lock_guard lock(stages.mutex);
    const StageRow* row = find_row(stages.rows, id);
    if (table.isa == std::string_view("scalar")) return false;
    if (row == nullptr) return find_kernel(table, id) == nullptr;
    return row_of_plugins(stages, row, table.isa) == nullptr;
}

const KernelTable& select_kernels(const RenderOptions& options) {
    const KernelTable& table = select_kernels(options.number, options.isa);
    const std::string isa = table.isa;
    if (isa == "scalar") return table;
    AddedStages& stages = added();
    const std::lock_guard lock(stages.mutex);
    for (Plugin& plugin : stages.plugins) {
        if (load_part(plugin, isa) || options.isa == "auto") continue;
        throw UsageError(fmt::format("instruction set \"{}\": {} has no {}", isa,
                                     plugin.file.string(), part_file(plugin, isa).string()));
    }
    return table;
}

}  // namespace quadrel
