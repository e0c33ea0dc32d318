// A judgement for people.
#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "film/compare/preparation.hpp"
#include "quadrel/film/legal.hpp"
#include "text/printable.hpp"

namespace quadrel {
namespace {

constexpr int least_name_width = 12;

int name_width(const LegalReport& report) {
    std::size_t width = least_name_width;
    for (const LegalChannelReport& channel : report.channels)
        width = std::max(width, printable(channel.name).size());
    return static_cast<int>(width);
}

/// "12 (0.41 %)".
std::string count_text(const LegalChannelReport& channel, LegalVerdict verdict) {
    const std::uint64_t count = channel.count(verdict);
    if (count == 0) return "0";
    const double share = 100 * static_cast<double>(count) / static_cast<double>(channel.pixels);
    return fmt::format("{} ({:.3g} %)", count, share);
}

std::string verdict_text(const LegalChannelReport& channel) {
    std::string text;
    const auto add = [&](bool holds, const char* words) {
        if (holds) text += (text.empty() ? "" : ", ") + std::string(words);
    };
    add(channel.count(LegalVerdict::fail) > 0, "not legal");
    add(channel.too_ambiguous, "too ambiguous");
    add(channel.too_unconstrained, "too unconstrained");
    return text.empty() ? "legal" : text;
}

std::string table_text(const LegalReport& report) {
    const int width = name_width(report);
    std::string text =
        fmt::format("{:<{}} {:>10} {:>18} {:>18} {:>18} {:>18}  verdict\n", "channel", width,
                    "pixels", "pass", "ambiguous", "unconstrained", "fail");
    for (const LegalChannelReport& channel : report.channels)
        text +=
            fmt::format("{:<{}} {:>10} {:>18} {:>18} {:>18} {:>18}  {}\n", printable(channel.name),
                        width, channel.pixels, count_text(channel, LegalVerdict::pass),
                        count_text(channel, LegalVerdict::ambiguous),
                        count_text(channel, LegalVerdict::unconstrained),
                        count_text(channel, LegalVerdict::fail), verdict_text(channel));
    return text;
}

std::string value_text(ChannelType type, std::uint32_t bits) {
    if (type == ChannelType::uint32) return fmt::format("{}", bits);
    return fmt::format("{0} ({0:a})", std::bit_cast<float>(bits));
}

std::string range_text(const LegalRange& range) {
    const std::string gap = range.gap_lo < range.gap_hi
                                ? fmt::format(", not {} to {}", range.gap_lo, range.gap_hi)
                                : "";
    return fmt::format("{} to {} in {} range{}{}", range.lo, range.hi, range.paths,
                       range.paths == 1 ? "" : "s", gap);
}

std::string worst_text(const LegalChannelReport& channel) {
    if (channel.worst.empty()) return "";
    std::string text =
        fmt::format("{}: {} fail, of these NaN {}, missing {}\n", printable(channel.name),
                    channel.count(LegalVerdict::fail), channel.nan, channel.missing);
    const char* label = "worst at";
    for (const LegalPixel& pixel : channel.worst) {
        text += fmt::format(
            "  {} {},{}: test {}, permitted {}, reference {}\n", label, pixel.x, pixel.y,
            pixel.test ? value_text(channel.test_type, *pixel.test) : "missing",
            range_text(pixel.range), value_text(channel.reference_type, pixel.reference));
        if (pixel.covered_alone)
            text.insert(text.size() - 1, "; one side alone covers the pixel, which is decided");
        label = "     and";
    }
    return text;
}

/// What one side alone covers.
std::string coverage_text(const LegalReport& report) {
    std::string text;
    if (const std::uint64_t count = report.alone_undecided + report.alone_decided; count > 0)
        text += fmt::format(
            "pixels that one side alone covers: {}, of these undecided (ambiguous) {}, decided "
            "(fail) {}\n",
            count, report.alone_undecided, report.alone_decided);
    if (report.alone_unknown > 0)
        text += fmt::format(
            "pixels that one side alone covers: {}; a reference with the channel undecided says "
            "where that is permitted\n",
            report.alone_unknown);
    return text;
}

/// What is wrong with the reference itself.
std::string reference_text(const LegalChannelReport& channel) {
    std::string text;
    const std::string name = printable(channel.name);
    if (channel.empty_ranges > 0)
        text += fmt::format("{}: the reference's lower end lies above the upper one at {} pixels\n",
                            name, channel.empty_ranges);
    if (channel.reference_outside > channel.empty_ranges)
        text += fmt::format("{}: the reference itself lies outside of its range at {} pixels\n",
                            name, channel.reference_outside - channel.empty_ranges);
    return text;
}

}  // namespace

std::string to_text(const LegalReport& report) {
    std::string text;
    if (report.preparation) text += preparation_text(*report.preparation);
    for (const auto* lines : {&report.structure, &report.notes})
        for (const std::string& line : *lines) text += printable(line) + "\n";
    if (report.left_out > 0) text += fmt::format("pixels left out: {}\n", report.left_out);
    text += coverage_text(report);
    if (!report.channels.empty()) text += table_text(report);
    for (const LegalChannelReport& channel : report.channels)
        text += reference_text(channel) + worst_text(channel);
    const LegalRules& rules = report.rules;
    text += fmt::format(
        "wide: beyond {:g} % of a channel's extent; at most {:g} % ambiguous, {:g} "
        "% unconstrained\n",
        100 * rules.widest, 100 * rules.most_ambiguous, 100 * rules.most_unconstrained);
    return text + (report.passes() ? "legal\n" : "not legal\n");
}

}  // namespace quadrel
