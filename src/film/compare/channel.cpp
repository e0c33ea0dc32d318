#include "film/compare/channel.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "quadrel/num/math.hpp"

namespace quadrel {
namespace {

/// In the order of how bad they are.
enum class Kind { equal, finite, infinite, nan };

Kind classify(ChannelType type, std::uint32_t reference, std::uint32_t test) {
    if (reference == test) return Kind::equal;
    if (type == ChannelType::uint32) return Kind::finite;
    const float a = std::bit_cast<float>(reference), b = std::bit_cast<float>(test);
    if (std::isnan(a) && std::isnan(b)) return Kind::equal;
    if (std::isnan(a) || std::isnan(b)) return Kind::nan;
    return std::isinf(a) || std::isinf(b) ? Kind::infinite : Kind::finite;
}

double as_double(ChannelType type, std::uint32_t bits) {
    return type == ChannelType::uint32 ? double{static_cast<double>(bits)}
                                       : double{std::bit_cast<float>(bits)};
}

bool is_finite_value(ChannelType type, std::uint32_t bits) {
    return type == ChannelType::uint32 || (bits & 0x7f800000u) != 0x7f800000u;
}

double error_of(ChannelType type, std::uint32_t reference, std::uint32_t test) {
    return std::abs(as_double(type, test) - as_double(type, reference));
}

std::uint32_t ulps_apart(Encoding encoding, std::uint32_t reference, std::uint32_t test) {
    return ulp_distance(encoding, std::bit_cast<float>(reference), std::bit_cast<float>(test));
}

double psnr_of(double rms) {
    if (!(rms > 0)) return std::numeric_limits<double>::infinity();
    return -20 * (log2(rms) / log2(10.0));
}

struct Worst {
    Kind kind;
    double error;
    PixelDifference pixel;
};

bool worse(const Worst& a, const Worst& b) {
    return a.kind != b.kind ? a.kind > b.kind : a.error > b.error;
}

/// Walks over one channel's pixels, in order.
class ChannelComparison {
  public:
    ChannelComparison(const Window& window, const Plane& plane, const CompareRules& rules)
        : window_(window) {
        report_.name = plane.name;
        report_.type = plane.type;
        report_.tolerance = rules.tolerance_of(plane.name, plane.type);
        report_.encoding = rules.encoding_of(plane.name);
    }

    void add(std::size_t i, std::uint32_t reference, std::uint32_t test) {
        const ChannelType type = report_.type;
        ++report_.pixels;
        if (is_finite_value(type, reference) && is_finite_value(type, test)) ++finite_;
        const Kind kind = classify(type, reference, test);
        if (kind == Kind::equal) return;
        ++report_.unequal;
        if (kind != Kind::finite) ++not_finite_;
        const double error = kind == Kind::finite ? add_finite(reference, test) : 0;
        if (!exceeds(type, report_.encoding, report_.tolerance, reference, test)) return;
        ++report_.differing;
        if (kind == Kind::nan) ++report_.nan_mismatches;
        if (kind == Kind::infinite) ++report_.infinite_mismatches;
        keep_worst(i, kind, error, reference, test);
    }

    ChannelReport finish() {
        const double count = finite_ > 0 ? static_cast<double>(finite_) : 1.0;
        report_.mean_abs = sum_ / count;
        report_.rms = std::sqrt(sum_of_squares_ / count);
        const bool is_unknown = not_finite_ > 0 && !(report_.rms > 0);
        report_.psnr = is_unknown ? std::numeric_limits<double>::quiet_NaN() : psnr_of(report_.rms);
        for (const Worst& worst : worst_) report_.worst.push_back(worst.pixel);
        return report_;
    }

  private:
    double add_finite(std::uint32_t reference, std::uint32_t test) {
        const double error = error_of(report_.type, reference, test);
        sum_ += error;
        sum_of_squares_ += error * error;
        report_.max_abs = std::max(report_.max_abs, error);
        if (report_.type == ChannelType::float32)
            report_.max_ulp =
                std::max(report_.max_ulp, ulps_apart(report_.encoding, reference, test));
        return error;
    }

    void keep_worst(std::size_t i, Kind kind, double error, std::uint32_t reference,
                    std::uint32_t test) {
        const auto width = static_cast<std::size_t>(window_.width());
        const Worst one{kind,
                        error,
                        {window_.x0 + static_cast<int>(i % width),
                         window_.y0 + static_cast<int>(i / width), reference, test}};
        if (worst_.size() == most_worst_pixels && !worse(one, worst_.back())) return;
        worst_.insert(std::upper_bound(worst_.begin(), worst_.end(), one, worse), one);
        if (worst_.size() > most_worst_pixels) worst_.pop_back();
    }

    Window window_;
    ChannelReport report_;
    std::vector<Worst> worst_;
    std::uint64_t finite_ = 0, not_finite_ = 0;  ///< the latter: on one side, or otherwise
    double sum_ = 0, sum_of_squares_ = 0;
};

}  // namespace

bool exceeds(ChannelType type, Encoding encoding, const Tolerance& tolerance,
             std::uint32_t reference, std::uint32_t test) {
    const Kind kind = classify(type, reference, test);
    if (kind != Kind::finite) return kind != Kind::equal;
    const double error = error_of(type, reference, test);
    if (tolerance.abs > 0 && error <= tolerance.abs) return false;
    if (type == ChannelType::uint32) return true;
    const double magnitude = std::abs(as_double(type, reference));
    if (tolerance.rel > 0 && error <= tolerance.rel * magnitude) return false;
    return !(tolerance.ulp > 0 && ulps_apart(encoding, reference, test) <= tolerance.ulp);
}

ChannelReport compare_channel(const Window& window, const Plane& reference, const Plane& test,
                              const CompareRules& rules) {
    ChannelComparison comparison(window, reference, rules);
    for (std::size_t i = 0; i < reference.bits.size(); ++i)
        if (rules.left_out.empty() || !rules.left_out[i])
            comparison.add(i, reference.bits[i], test.bits[i]);
    return comparison.finish();
}

}  // namespace quadrel
