// quadrel-peers: Quadrel, llvmpipe and Embree on the same frames, in turns in one run.
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <stdlib.h>

#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>

#include "interruption.hpp"
#include "maps.hpp"
#include "measure.hpp"
#include "tables/tables.hpp"

namespace quadrel::peers {
namespace {

constexpr int could_not = 3, disagreement = 1;

std::string processor_name() {
    std::ifstream in("/proc/cpuinfo");
    for (std::string line; std::getline(in, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown processor";
}

std::string heading(const Options& options) {
    return fmt::format("{:%Y-%m-%d}, {}, {} processors; instruction set {}{}.\n",
                       fmt::gmtime(std::time(nullptr)), processor_name(), processors(), options.isa,
                       options.quick ? "; quick, no figures to quote" : "");
}

void write_json(const std::string& file, const std::vector<Table>& tables) {
    std::ofstream out(file);
    out << json(tables) << std::flush;
    if (!out) throw std::runtime_error(file + ": cannot be written");
}

int report(const Run& run) {
    if (run.options.planted)
        fmt::print("planted errors: {} {} noticed\n", run.refused == run.judged ? "all" : "not all",
                   run.judged);
    for (const std::string& line : run.skipped) fmt::print(stderr, "{}\n", line);
    for (const std::string& line : run.disagreements) fmt::print(stderr, "error: {}\n", line);
    return run.disagreements.empty() ? 0 : disagreement;
}

int run_tables(const Options& options, ProcessRunner& processes) {
    const TemporaryFolder folder;
    Run run{options, processes, folder.path()};
    write_wall(folder.path(), options.map);
    fmt::print("{}\n", heading(options));
    std::vector<Table> tables;
    for (const std::string& name : table_names()) {
        if (!chosen(options.tables, name)) continue;
        tables.push_back(make_table(name, run));
        fmt::print("{}\n", markdown(tables.back()));
        std::fflush(stdout);
    }
    if (!options.json.empty()) write_json(options.json, tables);
    return report(run);
}

}  // namespace
}  // namespace quadrel::peers

int main(int argc, char** argv) {
    using namespace quadrel::peers;
    int exit_code = -1;
    const Options options = read_options(argc, argv, exit_code);
    if (exit_code >= 0) return exit_code;
    processors();  // before any thread is kept to fewer
    // Derived maps are made in every run: what that takes is told.
    setenv("QUADREL_CACHE_MIB", "0", 1);
    try {
        ProcessRunner processes;  // first: it is to be small
        watch_for_interruption();
        return run_tables(options, processes);
    } catch (const std::exception& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return could_not;
    }
}
