#include "cli/render_summary.hpp"

#include <fmt/format.h>

#include <map>

namespace quadrel::cli {
namespace {

std::string time_text(const PhaseTime& time) {
    return time.wall_ms < 9999.5 ? fmt::format("{:.0f} ms", time.wall_ms)
                                 : fmt::format("{:.1f} s", time.wall_ms / 1000);
}

/// `object "a": not visible`, `material "m": stage linear`: the word after the name says what.
std::string kind_of(const std::string& line) {
    if (line.starts_with("object")) return "object";
    const std::size_t colon = line.find("\": ");
    const std::string what = colon == std::string::npos ? line : line.substr(colon + 3);
    if (what.starts_with("all of it")) return "material";
    return what.substr(0, what.find(' '));
}

std::string left_out_text(const std::vector<std::string>& lines) {
    std::map<std::string, int> count;
    for (const std::string& line : lines) ++count[kind_of(line)];
    std::string text;
    for (const auto& [kind, n] : count) {
        text += text.empty() ? "" : ", ";
        if (kind == "steps") {
            text += "steps that no height can meet";
        } else if (kind == "levels" || kind == "channels") {
            text += kind + " that nothing samples";
        } else {
            text += fmt::format("{} {}{}", n, kind, n == 1 ? "" : "s");
        }
    }
    return text.empty() ? "nothing" : text;
}

}  // namespace

std::string summary_line(const RenderSummary& summary) {
    const double share = summary.pixels == 0 ? 0
                                             : 100.0 * static_cast<double>(summary.covered) /
                                                   static_cast<double>(summary.pixels);
    return fmt::format(
        "{} of {} pixels covered ({:.1f} %); plan {}, load {}, draw {}; left out: {}",
        summary.covered, summary.pixels, share, time_text(summary.plan), time_text(summary.load),
        time_text(summary.draw), left_out_text(summary.left_out));
}

std::optional<std::string> nothing_in_view(const RenderSummary& summary) {
    if (summary.covered > 0) return std::nullopt;
    const PrimitiveCounts& counts = summary.primitives;
    if (counts.submitted == 0) return "nothing is in view: the scene has no visible triangle";
    return fmt::format(
        "nothing is in view: of {} triangles {} are outside, {} not finite, {} clipped; of what is "
        "left, in pieces, {} are culled, {} off the frame, {} without area; {} drawn cover no "
        "pixel of the window",
        counts.submitted, counts.outside, counts.non_finite, counts.clipped, counts.culled,
        counts.off_frame, counts.zero_area, counts.drawn);
}

}  // namespace quadrel::cli
