#include "sweep/plan/plan_maps.hpp"

#include <fmt/format.h>

#include "file/read_file.hpp"
#include "sweep/plan/map_kinds.hpp"
#include "sweep/plan/plan_values.hpp"

namespace quadrel::sweep {
namespace {

void read_format(Fields& fields, PlannedMap& map) {
    const std::vector<std::string> formats{"unorm8", "unorm16", "half", "float"};
    const std::vector<std::string> wraps{"repeat", "mirrored-repeat", "clamp-to-edge",
                                         "clamp-to-border", "mirror-once"};
    if (fields.has("format")) map.format = word_in(fields.get("format"), formats);
    if (fields.has("wrap")) map.wrap = word_in(fields.get("wrap"), wraps);
}

std::string made_name(const MapKind& kind, const MapValues& values) {
    std::string name(kind.name);
    for (const MapParameter& parameter : kind.parameters) {
        const double value = values.at(std::string(parameter.name));
        if (value != parameter.standard)
            name += fmt::format(" {}={}", parameter.name, short_number(value));
    }
    return name;
}

std::vector<MapValues> map_values(Fields& fields, const MapKind& kind) {
    std::vector<std::pair<std::string, std::vector<double>>> lists;
    for (const MapParameter& parameter : kind.parameters) {
        const std::string name(parameter.name);
        lists.push_back({name, {}});
        if (!fields.has(name)) {
            lists.back().second.push_back(parameter.standard);
            continue;
        }
        for (const SceneValue& value : distinct_elements(fields.get(name)))
            lists.back().second.push_back(value.number({parameter.low, parameter.high}));
    }
    return products(fields.get("kind"), lists);
}

void read_made(Fields& fields, PlannedMap map, std::vector<PlannedMap>& maps) {
    std::vector<std::string> known;
    for (const MapKind& kind : map_kinds()) known.emplace_back(kind.name);
    map.source = PlannedMap::Source::made;
    map.kind = word_in(fields.get("kind"), known);
    const MapKind& kind = *find_map_kind(map.kind);
    if (map.format.empty()) map.format = kind.format;
    std::vector<int> sizes;
    if (fields.has("size"))
        for (const SceneValue& value : distinct_elements(fields.get("size")))
            sizes.push_back(value.integer(least_map_side, largest_map_side));
    else
        sizes.push_back(256);
    const std::string given = map.name;
    for (const MapValues& values : map_values(fields, kind))
        for (const int size : sizes) {
            map.parameters = values;
            map.size = size;
            map.name = given.empty() ? made_name(kind, values) : given;
            maps.push_back(map);
        }
}

}  // namespace

void read_map(const SceneValue& value, std::vector<PlannedMap>& maps) {
    PlannedMap map;
    if (value.json().is_string()) {
        map.name = word_in(value, {"scene"});
        maps.push_back(map);
        return;
    }
    Fields fields(value);
    fields.read("name", map.name);
    read_format(fields, map);
    if (fields.has("kind")) {
        read_made(fields, map, maps);
        return fields.finish("a map of kind \"" + maps.back().kind + "\"");
    }
    if (!fields.has("file")) value.fail("neither \"kind\" nor \"file\"", "one of them");
    const SceneValue file = fields.get("file");
    map.source = PlannedMap::Source::file;
    map.file = std::filesystem::absolute(value.document().file.parent_path() /
                                         std::filesystem::path(file.string()));
    if (const char* reason = reason_not_to_read(map.file))
        file.fail(reason + (" (" + map.file.string() + ")"), "a height map");
    if (map.name.empty()) map.name = map.file.stem().string();
    maps.push_back(map);
    fields.finish("a map of a file");
}

}  // namespace quadrel::sweep
