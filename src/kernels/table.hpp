// What an instruction-set module exports: one symbol, a table of plain data. No standard-library
// types, exceptions or allocations cross the border.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "quadrel/quad/stage.hpp"

namespace quadrel {

inline constexpr std::uint32_t kernel_magic = 0x4b445251;  // "QRDK"
/// Raised by hand when a meaning changes; a changed layout changes it by itself.
inline constexpr std::uint32_t kernel_abi_version =
    6u + (static_cast<std::uint32_t>(sizeof(StageCall)) << 8) + (slot_count << 20);

struct KernelRow {
    const char* id;
    StageFunction run;
};

struct KernelGroup {
    const KernelRow* rows;
    std::int32_t count;
};

/// A link of a chain (kernels/chain.hpp) as a plan has it.
struct ChainStage {
    const void* parameters;
    std::int32_t first_light, end_light;  ///< those that it serves; 0 and 1 where it serves none
};

/// Runs a chain. False where a stage may have stored what it must not: then the batch's stages are
/// to run one by one. The call's parameters and light are not read.
using ChainFunction = bool (*)(const StageCall*, const ChainStage*);

struct ChainRow {
    const char* const* ids;  ///< of its stages
    std::int32_t length;
    ChainFunction run;
};

struct ChainGroup {
    const ChainRow* rows;
    std::int32_t count;
};

struct KernelTable {
    std::uint32_t magic, abi_version;
    const char* isa;
    std::int32_t lanes;
    std::int32_t scalar_bytes;  ///< 4: float values, 8: double values, sizeof(Dual): duals
    std::int32_t count;
    const KernelGroup* groups;
    const ChainGroup* chains;  ///< the last one is empty
};

/// All chains of a table.
std::vector<ChainRow> all_chains(const KernelTable& table);

/// The stage of that id, or null.
StageFunction find_kernel(const KernelTable& table, std::string_view id);

/// Ids of all stages of a table.
std::vector<std::string_view> kernel_ids(const KernelTable& table);

/// Name of the one exported symbol.
inline constexpr const char* kernel_symbol = "quadrel_kernel_table";

/// The tables compiled into the library: plain x86-64, Quad<float> and Quad<double>.
const KernelTable& scalar_float_kernels();
const KernelTable& scalar_double_kernels();
/// Quad<Dual>: the stages up to the hit that declare runs_on_duals. Values are arrays of Dual.
const KernelTable& dual_kernels();

}  // namespace quadrel
