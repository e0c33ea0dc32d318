#include "export/export.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include "file/module_path.hpp"
#include "quadrel/error.hpp"

namespace quadrel {
namespace {

const ExportTable& load_table() {
    const auto path = find_module("quadrel-shaders");
    if (!path) throw UsageError("export: the module quadrel-shaders is not installed");
    void* const module = dlopen(path->c_str(), RTLD_NOW | RTLD_LOCAL);
    if (module == nullptr) throw UsageError(fmt::format("export: {}", dlerror()));
    using TableFunction = const ExportTable* (*)();
    const auto function = reinterpret_cast<TableFunction>(dlsym(module, export_symbol));
    const ExportTable* const table = function != nullptr ? function() : nullptr;
    if (table == nullptr || table->magic != export_magic ||
        table->abi_version != export_abi_version)
        throw UsageError(
            fmt::format("export: {} is not of this version of Quadrel", path->string()));
    return *table;
}

}  // namespace

const ExportTable& export_table() {
    static const ExportTable& table = load_table();
    return table;
}

std::vector<ExportRow> export_rows() {
    std::vector<ExportRow> rows;
    export_table().stages(
        [](void* to, const ExportedStage* stage) {
            static_cast<std::vector<ExportRow>*>(to)->push_back(
                {stage->id, stage->room, stage->refusal != nullptr ? stage->refusal : ""});
        },
        &rows);
    return rows;
}

std::vector<std::string> export_languages() {
    const ExportTable& table = export_table();
    return {table.languages, table.languages + table.language_count};
}

std::string export_stage(std::string_view id, const ExportOptions& options) {
    const std::string stage(id);
    std::string text;
    const ExportRequest request{
        stage.c_str(),
        options.language.c_str(),
        options.params,
        options.side,
        options.lights,
        options.uniforms ? 1 : 0,
        [](void* to, const char* part) { *static_cast<std::string*>(to) += part; },
        &text};
    if (!export_table().write(&request))
        throw UsageError(fmt::format("export: {}: {}", stage, text));
    return text;
}

}  // namespace quadrel
