#include "quadrel/compare.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "film/compare/channel.hpp"

namespace quadrel {
namespace {

std::string window_text(const Window& window) {
    return fmt::format("{}x{} at {},{}", window.width(), window.height(), window.x0, window.y0);
}

const char* type_text(ChannelType type) { return type == ChannelType::float32 ? "float" : "uint"; }

void compare_windows(const char* what, const Window& reference, const Window& test,
                     CompareReport& report) {
    if (reference != test)
        report.structure.push_back(fmt::format("{}: reference {}, test {}", what,
                                               window_text(reference), window_text(test)));
}

void compare_structure(const Film& reference, const Film& test, CompareReport& report) {
    compare_windows("frame", reference.frame, test.frame, report);
    compare_windows("window", reference.window, test.window, report);
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

Tolerance CompareRules::tolerance_of(const std::string& channel, ChannelType type) const {
    const auto own = channels.find(channel);
    const Tolerance found = own != channels.end() ? own->second : all;
    if (type == ChannelType::float32) return found;
    return {own != channels.end() ? found.abs : 0, 0, 0, found.fraction};
}

Encoding CompareRules::encoding_of(const std::string& channel) const {
    const auto own = encodings.find(channel);
    return own != encodings.end() ? own->second : Encoding::none;
}

bool ChannelReport::passes() const {
    const double allowed = tolerance.fraction * static_cast<double>(pixels);
    return nan_mismatches == 0 && static_cast<double>(differing) <= allowed;
}

bool CompareReport::equal() const {
    return structure.empty() &&
           std::all_of(channels.begin(), channels.end(),
                       [](const ChannelReport& channel) { return channel.passes(); });
}

CompareReport compare(const Film& reference, const Film& test, const CompareRules& rules) {
    CompareReport report;
    compare_structure(reference, test, report);
    if (reference.window != test.window) return report;
    report.left_out =
        static_cast<std::uint64_t>(std::count(rules.left_out.begin(), rules.left_out.end(), true));
    for (const Plane& plane : reference.planes) {
        const Plane* other = test.find(plane.name);
        if (other == nullptr || other->type != plane.type) continue;
        report.channels.push_back(compare_channel(reference.window, plane, *other, rules));
    }
    return report;
}

CompareReport compare(const Film& reference, const Film& test, const Tolerance& tolerance) {
    return compare(reference, test, CompareRules{tolerance, {}, {}});
}

}  // namespace quadrel
