// A chart as SVG, light or dark as the reader's system is.
#pragma once

#include <string>
#include <vector>

namespace quadrel::sweep {

struct ChartPoint {
    double x = 0, y = 0;
    std::string label;  ///< beside the point; empty: none
    std::string about;  ///< shown where the pointer rests
};

struct ChartSeries {
    std::string name, family;  ///< the family has the colour
    std::vector<ChartPoint> points;
    bool line = false;      ///< joined
    bool stairs = false;    ///< joined by level and upright pieces, as a front is
    bool has_marks = true;  ///< a dot for each point
};

struct Axis {
    std::string title;
    bool log = true;
    double least = 0;  ///< what is drawn in place of anything less
};

struct Chart {
    std::string title, note;
    Axis x, y;
    std::vector<ChartSeries> series;
};

/// 860 x 520, higher where names have no room beside their points; points that no logarithm takes
/// are left out.
std::string to_svg(const Chart& chart);

}  // namespace quadrel::sweep
