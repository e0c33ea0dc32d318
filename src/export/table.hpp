// What the module quadrel-shaders exports: plain data, as every module.
#pragma once

#include <cstdint>

namespace quadrel {

/// A stage that the module knows.
struct ExportedStage {
    const char* id;
    const char* room;
    const char* refusal;  ///< why it cannot be written; null where it can
};

struct ExportRequest {
    const char* stage;     ///< id
    const char* language;  ///< one of ExportTable::languages
    const void* params;    ///< the stage's Params; null: the defaults
    std::int32_t side;     ///< of the maps, in texels
    std::int32_t lights;
    std::int32_t uniforms;  ///< 1: parameters are uniforms where they can be; 0: constants
    /// Receives the text, or why there is none.
    void (*put)(void* to, const char* text);
    void* to;
};

struct ExportTable {
    std::uint32_t magic, abi_version;
    const char* const* languages;
    std::int32_t language_count;
    /// All stages, in the order of the data flow.
    void (*stages)(void (*put)(void* to, const ExportedStage* stage), void* to);
    /// Whether there is a text.
    bool (*write)(const ExportRequest* request);
};

inline constexpr std::uint32_t export_magic = 0x58455251;  // "QREX"
inline constexpr std::uint32_t export_abi_version = 2;
inline constexpr const char* export_symbol = "quadrel_export_table";

}  // namespace quadrel
