// Lists of which words choose.
#pragma once

#include <string>
#include <vector>

#include "render/lists/rows.hpp"

namespace quadrel::cli {

/// Those that have all of the words; where none has, a line says so.
ListRows filtered_rows(ListRows rows, const std::vector<std::string>& words);

}  // namespace quadrel::cli
