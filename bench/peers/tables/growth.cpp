// Quadrel alone, as maps and frames grow. All at 45 degrees.
#include <fmt/format.h>

#include "maps.hpp"
#include "measure.hpp"
#include "rows.hpp"
#include "tables/tables.hpp"

namespace quadrel::peers {
namespace {

constexpr double angle = 45;

LeastTime least_of(int repeats, int threads, Picture& picture) {
    LeastTime least;
    for (int i = 0; i < repeats; ++i) least.add(picture.draw(threads));
    return least;
}

/// Sides from `first` on, doubled, up to `last`.
std::vector<int> sides(int first, int last) {
    std::vector<int> all;
    for (int side = first; side <= last; side *= 2) all.push_back(side);
    return all;
}

}  // namespace

Table map_table(Run& run) {
    Table table;
    table.title = fmt::format(
        "Drawing {0}x{0} pixels at 45 degrees with height maps of other sizes, one thread: least "
        "of {1}, milliseconds of CPU time, and relative to the first. Loading: file, mip level and "
        "what the search derives.",
        run.options.size, run.options.repeats);
    table.columns = {"texels",     "max-mip",  "relative", "loading",
                     "linear 256", "relative", "loading"};
    double first[2] = {0, 0};
    for (const int side : run.options.quick ? sides(64, 128) : sides(256, 8192)) {
        const TemporaryFolder folder;
        write_wall(folder.path(), run.options.map);
        write_wall(folder.path(), side, true);
        std::vector<Cell> cells{fmt::format("{0}x{0}", side)};
        int i = 0;
        for (const char* row : {"max-mip", "linear-256"}) {
            Picture picture =
                colour_picture(run, angle, row_of(row).overrides, folder.path(), run.options.size);
            const double time = least_of(run.options.repeats + 1, 1, picture).of(1);
            if (first[i] == 0) first[i] = time;
            cells.insert(cells.end(), {{time, 1}, {time / first[i++], 2}, {picture.load().cpu, 1}});
        }
        table.rows.push_back(cells);
    }
    return table;
}

Table frame_table(Run& run) {
    Table table;
    table.title = fmt::format(
        "Drawing frames of other sizes at 45 degrees, maps of {0}x{0} texels, one thread: least of "
        "{1}, nanoseconds of CPU time a pixel.",
        run.options.map, run.options.repeats);
    const char* const rows[] = {"plain", "offset-limit", "linear-256", "max-mip"};
    table.columns = {"pixels"};
    for (const char* row : rows) table.columns.emplace_back(row);
    for (const int side : run.options.quick ? sides(64, 128) : sides(256, 4096)) {
        std::vector<Cell> cells{fmt::format("{0}x{0}", side)};
        for (const char* row : rows) {
            Picture picture = colour_picture(run, angle, row_of(row).overrides, run.maps, side);
            const double time = least_of(run.options.repeats + 1, 1, picture).of(1);
            cells.emplace_back(1e6 * time / (double(side) * side), 1);
        }
        table.rows.push_back(cells);
    }
    return table;
}

}  // namespace quadrel::peers
