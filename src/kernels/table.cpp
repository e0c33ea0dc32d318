#include "kernels/table.hpp"

namespace quadrel {

// Made by CMake from kernels/table.cpp.in, one for each number type.
const KernelTable& float_kernels(const char* isa);
const KernelTable& double_kernels(const char* isa);

const KernelTable& scalar_float_kernels() { return float_kernels("scalar"); }
const KernelTable& scalar_double_kernels() { return double_kernels("scalar"); }

StageFunction find_kernel(const KernelTable& table, std::string_view id) {
    for (int g = 0; g < table.count; ++g)
        for (int i = 0; i < table.groups[g].count; ++i)
            if (id == table.groups[g].rows[i].id) return table.groups[g].rows[i].run;
    return nullptr;
}

std::vector<ChainRow> all_chains(const KernelTable& table) {
    std::vector<ChainRow> all;
    for (const ChainGroup* group = table.chains; group->count > 0; ++group)
        all.insert(all.end(), group->rows, group->rows + group->count);
    return all;
}

std::vector<std::string_view> kernel_ids(const KernelTable& table) {
    std::vector<std::string_view> ids;
    for (int g = 0; g < table.count; ++g)
        for (int i = 0; i < table.groups[g].count; ++i)
            ids.emplace_back(table.groups[g].rows[i].id);
    return ids;
}

}  // namespace quadrel
