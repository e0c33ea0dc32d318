// What a plugin exports: one symbol, a function that returns a table of plain data. No
// standard-library types, exceptions or allocations cross the border.
#pragma once

#include "quadrel/quad/stage_row.hpp"

namespace quadrel {

inline constexpr std::uint32_t plugin_magic = 0x50445251;  // "QRDP"
inline constexpr const char* plugin_symbol = "quadrel_plugin";

/// The stages that one source file of a plugin names.
struct PluginRows {
    const StageRow* rows;
    std::int32_t count;
    const PluginRows* next;
};

/// One part of a plugin: the main one ("scalar"), or that for an instruction set.
struct PluginTable {
    std::uint32_t magic, abi_version;
    const char* isa;
    std::int32_t lanes;  ///< of a packet of floats
    const PluginRows* first;
};

using PluginFunction = const PluginTable* (*)();

}  // namespace quadrel
