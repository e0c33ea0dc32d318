// A comparison for people.
#include <fmt/format.h>

#include <bit>
#include <cmath>

#include "film/compare/preparation.hpp"
#include "text/printable.hpp"

namespace quadrel {
namespace {

constexpr int name_width = 20;

std::string value_text(const ChannelReport& channel, std::uint32_t bits) {
    if (channel.type == ChannelType::uint32) return fmt::format("{} ({:#x})", bits, bits);
    const float value = std::bit_cast<float>(bits);
    const bool has_code =
        (channel.encoding == Encoding::unorm8 || channel.encoding == Encoding::srgb8) &&
        value == value;
    if (has_code)
        return fmt::format("{} (code {} = {:#04x})", value, code_of(value), code_of(value));
    return fmt::format("{} ({:a})", value, value);
}

const char* ulp_unit(Encoding encoding) {
    if (encoding == Encoding::none) return "ulp";
    return encoding == Encoding::half ? "halves" : "codes";
}

std::string tolerance_text(const Tolerance& tolerance) {
    std::string text;
    if (tolerance.abs > 0) text += fmt::format(" abs {:g}", tolerance.abs);
    if (tolerance.rel > 0) text += fmt::format(" rel {:g}", tolerance.rel);
    if (tolerance.ulp > 0) text += fmt::format(" ulp {}", tolerance.ulp);
    if (tolerance.fraction > 0) text += fmt::format(" fraction {:g}", tolerance.fraction);
    return text.empty() ? "" : " [tolerance" + text + "]";
}

std::string statistics_text(const ChannelReport& channel) {
    std::string text = fmt::format("max {:.6g}, mean {:.6g}, rms {:.6g}", channel.max_abs,
                                   channel.mean_abs, channel.rms);
    if (channel.type == ChannelType::float32) {
        if (!std::isnan(channel.psnr)) text += fmt::format(", psnr {:.2f} dB", channel.psnr);
        text += fmt::format(", {} {}", channel.max_ulp, ulp_unit(channel.encoding));
    }
    if (channel.nan_mismatches > 0)
        text += fmt::format(", NaN on one side: {}", channel.nan_mismatches);
    if (channel.infinite_mismatches > 0)
        text += fmt::format(", infinite: {}", channel.infinite_mismatches);
    return text;
}

std::string channel_text(const ChannelReport& channel) {
    const std::string name = printable(channel.name);
    if (channel.unequal == 0) return fmt::format("{:<{}} equal\n", name, name_width);
    const char* verdict = channel.differing == 0 ? ", within" : channel.passes() ? ", allowed" : "";
    std::string text =
        fmt::format("{:<{}} {} of {} differ ({} unequal{}): {}{}\n", name, name_width,
                    channel.differing, channel.pixels, channel.unequal, verdict,
                    statistics_text(channel), tolerance_text(channel.tolerance));
    const char* label = "worst at";
    for (const PixelDifference& pixel : channel.worst) {
        text += fmt::format("{:<{}} {} {},{}: reference {}, test {}\n", "", name_width, label,
                            pixel.x, pixel.y, value_text(channel, pixel.reference),
                            value_text(channel, pixel.test));
        label = "     and";
    }
    return text;
}

std::string blame_text(const CompareReport& report, const Blame& blame) {
    std::string text =
        fmt::format("worst pixel of {}: {},{}\n", printable(blame.symptom), blame.x, blame.y);
    if (!blame.upstream.empty()) {
        text += "still right there:";
        for (const std::string& name : blame.upstream) text += " " + printable(name);
        text += "\n";
    }
    for (const ChannelReport& channel : report.channels)
        if (channel.name == blame.first)
            text += fmt::format("first wrong there: {}, reference {}, test {}\n",
                                printable(blame.first), value_text(channel, blame.reference),
                                value_text(channel, blame.test));
    if (blame.same_scene.has_value() && !*blame.same_scene)
        text += "the reference was rendered from another scene, or with other values\n";
    return blame.command.empty() ? text : text + "look: " + blame.command + "\n";
}

}  // namespace

std::string preparation_text(const Preparation& preparation) {
    std::string text =
        fmt::format("reference {} ({}), test {} ({})\n", preparation.reference_file,
                    preparation.reference_storage, preparation.test_file, preparation.test_storage);
    if (preparation.encoding != Encoding::none)
        text += fmt::format("encoded as {}\n", encoding_name(preparation.encoding));
    for (const std::string& line : preparation.decoded)
        text += fmt::format("decoded {}\n", printable(line));
    if (preparation.flip_y) text += "test flipped in y\n";
    for (const auto& [reference, test] : preparation.mappings)
        text +=
            fmt::format("channel {} is {} of the test\n", printable(reference), printable(test));
    for (const std::string& name : preparation.by_value)
        text += fmt::format("channel {}: integers of one image as the nearest floats\n",
                            printable(name));
    if (const auto& window = preparation.window)
        text += fmt::format("only pixels {},{} to {},{}, the latter excluded\n", window->x0,
                            window->y0, window->x1, window->y1);
    return text;
}

std::string to_text(const CompareReport& report) {
    std::string text;
    if (report.preparation) text += preparation_text(*report.preparation);
    for (const std::string& line : report.structure) text += printable(line) + "\n";
    if (report.left_out > 0) text += fmt::format("pixels left out: {}\n", report.left_out);
    for (const ChannelReport& channel : report.channels) text += channel_text(channel);
    if (report.blame) text += blame_text(report, *report.blame);
    return text + (report.equal() ? "equal\n" : "different\n");
}

}  // namespace quadrel
