// Films of err.* channels, summed up.
#include <algorithm>
#include <cmath>
#include <limits>

#include "quadrel/error.hpp"
#include "quadrel/errors.hpp"
#include "quadrel/film/channels.hpp"

namespace quadrel {
namespace {

/// What of a part has a spread.
struct Measured {
    const char* name;
    const char* unit;
};
constexpr Measured measured[] = {{"s", "of the depth"}, {"uv", "texels"},
                                 {"normal", "degrees"}, {"shadow", "visibility"},
                                 {"color", "linear"},   {"K", "relative"}};

constexpr const char* part_names[] = {"whole", "search", "frame"};

std::string prefix_of(const std::string& part) {
    return part == "whole" ? "err." : "err." + part + ".";
}

/// A channel's magnitude at a pixel: of a colour the largest of the three.
class Magnitude {
  public:
    Magnitude(const Film& film, const std::string& name) {
        for (const char* suffix : {"", ".R", ".G", ".B"})
            if (const Plane* plane = film.find(name + suffix)) planes_.push_back(plane);
    }

    bool exists() const { return !planes_.empty(); }
    double operator()(std::size_t pixel) const {
        double most = 0;
        for (const Plane* plane : planes_) {
            const double x = std::fabs(static_cast<double>(plane->as_float(pixel)));
            if (!(x <= most)) most = x;  // NaN, too
            if (most != most) break;
        }
        return most;
    }

