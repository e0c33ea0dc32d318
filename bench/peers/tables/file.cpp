// From the command to the file.
#include <fmt/format.h>

#include "measure.hpp"
#include "tables/tables.hpp"

namespace quadrel::peers {
namespace {

struct Used {
    LeastTime time;
    double peak_mib = 0;
};

Used least_of(Run& run, int repeats, const std::vector<std::string>& command, int processors) {
    Used used;
    for (int i = 0; i < repeats; ++i) {
        const ProcessUse once = run.processes.run(command, processors);
        used.time.add(once.time);
        used.peak_mib = std::max(used.peak_mib, once.peak_mib);
    }
    return used;
}

std::vector<Cell> cells(const std::string& what, const std::string& compression, int threads,
                        const Used& used) {
    const Time& time = used.time.value();
    return {what,           compression,   threads == 0 ? "-" : std::to_string(threads),
            {time.wall, 1}, {time.cpu, 1}, {used.peak_mib, 1}};
}

}  // namespace

Table file_table(Run& run) {
    const Options& options = run.options;
    Table table;
    table.title = fmt::format(
        "`quadrel` as a process, from its start to the end, least of {}: milliseconds; memory: the "
        "greatest of all runs. Scenes as they are installed, {}x{} pixels.",
        options.repeats, options.size, options.size);
    table.columns = {"command", "--compression", "-t", "wall", "CPU", "peak MiB"};
    const std::string out = (run.maps / "out.exr").string();
    for (const char* scene : {"thesis-quad", "bricks-45"})
        for (const char* compression : {"zip", "none"})
            for (const int threads : {1, 2}) {
                const Used used = least_of(
                    run, options.repeats,
                    {options.program, "render", scene, "--size",
                     fmt::format("{0}x{0}", options.size), "--compression", compression, "-t",
                     std::to_string(threads), "--isa", options.isa, "--quiet", "-o", out},
                    threads);
                table.rows.push_back(
                    cells(fmt::format("render {}", scene), compression, threads, used));
            }
    table.rows.push_back(
        cells("--version", "-", 0,
              least_of(run, 10 * options.repeats, {options.program, "--version"}, 1)));
    return table;
}

}  // namespace quadrel::peers
