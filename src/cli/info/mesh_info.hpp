// What a mesh's file holds.
#pragma once

#include <string>

#include "cli/info/file_info.hpp"

namespace quadrel::cli {

/// Counts, sets of texture coordinates, bounds, and what is ignored. Throws InputError.
Json mesh_info(const std::string& file);

}  // namespace quadrel::cli