  private:
    std::vector<const Plane*> planes_;
};

std::vector<std::size_t> covered_pixels(const Film& film) {
    std::vector<std::size_t> covered;
    const Plane* coverage = film.find("A");
    if (coverage == nullptr || film.find("err.kind") == nullptr)
        throw UsageError("a film without A and err.kind has no errors to be summed up");
    for (std::size_t i = 0; i < coverage->bits.size(); ++i)
        if (coverage->as_float(i) > 0) covered.push_back(i);
    return covered;
}

/// The value that a share of them do not exceed. Orders the values.
double percentile(std::vector<float>& values, double share) {
    const double rank = std::ceil(share * static_cast<double>(values.size()));
    const auto index = static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
    std::nth_element(values.begin(), values.begin() + index, values.end());
    return values[static_cast<std::size_t>(index)];
}

ErrorSpread spread_of(const Magnitude& magnitude, const std::vector<std::size_t>& pixels) {
    ErrorSpread spread;
    std::vector<float> values;
    values.reserve(pixels.size());
    for (const std::size_t pixel : pixels) {
        const double x = magnitude(pixel);
        if (std::isfinite(x)) values.push_back(static_cast<float>(x));
    }
    spread.values = values.size();
    spread.not_finite = pixels.size() - values.size();
    if (values.empty()) {
        spread.p50 = spread.p90 = spread.p99 = spread.p999 = spread.most =
            std::numeric_limits<double>::quiet_NaN();
        return spread;
    }
    spread.p50 = percentile(values, 0.5);
    spread.p90 = percentile(values, 0.9);
    spread.p99 = percentile(values, 0.99);
    spread.p999 = percentile(values, 0.999);
    spread.most = percentile(values, 1);
    return spread;
}

ErrorPartSummary part_of(const Film& film, const std::string& name,
                         const std::vector<std::size_t>& judged,
                         const std::vector<std::size_t>& covered) {
    ErrorPartSummary part;
    part.name = name;
    const std::string prefix = prefix_of(name);
    const Plane *kind = film.find(prefix + "kind"), *cell = film.find(prefix + "cell");
    for (const std::size_t pixel : covered) {
        if (kind != nullptr && kind->bits[pixel] < error_kinds) ++part.kinds[kind->bits[pixel]];
        if (cell != nullptr) part.other_cell = part.other_cell.value_or(0) + cell->bits[pixel];
    }
    for (const Measured& row : measured) {
        const Magnitude magnitude(film, prefix + row.name);
        if (!magnitude.exists()) continue;
        ErrorSpread spread = spread_of(magnitude, judged);
        spread.channel = prefix + row.name;
        spread.unit = row.unit;
        part.spreads.push_back(spread);
    }
    return part;
}

/// Pixels with a truth: their hit is judged, or something else is.
std::vector<std::size_t> judged_pixels(const Film& film, const std::vector<std::size_t>& covered) {
    std::vector<Magnitude> magnitudes;
    for (const Measured& row : measured)
        if (const Magnitude magnitude(film, std::string("err.") + row.name); magnitude.exists())
            magnitudes.push_back(magnitude);
    const Plane& kind = *film.find("err.kind");
    std::vector<std::size_t> judged;
    std::ranges::copy_if(covered, std::back_inserter(judged), [&](std::size_t pixel) {
        return kind.bits[pixel] != static_cast<std::uint32_t>(ErrorKind::not_judged) ||
               std::ranges::any_of(magnitudes, [&](const Magnitude& magnitude) {
                   return std::isfinite(magnitude(pixel));
               });
    });
    return judged;
}

/// The worst pixels of a channel that are not all in one place.
void append_worst(const Film& film, const std::string& channel,
                  const std::vector<std::size_t>& judged, std::size_t count,
                  std::vector<WorstPixel>& worst) {
    constexpr int apart = 8;
    constexpr std::size_t most_looked_at = 10000;
    const Magnitude magnitude(film, channel);
    if (!magnitude.exists()) return;
    std::vector<std::pair<double, std::size_t>> values;
    for (const std::size_t pixel : judged)
        if (const double x = magnitude(pixel); x > 0) values.emplace_back(-x, pixel);
    const auto looked_at = std::min(values.size(), most_looked_at);
    std::partial_sort(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(looked_at),
                      values.end());
    const std::size_t before = worst.size();
    for (std::size_t i = 0; i < looked_at && worst.size() < before + count; ++i) {
        const std::size_t pixel = values[i].second;
        const auto width = static_cast<std::size_t>(film.window.width());
        const int x = film.window.x0 + static_cast<int>(pixel % width),
                  y = film.window.y0 + static_cast<int>(pixel / width);
        const auto is_near = [&](const WorstPixel& other) {
            return std::max(std::abs(other.x - x), std::abs(other.y - y)) < apart;
        };
        if (std::any_of(worst.begin() + static_cast<std::ptrdiff_t>(before), worst.end(), is_near))
            continue;
        const auto kind = static_cast<ErrorKind>(film.find("err.kind")->bits[pixel]);
        worst.push_back({x, y, channel, -values[i].first, kind, ""});
    }
}

}  // namespace

const char* error_kind_name(ErrorKind kind) {
    constexpr const char* names[] = {"same",   "late",          "early",     "invented",
                                     "missed", "other surface", "not judged"};
    return names[static_cast<std::size_t>(kind)];
}

double ErrorPartSummary::share(ErrorKind kind) const {
    std::uint64_t judged = 0;
    for (std::size_t k = 0; k < kinds.size(); ++k)
        if (k != static_cast<std::size_t>(ErrorKind::not_judged)) judged += kinds[k];
    if (judged == 0 || kind == ErrorKind::not_judged) return 0;
    return static_cast<double>(kinds[static_cast<std::size_t>(kind)]) / static_cast<double>(judged);
}

std::vector<std::string> error_channels() {
    const std::string requests[] = {"A", "err"};
    return expand_channels(requests);
}

ErrorSummary summarize_errors(const Film& film, std::size_t worst) {
    ErrorSummary summary;
    const std::vector<std::size_t> covered = covered_pixels(film);
    const std::vector<std::size_t> judged = judged_pixels(film, covered);
    summary.pixels = film.window.area();
    summary.covered = covered.size();
    summary.judged = judged.size();
    if (const Plane* certified = film.find("err.certified"))
        for (const std::size_t pixel : judged) summary.certified += certified->bits[pixel] != 0;
    for (const char* name : part_names)
        if (film.find(prefix_of(name) + "kind") != nullptr)
            summary.parts.push_back(part_of(film, name, judged, covered));
    for (const char* channel : {"err.uv", "err.normal", "err.color"})
        append_worst(film, channel, judged, worst, summary.worst);
    return summary;
}

}  // namespace quadrel
