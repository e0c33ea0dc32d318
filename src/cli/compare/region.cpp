#include "cli/compare/region.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "cli/common/arguments.hpp"
#include "quadrel/error.hpp"

namespace quadrel::cli {
namespace {

void require_inside(const Window& window, const Film& film, const char* which) {
    if (contains(film.window, window)) return;
    const Window& has = film.window;
    throw UsageError(fmt::format(
        "--window: found {},{},{},{}, expected one in the {} image, which has {},{},{},{}",
        window.x0, window.y0, window.x1, window.y1, which, has.x0, has.y0, has.x1, has.y1));
}

}  // namespace

void add_region_options(CLI::App& verb, RegionArguments& region) {
    verb.add_option("--window", region.window,
                    "compare these pixels alone: half-open, from the top-left of the frame")
        ->type_name("X0,Y0,X1,Y1");
    verb.add_flag("--overlap", region.overlap,
                  "compare what the data windows share: a crop with its whole frame");
}

std::optional<Window> keep_region(const RegionArguments& region, Film& reference, Film& test) {
    std::optional<Window> kept;
    if (region.overlap) {
        kept = intersection(reference.window, test.window);
        if (kept->width() < 1 || kept->height() < 1)
            throw UsageError("--overlap: the images share no pixel");
    }
    if (!region.window.empty()) {
        const Window window = parse_window("--window", region.window);
        require_inside(window, reference, "reference");
        require_inside(window, test, "test");
        kept = window;
    }
    if (!kept) return kept;
    crop(reference, *kept);
    crop(test, *kept);
    return kept;
}

}  // namespace quadrel::cli
