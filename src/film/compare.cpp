#include "quadrel/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace quadrel {
namespace {

std::string window_text(const Window& window) {
    return fmt::format("{}x{} at {},{}", window.width(), window.height(), window.x0, window.y0);
}

const char* type_text(ChannelType type) { return type == ChannelType::float32 ? "float" : "uint"; }

/// Floats in the order of their values as consecutive integers, -0 and +0 as the same one.
std::int64_t ordered(std::uint32_t bits) {
    const auto magnitude = static_cast<std::int64_t>(bits & 0x7fffffffu);
    return (bits >> 31) != 0 ? -magnitude : magnitude;
}

enum class Kind { equal, finite, infinite, nan };

Kind classify(ChannelType type, std::uint32_t reference, std::uint32_t test) {
    if (reference == test) return Kind::equal;
    if (type == ChannelType::uint32) return Kind::finite;
    const float a = std::bit_cast<float>(reference);
    const float b = std::bit_cast<float>(test);
    if (std::isnan(a) && std::isnan(b)) return Kind::equal;
    if (std::isnan(a) || std::isnan(b)) return Kind::nan;
    return std::isinf(a) || std::isinf(b) ? Kind::infinite : Kind::finite;
}

double as_double(ChannelType type, std::uint32_t bits) {
    return type == ChannelType::uint32 ? double{static_cast<double>(bits)}
                                       : double{std::bit_cast<float>(bits)};
}

std::uint32_t ulps_apart(std::uint32_t reference, std::uint32_t test) {
    return static_cast<std::uint32_t>(std::abs(ordered(reference) - ordered(test)));
}

bool is_finite_value(ChannelType type, std::uint32_t bits) {
    return type == ChannelType::uint32 || (bits & 0x7f800000u) != 0x7f800000u;
}

/// Walks over one channel's pixels.
class ChannelComparison {
  public:
    ChannelComparison(const Film& film, const Plane& plane, const Tolerance& tolerance)
        : window_(film.window), tolerance_(tolerance) {
        report_.name = plane.name;
        report_.type = plane.type;
    }

    void add(std::size_t i, std::uint32_t reference, std::uint32_t test) {
        ++report_.pixels;
        const Kind kind = classify(report_.type, reference, test);
        double error = 0;
        if (kind == Kind::finite) error = add_finite(reference, test);
        if (is_finite_value(report_.type, reference) && is_finite_value(report_.type, test))
            ++finite_;
        if (kind == Kind::equal || (kind == Kind::finite && allowed(error, reference, test)))
            return;
        ++report_.differing;
        if (kind == Kind::nan) ++report_.nan_mismatches;
        if (kind == Kind::infinite) ++report_.infinite_mismatches;
        const bool incomparable = kind != Kind::finite;
        keep_worst(i, incomparable ? std::numeric_limits<double>::infinity() : error, reference,
                   test);
    }

    ChannelReport finish() {
        const double count = finite_ > 0 ? static_cast<double>(finite_) : 1.0;
        report_.mean_abs = sum_ / count;
        report_.rms = std::sqrt(sum_of_squares_ / count);
        return report_;
    }

  private:
    double add_finite(std::uint32_t reference, std::uint32_t test) {
        const double error =
            std::abs(as_double(report_.type, test) - as_double(report_.type, reference));
        sum_ += error;
        sum_of_squares_ += error * error;
        report_.max_abs = std::max(report_.max_abs, error);
        if (report_.type == ChannelType::float32)
            report_.max_ulp = std::max(report_.max_ulp, ulps_apart(reference, test));
        return error;
    }

    bool allowed(double error, std::uint32_t reference, std::uint32_t test) const {
        if (report_.type == ChannelType::uint32) return false;
        if (tolerance_.abs > 0 && error <= tolerance_.abs) return true;
        const double magnitude = std::abs(as_double(report_.type, reference));
        if (tolerance_.rel > 0 && error <= tolerance_.rel * magnitude) return true;
        return tolerance_.ulp > 0 && ulps_apart(reference, test) <= tolerance_.ulp;
    }

    void keep_worst(std::size_t i, double error, std::uint32_t reference, std::uint32_t test) {
        if (report_.worst_x >= 0 && !(error > worst_)) return;
        worst_ = error;
        const auto width = static_cast<std::size_t>(window_.width());
        report_.worst_x = window_.x0 + static_cast<int>(i % width);
        report_.worst_y = window_.y0 + static_cast<int>(i / width);
        report_.worst_reference = reference;
        report_.worst_test = test;
    }

    Window window_;
    Tolerance tolerance_;
    ChannelReport report_;
    std::uint64_t finite_ = 0;
    double sum_ = 0, sum_of_squares_ = 0, worst_ = -1;
};

void compare_structure(const Film& reference, const Film& test, CompareReport& report) {
    if (reference.frame != test.frame)
        report.structure.push_back("frame: reference " + window_text(reference.frame) + ", test " +
                                   window_text(test.frame));
    if (reference.window != test.window)
        report.structure.push_back("window: reference " + window_text(reference.window) +
                                   ", test " + window_text(test.window));
    for (const Plane& plane : reference.planes) {
        const Plane* other = test.find(plane.name);
        if (other == nullptr) {
            report.structure.push_back("channel " + plane.name + ": missing in the test image");
        } else if (other->type != plane.type) {
            report.structure.push_back(fmt::format("channel {}: reference {}, test {}", plane.name,
                                                   type_text(plane.type), type_text(other->type)));
        }
    }
    for (const Plane& plane : test.planes)
        if (reference.find(plane.name) == nullptr)
            report.structure.push_back("channel " + plane.name + ": missing in the reference");
}

}  // namespace

bool CompareReport::equal() const {
    return structure.empty() &&
           std::all_of(channels.begin(), channels.end(),
                       [](const ChannelReport& channel) { return channel.differing == 0; });
}

CompareReport compare(const Film& reference, const Film& test, const Tolerance& tolerance) {
    CompareReport report;
    compare_structure(reference, test, report);
    if (reference.window != test.window) return report;
    for (const Plane& plane : reference.planes) {
        const Plane* other = test.find(plane.name);
        if (other == nullptr || other->type != plane.type) continue;
        ChannelComparison comparison(reference, plane, tolerance);
        for (std::size_t i = 0; i < plane.bits.size(); ++i)
            comparison.add(i, plane.bits[i], other->bits[i]);
        report.channels.push_back(comparison.finish());
    }
    return report;
}

}  // namespace quadrel
