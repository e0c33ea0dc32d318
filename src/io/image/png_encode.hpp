// A PNG in memory.
#pragma once

#include <filesystem>
#include <string>

#include "quadrel/film/preview.hpp"

namespace quadrel {

/// The bytes of a PNG. In memory, because errors must not jump through libpng's C frames. Throws
/// OutputError that names `file`.
std::string encode_png(const std::filesystem::path& file, const Picture& picture);

}  // namespace quadrel
