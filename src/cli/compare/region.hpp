// Which pixels of two images are compared: --window and --overlap.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "quadrel/film/film.hpp"

namespace quadrel::cli {

struct RegionArguments {
    std::string window;
    bool overlap = false;
};

void add_region_options(CLI::App& verb, RegionArguments& region);

/// Keeps of both films what is to be compared, and returns it; nothing without options. Frames are
/// left as they are: they must be equal all the same. Throws UsageError for a window that does not
/// lie in both images, or images that share no pixel.
std::optional<Window> keep_region(const RegionArguments& region, Film& reference, Film& test);

}  // namespace quadrel::cli
