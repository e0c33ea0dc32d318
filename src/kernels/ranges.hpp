// Stages on ranges (num/range): a module of its own, loaded when a render first asks for ranges.
#pragma once

#include "kernels/table.hpp"
#include "quadrel/num/range/context.hpp"

namespace quadrel {

/// What the module exports. Values are arrays of Ranged; integers, of pairs (num/range/mask.hpp).
struct RangeTable {
    std::uint32_t magic, abi_version;
    std::int32_t value_bytes, context_bytes;
    const KernelRow* rows;
    std::int32_t count;
    RangeContext* (*context)();  ///< the calling thread's
    /// All that element `lane` of an array of values may be, under the calling thread's context.
    void (*ends)(const void* values, std::int32_t lane, double* low, double* high);
    /// Lets each lane of an array of values be what it is in the other one, too.
    void (*join)(void* values, const void* others);
    /// Lets one lane of an array of values be no more than it is in the other one, too.
    void (*narrow)(void* values, const void* others, std::int32_t lane);
    /// Names what the coordinates u and v of each lane may be off by, so that what is computed from
    /// them is known to move with them.
    void (*name_place)(void* u, void* v);
};

/// A changed layout changes it.
inline constexpr std::uint32_t range_abi_version =
    kernel_abi_version + static_cast<std::uint32_t>(sizeof(RangeTable));

inline constexpr const char* range_symbol = "quadrel_range_table";

/// The module's table. Throws UsageError where it is not installed.
const RangeTable& range_kernels();

/// The stage of that id, or null: then it does not run on ranges.
StageFunction find_kernel(const RangeTable& table, std::string_view id);

}  // namespace quadrel
