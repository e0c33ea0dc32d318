// Where the data files that come with Quadrel lie.
#pragma once

#include <filesystem>
#include <vector>

namespace quadrel {

/// The existing data directories, in the order of search: $QUADREL_DATA, the installed
/// share/quadrel near this binary (module_path.hpp), the source tree that this was built from.
std::vector<std::filesystem::path> data_directories();

/// The first `relative` below the data directories. Throws InputError if there is none.
std::filesystem::path find_data_file(const std::filesystem::path& relative);

}  // namespace quadrel
