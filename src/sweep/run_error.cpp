#include "sweep/run_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "quadrel/error.hpp"

namespace quadrel::sweep {
namespace {

const ErrorPartSummary& part_named(const ErrorSummary& summary, const std::string& name) {
    const auto found = std::ranges::find(summary.parts, name, &ErrorPartSummary::name);
    if (found == summary.parts.end()) throw UsageError("a film without the errors of its " + name);
    return *found;
}

bool is_judged(ErrorKind kind) { return kind != ErrorKind::not_judged; }

/// The shares and the mean that no summary has.
void count_pixels(RunError& error, double tolerance) {
    double sum = 0, finite = 0, judged = 0;
    for (std::size_t i = 0; i < error.texels.size(); ++i) {
        if (!is_judged(error.kinds[i])) continue;
        const double texels = error.texels[i];
        judged += 1;
        if (!(texels <= tolerance))
            error.wrong_kinds[static_cast<std::size_t>(error.kinds[i])] += 1;
        if (!std::isfinite(texels)) continue;
        sum += texels;
        finite += 1;
    }
    if (judged == 0) return;
    error.mean_texels = finite > 0 ? sum / finite : std::numeric_limits<double>::quiet_NaN();
    for (double& share : error.wrong_kinds) error.wrong += share /= judged;
    error.nan = 1 - finite / judged;
}

}  // namespace

double RunError::texels_at(double percent) const {
    std::vector<float> finite;
    for (std::size_t i = 0; i < texels.size(); ++i)
        if (is_judged(kinds[i]) && std::isfinite(texels[i])) finite.push_back(texels[i]);
    if (finite.empty()) return std::numeric_limits<double>::quiet_NaN();
    const double rank = std::ceil(percent / 100 * static_cast<double>(finite.size()));
    const auto place = static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
    std::nth_element(finite.begin(), finite.begin() + place, finite.end());
    return finite[static_cast<std::size_t>(place)];
}

std::vector<std::string> run_error_channels() {
    std::vector<std::string> channels{"A", "err.certified"};
    for (const std::string part : {"err.", "err.search."})
        for (const char* measure : {"s", "uv", "cell", "kind"}) channels.push_back(part + measure);
    return channels;
}

RunError run_error(const Film& film, double tolerance) {
    constexpr std::size_t no_worst = 0;
    const ErrorSummary summary = summarize_errors(film, no_worst);
    RunError error;
    error.judged = summary.judged;
    error.certified = summary.certified;
    error.whole = part_named(summary, "whole");
    error.search = part_named(summary, "search");
    const Plane &texels = *film.find("err.search.uv"), &kinds = *film.find("err.search.kind"),
                &coverage = *film.find("A");
    for (std::size_t i = 0; i < texels.bits.size(); ++i) {
        error.texels.push_back(texels.as_float(i));
        error.kinds.push_back(coverage.as_float(i) > 0 ? static_cast<ErrorKind>(kinds.bits[i])
                                                       : ErrorKind::not_judged);
    }
    count_pixels(error, tolerance);
    return error;
}

const ErrorSpread& spread_of(const ErrorPartSummary& part, const std::string& measure) {
    for (const ErrorSpread& spread : part.spreads)
        if (spread.channel.ends_with("." + measure)) return spread;
    throw UsageError("no error of " + measure + " in the part " + part.name);
}

}  // namespace quadrel::sweep
