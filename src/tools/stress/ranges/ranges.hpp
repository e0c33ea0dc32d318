// Over which range of coordinates, scales and angles floats stay within half a texel of doubles.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "stress/checks.hpp"

namespace quadrel::stress {

/// One quantity that is driven from ordinary to absurd, the rest of the scene being plain.
struct RangeAxis {
    std::string name;
    std::vector<double> values;  ///< ascending
    std::size_t tame;            ///< the index of the ordinary one
    void (*change)(StressScene& scene, double value);
};

const std::vector<RangeAxis>& range_axes();

/// How the rows of one room fare along the axes.
struct RangeTable {
    std::string room;  ///< "frame" or "trace"
    std::vector<std::string> rows;
    /// [row][axis][value]: texels that 99 % of the pixels do not exceed; negative where fewer than
    /// half of the fragments have a hit, and a certified one, by float and by double.
    std::vector<std::vector<std::vector<double>>> texels;

    /// The values of an axis, around the tame one, at which a row stays below half a texel:
    /// "to 1e5", "all", "none".
    std::string range(std::size_t row, std::size_t axis) const;
};

/// The scenes from which a table is made: frames over a flat relief, whose hits differ by what the
/// rays do; traces on frame-gram over a fractal, judged by how far the two searches err apart.
std::vector<StressScene> range_scenes(const std::string& room);

/// `results` by the scenes' names.
RangeTable range_table(const std::string& room, const std::map<std::string, SceneResult>& results);

/// In Markdown.
std::string to_text(const RangeTable& table);

/// Both as one picture: a panel for each axis and table, lines of rows, half a texel dashed.
std::string range_plot(const std::vector<RangeTable>& tables);

}  // namespace quadrel::stress
