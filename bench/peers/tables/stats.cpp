// What counting adds to a render.
#include <fmt/format.h>

#include "measure.hpp"
#include "rows.hpp"
#include "tables/tables.hpp"

namespace quadrel::peers {
namespace {

using Counting = Picture::Counting;

std::vector<Cell> added(const Run& run, const Row& row) {
    Picture picture = colour_picture(run, 45, row.overrides);
    LeastTime plain, stats, touched;
    picture.draw(1);
    for (int i = 0; i < run.options.repeats; ++i) {
        plain.add(picture.render_counting(1, Counting::nothing));
        stats.add(picture.render_counting(1, Counting::stats));
        if (i == 0) touched.add(picture.render_counting(1, Counting::touched));
    }
    const double without = plain.of(1);
    const auto percent = [&](const LeastTime& with) { return 100 * (with.of(1) / without - 1); };
    return {row.name, {without, 1}, {percent(stats), 1}, {percent(touched), 0}};
}

}  // namespace

Table stats_table(Run& run) {
    Table table;
    table.title = fmt::format(
        "What statistics add to a render of {0}x{0} pixels at 45 degrees, maps loaded, no file "
        "written, one thread: least of {1} in turns, milliseconds of CPU time, per cent of it.",
        run.options.size, run.options.repeats);
    table.columns = {"work", "render", "--stats adds %", "--touched adds % (once)"};
    for (const Row& row : drawn_rows())
        if (chosen(run.options.rows, row.name)) table.rows.push_back(added(run, row));
    return table;
}

}  // namespace quadrel::peers
