#include "sweep/report/plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "quadrel/num/math.hpp"
#include "sweep/report/chart.hpp"

namespace quadrel::sweep {
namespace {

/// Below this an error is drawn as this: exact hits have none, and a logarithm ends nowhere.
constexpr double least_error = 1e-3;

/// So many dots all have names; of more those of the front.
constexpr std::size_t few_dots = 16;

double time_of(const Json& record) {
    return 1e6 * record["trace_ms"].get<double>() /
           std::max(1.0, record["fragments"].get<double>());
}

double error_of(const Json& record) {
    return std::max(least_error, record["texels_p99"].get<double>());
}

bool is_measured(const Json& record) {
    return !record.contains("failed") && record.contains("trace_ms") &&
           record["trace_ms"].get<double>() > 0 && record.contains("texels_p99") &&
           record["texels_p99"].is_number();
}

/// Geometric means over runs.
class MeanPoint {
  public:
    void add(const Json& record) {
        time_ += log2(time_of(record));
        error_ += log2(error_of(record));
        ++count_;
        family_ = record["family"].get<std::string>();
    }
    double time() const { return exp2(time_ / count_); }
    double error() const { return exp2(error_ / count_); }
    const std::string& family() const { return family_; }

  private:
    double time_ = 0, error_ = 0, count_ = 0;
    std::string family_;
};

using Group = std::vector<const Json*>;

/// What may share an axis.
std::map<std::string, Group> comparable_groups(const std::vector<Json>& records) {
    std::map<std::string, Group> groups;
    for (const Json& record : records)
        if (is_measured(record))
            groups[fmt::format(
                       "{}, {}, {}, {} thread(s), build {}", record["machine"].get<std::string>(),
                       record["isa"].get<std::string>(), record["number"].get<std::string>(),
                       record["threads"].dump(), record["build"].get<std::string>().substr(0, 18))]
                .push_back(&record);
    return groups;
}

std::map<std::string, MeanPoint> means_by_algorithm(const Group& group, const std::string& view) {
    std::map<std::string, MeanPoint> means;
    for (const Json* record : group)
        if ((*record)["view"] == view)
            means[(*record)["algorithm"].get<std::string>()].add(*record);
    return means;
}

/// Those that nothing beats in both: names by time.
std::vector<std::string> front_of(const std::map<std::string, MeanPoint>& means) {
    std::vector<std::string> names, front;
    for (const auto& [name, mean] : means) names.push_back(name);
    std::stable_sort(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
        return means.at(a).time() < means.at(b).time();
    });
    double best = std::numeric_limits<double>::infinity();
    for (const std::string& name : names)
        if (means.at(name).error() < best) {
            best = means.at(name).error();
            front.push_back(name);
        }
    return front;
}

std::string front_chart(const Group& group, const std::string& view, const std::string& machine) {
    const auto means = means_by_algorithm(group, view);
    const std::vector<std::string> front = front_of(means);
    Chart chart{view == "camera" ? "Run time against error, the scenes' own cameras"
                                 : "Run time against error at " + view + " degrees",
                machine,
                {"search, ns per pixel (mean over maps)", true, 0},
                {"texels from the true hit, 99 % of the pixels", true, least_error},
                {}};
    ChartSeries line{"front", "", {}, false, true, false};
    for (const std::string& name : front)
        line.points.push_back({means.at(name).time(), means.at(name).error(), "", ""});
    chart.series.push_back(line);
    std::map<std::string, ChartSeries> families;
    for (const auto& [name, mean] : means) {
        const bool labelled =
            means.size() <= few_dots || std::find(front.begin(), front.end(), name) != front.end();
        ChartSeries& series = families[mean.family()];
        series.family = mean.family();
        series.points.push_back(
            {mean.time(), mean.error(), labelled ? name : "",
             fmt::format("{}: {:.3g} ns, {:.3g} texels", name, mean.time(), mean.error())});
    }
    for (auto& [name, series] : families) chart.series.push_back(std::move(series));
    return to_svg(chart);
}

/// Angles of the group, ascending.
std::vector<double> angles_of(const Group& group) {
    std::vector<double> angles;
    for (const Json* record : group)
        if ((*record)["angle"].is_number()) angles.push_back((*record)["angle"].get<double>());
    std::sort(angles.begin(), angles.end());
    angles.erase(std::unique(angles.begin(), angles.end()), angles.end());
    return angles;
}

/// Lines of those that are on the front at some angle.
std::string angle_chart(const Group& group, const std::vector<double>& angles, bool error,
                        const std::string& machine) {
    std::map<double, std::map<std::string, MeanPoint>> means;
    std::map<std::string, ChartSeries> lines;
    for (const double angle : angles) {
        means[angle] = means_by_algorithm(group, fmt::format("{:g}", angle));
        for (const std::string& name : front_of(means[angle])) lines[name].name = name;
    }
    for (auto& [name, line] : lines)
        for (const double angle : angles) {
            const auto found = means[angle].find(name);
            if (found == means[angle].end()) continue;
            const MeanPoint& mean = found->second;
            line.line = true;
            line.family = mean.family();
            line.points.push_back({angle, error ? mean.error() : mean.time(), "",
                                   name + fmt::format(" at {:g} degrees", angle)});
        }
    Chart chart{error ? "Error against the view's angle" : "Run time against the view's angle",
                machine,
                {"degrees between view and normal", false, 0},
                {error ? "texels from the true hit, 99 % of the pixels" : "search, ns per pixel",
                 true, error ? least_error : 0},
                {}};
    for (auto& [name, line] : lines) {
        if (!line.points.empty()) line.points.back().label = name;
        chart.series.push_back(std::move(line));
    }
    return to_svg(chart);
}

}  // namespace

std::vector<Plot> make_plots(const std::vector<Json>& records) {
    std::vector<Plot> plots;
    int number = 0;
    for (const auto& [machine, group] : comparable_groups(records)) {
        const std::string end = fmt::format("-{}.svg", ++number);
        const std::vector<double> angles = angles_of(group);
        std::vector<std::string> views;
        for (const double angle : angles) views.push_back(fmt::format("{:g}", angle));
        if (std::any_of(group.begin(), group.end(),
                        [](const Json* record) { return (*record)["view"] == "camera"; }))
            views.emplace_back("camera");
        for (const std::string& view : views)
            plots.push_back({"front-" + view + end, front_chart(group, view, machine)});
        if (angles.size() < 2) continue;
        plots.push_back({"error-by-angle" + end, angle_chart(group, angles, true, machine)});
        plots.push_back({"time-by-angle" + end, angle_chart(group, angles, false, machine)});
    }
    return plots;
}

}  // namespace quadrel::sweep
