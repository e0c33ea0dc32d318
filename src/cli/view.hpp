// The viewer's page as a file.
#pragma once

#include <filesystem>
#include <vector>

#include "page/view.hpp"

namespace quadrel::cli {

/// Writes the page and says so, with a warning where it is large. Throws UsageError for more values
/// than a browser holds, OutputError.
void write_view(const std::filesystem::path& output, const std::vector<page::ViewSource>& sources);

}  // namespace quadrel::cli
