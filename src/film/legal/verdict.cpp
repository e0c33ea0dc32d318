#include "film/legal/verdict.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "quadrel/film/presence.hpp"

namespace quadrel {
namespace {

/// Below this share of its vector's largest magnitude a channel counts as constant: what matters of
/// a component that is 0 everywhere is how far the whole vector may turn.
constexpr double least_extent = 0.1;

/// The magnitude that a vector which is 0 everywhere is taken to have. The tenth of a tenth of it,
/// which is not wide, is 2^-20: the roundings of what is 0 by cancelling terms of some units.
constexpr double magnitude_of_nothing = 100 * 0x1p-20;

bool is_component(const std::string& name) {
    return !name.empty() && std::all_of(name.begin(), name.end(), [](char letter) {
        return (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9');
    });
}

bool is_judged(const std::vector<bool>& left_out, std::size_t i) {
    return left_out.empty() || !left_out[i];
}

/// fn(value) of each finite one.
template <class Fn>
void each_finite(const Plane& plane, const std::vector<bool>& left_out, const Fn& fn) {
    for (std::size_t i = 0; i < plane.bits.size(); ++i) {
        const double value = value_of(plane, i);
        if (is_judged(left_out, i) && std::isfinite(value)) fn(value);
    }
}

/// Whether there is a gap: both of its ends are numbers within the range, in order.
bool has_gap(const LegalRange& range) {
    return range.gap_lo >= range.lo && range.gap_lo < range.gap_hi && range.gap_hi <= range.hi;
}

/// Of all that is permitted together.
double width_of(const LegalRange& range) {
    const bool open = std::isnan(range.lo) != std::isnan(range.hi);
    if (open) return std::numeric_limits<double>::infinity();
    if (std::isnan(range.lo) || range.lo == range.hi) return 0;
    const double gap = has_gap(range) ? double{range.gap_hi} - double{range.gap_lo} : 0;
    return double{range.hi} - double{range.lo} - gap;
}

bool holds(const LegalRange& range, double value) {
    const bool nan_lo = std::isnan(range.lo), nan_hi = std::isnan(range.hi);
    if (std::isnan(value)) return nan_lo || nan_hi;
    if (nan_lo && nan_hi) return false;
    if (has_gap(range) && value > range.gap_lo && value < range.gap_hi) return false;
    return !(value < range.lo) && !(value > range.hi);  // an end that is NaN is open
}

}  // namespace

double value_of(const Plane& plane, std::size_t i) {
    if (plane.type == ChannelType::uint32) return plane.bits[i];
    return std::bit_cast<float>(plane.bits[i]);
}

std::string vector_of(const std::string& channel) {
    if (channel == "R" || channel == "G" || channel == "B") return "R G B";
    const std::size_t dot = channel.rfind('.');
    if (dot == std::string::npos || !is_component(channel.substr(dot + 1))) return channel;
    return channel.substr(0, dot);
}

double extent_of(const Film& values, const Plane& plane, const std::vector<bool>& left_out) {
    double least = std::numeric_limits<double>::infinity(), most = -least, magnitude = 0;
    each_finite(plane, left_out, [&](double value) {
        least = std::min(least, value);
        most = std::max(most, value);
    });
    const std::string vector = vector_of(plane.name);
    for (const Plane& other : values.planes)
        if (vector_of(other.name) == vector)
            each_finite(other, left_out,
                        [&](double value) { magnitude = std::max(magnitude, std::abs(value)); });
    if (magnitude == 0) magnitude = magnitude_of_nothing;
    return std::max(most >= least ? most - least : 0, least_extent * magnitude);
}

std::vector<Covered> compare_coverage(const LegalReference& reference, const Film& test,
                                      const std::vector<std::size_t>& pixels) {
    std::vector<Covered> all(pixels.size(), Covered::alike);
    const Plane* const other = test.find("A");
    if (!reference.coverage || other == nullptr) return all;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        if (pixels[i] == no_pixel) continue;
        if ((value_of(*reference.coverage, i) > 0) == (value_of(*other, pixels[i]) > 0)) continue;
        const bool open =
            reference.undecided && (reference.undecided->bits[i] & undecided_presence) != 0;
        all[i] = !reference.undecided ? Covered::alone_unknown
                 : open               ? Covered::alone_undecided
                                      : Covered::alone_decided;
    }
    return all;
}

LegalRange range_at(const LegalReference& reference, std::size_t plane, std::size_t i) {
    return {std::bit_cast<float>(reference.lo.planes[plane].bits[i]),
            std::bit_cast<float>(reference.hi.planes[plane].bits[i]),
            reference.paths.planes[plane].bits[i],
            std::bit_cast<float>(reference.gap_lo.planes[plane].bits[i]),
            std::bit_cast<float>(reference.gap_hi.planes[plane].bits[i])};
}

double distance_from(const LegalRange& range, double value) {
    const double below = range.lo - value, above = value - range.hi;
    if (std::isnan(below) && std::isnan(above)) return std::numeric_limits<double>::infinity();
    const double in_gap = std::fmin(value - range.gap_lo, range.gap_hi - value);
    return std::fmax(std::fmax(std::fmax(below, above), in_gap), 0);
}

std::vector<std::size_t> pixels_in(const Film& test, const Window& window) {
    std::vector<std::size_t> pixels;
    pixels.reserve(window.area());
    for (int y = window.y0; y < window.y1; ++y)
        for (int x = window.x0; x < window.x1; ++x)
            pixels.push_back(contains(test.window, {x, y, x + 1, y + 1}) ? test.index(x, y)
                                                                         : no_pixel);
    return pixels;
}

const char* legal_verdict_name(LegalVerdict verdict) {
    switch (verdict) {
        case LegalVerdict::pass:
            return "pass";
        case LegalVerdict::ambiguous:
            return "ambiguous";
        case LegalVerdict::unconstrained:
            return "unconstrained";
        case LegalVerdict::fail:
            break;
    }
    return "fail";
}

LegalVerdict legal_verdict(const LegalRange& range, double value, double extent, double widest) {
    if (range.paths == 0) return LegalVerdict::unconstrained;
    if (!holds(range, value)) return LegalVerdict::fail;
    if (!(width_of(range) <= widest * extent)) return LegalVerdict::unconstrained;
    return range.paths > 1 ? LegalVerdict::ambiguous : LegalVerdict::pass;
}

}  // namespace quadrel
