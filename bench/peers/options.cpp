#include "options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <bit>

#include "rows.hpp"
#include "tables/tables.hpp"

namespace quadrel::peers {
namespace {

std::string power_of_two(const std::string& text) {
    const unsigned value = static_cast<unsigned>(std::atoi(text.c_str()));
    return std::has_single_bit(value) ? "" : text + " is not a power of two";
}

std::string multiple_of_4(const std::string& text) {
    return std::atoi(text.c_str()) % 4 == 0 ? "" : text + " is not a multiple of 4";
}

/// Small enough for a test: every table and peer once, on small frames.
void make_quick(Options& options, const CLI::App& app) {
    if (app.count("--size") == 0) options.size = 64;
    if (app.count("--map") == 0) options.map = 128;
    if (app.count("--repeats") == 0) options.repeats = 1;
    if (app.count("--angles") == 0) options.angles = {60};
}

}  // namespace

Options read_options(int argc, char** argv, int& exit_code) {
    Options options;
    options.angles = {0, 45, 75, 85};
    options.program = QUADREL_PROGRAM;
    CLI::App app(
        "Draws the same frames with Quadrel and llvmpipe, traces them with Embree, in turns, "
        "and prints times and ratios.\n");
    app.add_option("--tables", options.tables, "some of: " + joined(table_names()))
        ->delimiter(',')
        ->check(CLI::IsMember(table_names()));
    app.add_option("--rows", options.rows, "some of: " + joined(row_names()))
        ->delimiter(',')
        ->check(CLI::IsMember(row_names()));
    app.add_option("--angles", options.angles, "between view and normal, degrees (0,45,75,85)")
        ->delimiter(',')
        ->check(CLI::Range(0.0, 85.0));
    app.add_option("--size", options.size, "side of the frame, pixels (1024)")
        ->check(CLI::Range(16, 8192) & CLI::Validator(multiple_of_4, "MULTIPLE OF 4"));
    app.add_option("--map", options.map, "side of the maps, texels (1024)")
        ->check(CLI::Range(16, 8192) & CLI::Validator(power_of_two, "POWER OF TWO"));
    app.add_option("--repeats", options.repeats, "frames of each, of which the least counts (7)")
        ->check(CLI::Range(1, 1000));
    app.add_option("--isa", options.isa, "Quadrel's instruction set (auto)")
        ->check(CLI::IsMember({"auto", "scalar", "sse4", "avx2", "avx512", "neon"}));
    app.add_option("--program", options.program, "the quadrel that is run as a process")
        ->check(CLI::ExistingFile);
    app.add_option("--json", options.json, "write the tables to this file, too");
    app.add_flag("--quick", options.quick, "small frames, once: whether all works, no figures");
    app.add_flag("--planted", options.planted,
                 "wrong shaders and geometry, which have to be noticed");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        exit_code = app.exit(error) == 0 ? 0 : 2;
        return options;
    }
    if (options.quick) make_quick(options, app);
    return options;
}

bool chosen(const std::vector<std::string>& names, const std::string& name) {
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace quadrel::peers
