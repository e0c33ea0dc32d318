#include "tables/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "measure.hpp"

namespace quadrel::peers {
namespace {

struct Maker {
    const char* name;
    int processors;  ///< that the program is kept to meanwhile
    std::function<Table(Run&)> make;
};

const std::vector<Maker>& makers() {
    static const std::vector<Maker> all{
        {"one-core", 1, [](Run& run) { return drawn_table(run, 1); }},
        {"two-cores", 2, [](Run& run) { return drawn_table(run, 2); }},
        {"embree-one-core", 1, [](Run& run) { return traced_table(run, 1); }},
        {"embree-two-cores", 2, [](Run& run) { return traced_table(run, 2); }},
        {"file", 2, file_table},
        {"other-maps", 1, other_map_table},
        {"floors", 1, floor_table},
        {"file-floors", 1, file_floor_table},
        {"maps", 1, map_table},
        {"frames", 1, frame_table},
        {"threads", 2, thread_table},
        {"stats", 1, stats_table}};
    return all;
}

}  // namespace

void Run::judge(const std::string& what, double difference, double tolerance) {
    ++judged;
    if (difference <= tolerance) return;
    ++refused;
    disagreements.push_back(
        fmt::format("{} differ by {:.6f} on average, more than {}", what, difference, tolerance));
}

void Run::skip(const std::string& peer, const std::string& why) {
    const std::string line = peer + ": skipped: " + why;
    if (std::find(skipped.begin(), skipped.end(), line) == skipped.end()) skipped.push_back(line);
}

Picture colour_picture(const Run& run, double angle, const std::vector<std::string>& overrides) {
    return colour_picture(run, angle, overrides, run.maps, run.options.size);
}

Picture colour_picture(const Run& run, double angle, const std::vector<std::string>& overrides,
                       const std::filesystem::path& maps, int size) {
    return {wall_scene(maps, angle, size, overrides), run.options.isa, colour_channels};
}

std::vector<std::string> table_names() {
    std::vector<std::string> names;
    for (const Maker& maker : makers()) names.emplace_back(maker.name);
    return names;
}

Table make_table(const std::string& name, Run& run) {
    for (const Maker& maker : makers()) {
        if (maker.name != name) continue;
        keep_to(maker.processors);
        Table table = maker.make(run);
        table.name = name;
        return table;
    }
    return {};
}

}  // namespace quadrel::peers
