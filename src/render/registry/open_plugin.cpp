#include <dlfcn.h>
#include <fmt/format.h>

#include "file/read_file.hpp"
#include "quadrel/error.hpp"
#include "render/registry/added_stages.hpp"
#include "render/registry/elf_check.hpp"

namespace quadrel {
namespace {

constexpr const char* a_plugin = "a plugin built by quadrel_add_stages";

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& found,
                         const std::string& expected = a_plugin) {
    throw InputError(file.string(), "", found, expected);
}

/// The loader's own words, without the name of the file that the message begins with.
std::string loader_message(const std::filesystem::path& file) {
    const char* said = dlerror();
    std::string text = said != nullptr ? said : "a file that cannot be loaded";
    const std::string prefix = file.string() + ": ";
    return text.starts_with(prefix) ? text.substr(prefix.size()) : text;
}

}  // namespace

const PluginTable* open_plugin(const std::filesystem::path& file, std::string_view isa) {
    std::error_code error;
    if (const char* const reason = reason_not_to_read(file)) refuse(file, reason);
    if (const auto fault = elf_fault(read_whole_file(file))) refuse(file, *fault);
    // With a slash in it, so that the loader does not look anywhere else.
    const std::filesystem::path path = std::filesystem::absolute(file, error);
    if (error) refuse(file, "no working directory", "a full path");
    void* module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (module == nullptr) refuse(file, fmt::format("\"{}\"", loader_message(path)));
    const auto function = reinterpret_cast<PluginFunction>(dlsym(module, plugin_symbol));
    const PluginTable* table = function != nullptr ? function() : nullptr;
    if (table == nullptr || table->magic != plugin_magic)
        refuse(file, "a shared object that is no plugin");
    if (table->abi_version != stage_abi_version)
        refuse(file,
               fmt::format("a plugin built for another version of Quadrel (stages {:08x})",
                           table->abi_version),
               fmt::format("one built for this version (stages {:08x})", stage_abi_version));
    if (table->isa != isa)
        refuse(file, fmt::format("the {} part of a plugin", table->isa),
               fmt::format("its {} part", isa));
    return table;
}

std::vector<const StageRow*> rows_of(const PluginTable& table) {
    std::vector<const StageRow*> rows;
    for (const PluginRows* file = table.first; file != nullptr; file = file->next)
        for (int i = 0; i < file->count; ++i) rows.push_back(file->rows + i);
    return rows;
}

}  // namespace quadrel
