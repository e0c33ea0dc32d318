// Height maps that are hard on searches, as files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace quadrel::stress {

/// A kind of field at one size: "impulse" of 16x16 is the file impulse-16x16.exr.
struct MapName {
    std::string kind;
    int width = 0, height = 0;

    std::string file() const;
    /// Whether it has texels that are no finite numbers.
    bool has_nan() const { return kind == "nan" || kind == "infinite"; }
};

/// Kinds that may stand in any scene, and those that need `allow_nan`.
const std::vector<std::string>& map_kinds();
const std::vector<std::string>& nan_map_kinds();

/// Sizes from 1x1 on, powers of two and not.
const std::vector<std::pair<int, int>>& map_sizes();

/// Writes each kind at each size.
void write_maps(const std::filesystem::path& folder);
/// Writes one.
void write_map(const std::filesystem::path& folder, const MapName& map);

}  // namespace quadrel::stress
