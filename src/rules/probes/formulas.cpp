#include "rules/probes/formulas.hpp"

#include <algorithm>
#include <cmath>

#include "quadrel/num/log.hpp"
#include "quadrel/texture/lod.hpp"
#include "rules/probes/inputs.hpp"

namespace quadrel::rules {
namespace {

using Numbers = std::array<float, 4>;
using Scale = double (*)(const Numbers&);

double length(double x, double y) { return std::sqrt(x * x + y * y); }
double longer(const Numbers& g) {
    return std::max(length(double(g[0]), double(g[1])), length(double(g[2]), double(g[3])));
}
double ellipse(const Numbers& g) {
    return ellipse_major_axis(vec2<double>(g[0], g[1]), vec2<double>(g[2], g[3]));
}
double greatest(const Numbers& g) {
    return double(std::max({std::fabs(g[0]), std::fabs(g[1]), std::fabs(g[2]), std::fabs(g[3])}));
}
double sum_of_axes(const Numbers& g) {
    return double(std::max(std::fabs(g[0]), std::fabs(g[2]))) +
           double(std::max(std::fabs(g[1]), std::fabs(g[3])));
}

constexpr std::pair<const char*, Scale> formulas[] = {{"longer gradient", longer},
                                                      {"ellipse", ellipse},
                                                      {"greatest component", greatest},
                                                      {"sum of axes", sum_of_axes}};

/// Least and greatest of the levels less the formula's.
std::pair<double, double> departure(Scale scale, const std::vector<Numbers>& asked,
                                    const Values& levels, std::size_t channel, double low,
                                    double high) {
    double least = 1e30, most = -1e30;
    for (std::size_t i = 0; i < asked.size(); ++i) {
        const double level = quadrel::log2(scale(asked[i]));
        if (!(level > low + 0.1 && level < high - 0.1)) continue;
        const double off = double(answer(levels, i, channel)) - level;
        least = std::min(least, off);
        most = std::max(most, off);
    }
    return {least, most};
}

/// "-0.043": no more digits than matter.
std::string short_number(double x) {
    return std::fabs(x) < 0.0005 ? "0" : fmt::format("{:+.3f}", x);
}

}  // namespace

std::string formula_words(const std::vector<Numbers>& asked, const Values& levels,
                          std::size_t channel, double low, double high) {
    std::string best;
    double width = 1e30;
    for (const auto& [name, scale] : formulas) {
        const auto [least, most] = departure(scale, asked, levels, channel, low, high);
        if (!(most - least < width - 1e-6)) continue;
        width = most - least;
        best = std::string(name);
        if (std::max(std::fabs(least), std::fabs(most)) >= 0.0005)
            best += fmt::format(", {} to {}", short_number(least), short_number(most));
    }
    return best.empty() ? "no number" : best;
}

bool within_permitted_levels(const std::vector<Numbers>& asked, const Values& levels,
                             std::size_t channel, double low, double high, double slack) {
    const auto above = departure(greatest, asked, levels, channel, low, high);
    const auto below = departure(sum_of_axes, asked, levels, channel, low, high);
    return above.first >= -slack && below.second <= slack;
}

}  // namespace quadrel::rules
