#include "stress/ranges/ranges.hpp"

#include <fmt/format.h>

#include "quadrel/num/math.hpp"
#include "stress/departure.hpp"

namespace quadrel::stress {
namespace {

/// In parallel projection, so close that the square fills the picture's height.
void tilt(StressScene& scene, double degrees) {
    scene.document["objects"][0]["transform"][0]["rotate"] = -degrees;
    scene.document["camera"] = {{"type", "orthographic"},
                                {"height", 2 * quadrel::cos(degrees * 0.017453292519943295)},
                                {"eye", {0, 0, 3}},
                                {"target", {0, 0, 0}}};
    relief_of(scene)["depth"] = 0.02;
}

void set_tiles(StressScene& scene, double tiles) {
    material_of(scene)["texture_matrix"]["scale"] = {tiles, tiles};
}

void set_offset(StressScene& scene, double tiles) {
    material_of(scene)["texture_matrix"]["offset"] = {tiles, tiles};
}

void set_depth(StressScene& scene, double depth) { relief_of(scene)["depth"] = depth; }

std::string scene_name(const std::string& room, const std::string& row, const RangeAxis& axis,
                       double value) {
    return fmt::format("ranges/{}/{}/{}/{}", room, row, axis.name, value);
}

StressScene range_scene(const std::string& room, const std::string& row, const RangeAxis& axis,
                        double value) {
    const bool frame = room == "frame";
    const MapName map{frame ? "half" : "fractal", 64, 64};
    StressScene scene =
        plain_scene(scene_name(room, row, axis, value), map, 45, frame ? "linear" : row);
    if (frame) relief_of(scene)["frame"] = row;
    relief_of(scene)["shadow"] = "none";
    axis.change(scene, value);
    scene.measured_only = true;
    return scene;
}

std::vector<std::string> rows_of(const std::string& room) {
    std::vector<std::string> rows = stage_ids(room, false);
    std::erase_if(rows,
                  [](const std::string& id) { return id == "none" || id.ends_with("-none"); });
    return rows;
}

double texels_of(const SceneResult& result, const std::string& room) {
    constexpr double lost = -1;
    if (result.departures.empty()) return lost;
    const Departure& departure = result.departures.front();
    if (departure.pixels == 0 || 2 * departure.pixels < result.fragments) return lost;
    return room == "frame" ? departure.rays_99 : departure.searches_99;
}

bool is_near(double texels) { return texels >= 0 && texels < half_texel; }

}  // namespace

const std::vector<RangeAxis>& range_axes() {
    static const std::vector<RangeAxis> axes = {
        {"angle, degrees", {0, 45, 70, 80, 85, 88, 89, 89.5, 89.9, 89.99}, 1, tilt},
        {"offset of uv, tiles", {0, 1, 10, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9}, 0, set_offset},
        {"tiles across the frame",
         {1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.1, 1, 10, 64, 1e2, 1e3, 1e4, 1e5, 1e6},
         6,
         set_tiles},
        {"depth, tiles", {1e-6, 1e-4, 1e-3, 0.01, 0.1, 1, 10, 1e2, 1e3, 1e4, 1e6}, 4, set_depth},
        {"scale of all",
         {1e-20, 1e-17, 1e-14, 1e-11, 1e-8, 1e-5, 1e-2, 1, 1e2, 1e5, 1e8, 1e11, 1e14, 1e17, 1e20},
         7,
         scale_scene},
        {"distance from the origin",
         {0, 10, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9},
         0,
         move_scene}};
    return axes;
}

std::vector<StressScene> range_scenes(const std::string& room) {
    std::vector<StressScene> scenes;
    for (const std::string& row : rows_of(room))
        for (const RangeAxis& axis : range_axes())
            for (const double value : axis.values)
                scenes.push_back(range_scene(room, row, axis, value));
    return scenes;
}

RangeTable range_table(const std::string& room, const std::map<std::string, SceneResult>& results) {
    RangeTable table{room, rows_of(room), {}};
    for (const std::string& row : table.rows) {
        auto& of_row = table.texels.emplace_back();
        for (const RangeAxis& axis : range_axes()) {
            auto& of_axis = of_row.emplace_back();
            for (const double value : axis.values)
                of_axis.push_back(texels_of(results.at(scene_name(room, row, axis, value)), room));
        }
    }
    return table;
}

std::string RangeTable::range(std::size_t row, std::size_t axis) const {
    const RangeAxis& along = range_axes()[axis];
    const std::vector<double>& values = texels[row][axis];
    if (!is_near(values[along.tame]))
        return values[along.tame] < 0 ? "no hits"
                                      : fmt::format("none ({:.2g})", values[along.tame]);
    std::size_t low = along.tame, high = along.tame;
    while (low > 0 && is_near(values[low - 1])) --low;
    while (high + 1 < values.size() && is_near(values[high + 1])) ++high;
    const bool from_start = low == 0, to_end = high + 1 == values.size();
    if (from_start && to_end) return "all";
    if (from_start) return fmt::format("to {:g}", along.values[high]);
    if (to_end) return fmt::format("from {:g}", along.values[low]);
    return fmt::format("{:g} to {:g}", along.values[low], along.values[high]);
}

std::string to_text(const RangeTable& table) {
    std::string text = "| " + table.room, line = "|---";
    for (const RangeAxis& axis : range_axes()) {
        text += " | " + axis.name;
        line += "|---";
    }
    text += " |\n" + line + "|\n";
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        text += "| `" + table.rows[row] + "`";
        for (std::size_t axis = 0; axis < range_axes().size(); ++axis)
            text += " | " + table.range(row, axis);
        text += " |\n";
    }
    return text;
}

}  // namespace quadrel::stress
