#include "kernels/ranges.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include "file/module_path.hpp"
#include "quadrel/error.hpp"
#include "quadrel/num/range/ranged.hpp"

namespace quadrel {
namespace {

const RangeTable& load_ranges() {
    const auto path = find_module("quadrel-ranges");
    if (!path) throw UsageError("ranges: the module quadrel-ranges is not installed");
    void* const module = dlopen(path->c_str(), RTLD_NOW | RTLD_LOCAL);
    if (module == nullptr) throw UsageError(fmt::format("ranges: {}", dlerror()));
    using TableFunction = const RangeTable* (*)();
    const auto function = reinterpret_cast<TableFunction>(dlsym(module, range_symbol));
    const RangeTable* const table = function != nullptr ? function() : nullptr;
    if (table == nullptr || table->magic != kernel_magic ||
        table->abi_version != range_abi_version || table->value_bytes != sizeof(Ranged) ||
        table->context_bytes != sizeof(RangeContext))
        throw UsageError(
            fmt::format("ranges: {} is not of this version of Quadrel", path->string()));
    return *table;
}

}  // namespace

const RangeTable& range_kernels() {
    static const RangeTable& table = load_ranges();
    return table;
}

StageFunction find_kernel(const RangeTable& table, std::string_view id) {
    for (int i = 0; i < table.count; ++i)
        if (id == table.rows[i].id) return table.rows[i].run;
    return nullptr;
}

}  // namespace quadrel
