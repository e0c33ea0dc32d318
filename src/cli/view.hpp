// Pages as files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "page/view.hpp"

namespace quadrel::cli {

/// Writes the page and says so, with a warning where it is large. Throws UsageError for more values
/// than a browser holds, OutputError.
void write_view(const std::filesystem::path& output, const std::vector<page::ViewSource>& sources);

/// Likewise of a page that is made; `less` says how it would be smaller.
void write_page(const std::filesystem::path& output, const std::string& page, const char* less);

/// Images under the names of their files, or under paths where these are the same.
std::vector<page::ViewSource> named_sources(std::vector<ComparableImage> images);

}  // namespace quadrel::cli
