// Quadrel alone, one thread and two.
#include <fmt/format.h>

#include "measure.hpp"
#include "rows.hpp"
#include "tables/tables.hpp"

namespace quadrel::peers {
namespace {

constexpr double angle = 45;

/// One thread and two in turns, wall time.
std::vector<Cell> speed_up(const Run& run, const std::string& title, Picture& picture) {
    LeastTime one, two;
    picture.draw(2);
    for (int i = 0; i < run.options.repeats; ++i) {
        one.add(picture.draw(1));
        two.add(picture.draw(2));
    }
    const double a = one.value().wall, b = two.value().wall;
    return {title, {a, 1}, {b, 1}, {a / b, 2}, {1000 / b, 0}};
}

/// McGuire and McGuire's: 1024x768 pixels, four samples each.
Picture mcguire(const Run& run) {
    std::vector<std::string> overrides = row_of("steep-30").overrides;
    overrides.insert(overrides.end(), {"size=[1024,768]", "samples=4"});
    return colour_picture(run, angle, overrides);
}

}  // namespace

Table thread_table(Run& run) {
    Table table;
    table.title = fmt::format(
        "Drawing {0}x{0} pixels at 45 degrees on one thread and on two, in turns: least of {1}, "
        "milliseconds of wall time; frames a second on two.",
        run.options.size, run.options.repeats);
    table.columns = {"work", "one", "two", "one / two", "frames/s"};
    for (const Row& row : drawn_rows()) {
        if (!chosen(run.options.rows, row.name)) continue;
        Picture picture = colour_picture(run, angle, row.overrides);
        table.rows.push_back(speed_up(run, row.name, picture));
    }
    if (run.options.rows.empty()) {
        Picture picture = mcguire(run);
        table.rows.push_back(
            speed_up(run, "steep 30 with shadow, 1024x768, 4 samples per pixel", picture));
    }
    return table;
}

}  // namespace quadrel::peers
