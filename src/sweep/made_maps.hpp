// The maps of a sweep as files, for scenes to read.
#pragma once

#include <filesystem>

#include "sweep/plan/plan.hpp"

namespace quadrel::sweep {

/// Writes a map that is made, and returns its name: folder/KIND-SIZE-HASH.exr by its content, so
/// that what is there need not be written, unless it is damaged. Throws OutputError.
std::filesystem::path write_made_map(const std::filesystem::path& folder, const PlannedMap& map);

/// The tangent-space normals of a height map for a relief `depth` tiles thick, coded from 0 to 1,
/// in the same folder. Wraps around.
std::filesystem::path write_normal_map(const std::filesystem::path& folder,
                                       const std::filesystem::path& heights, double depth);

struct MapSize {
    int width = 0, height = 0;
};

/// Of an image file; what was asked before is known.
MapSize size_of_map(const std::filesystem::path& file);

}  // namespace quadrel::sweep
