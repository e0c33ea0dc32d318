#include <algorithm>
#include <array>

#include "quadrel/error.hpp"
#include "quadrel/film/value_bits.hpp"
#include "text/suggest.hpp"

namespace quadrel {
namespace {

/// In the order of BitLayout.
constexpr std::array<const char*, 7> layout_names = {"bits",    "rgba8", "rgb8", "rg16",
                                                     "rgb10a2", "low",   "high"};

constexpr const char* form = "LAYOUT:CHANNEL[,CHANNEL...][=FILE], as bits:hit.U";

BitLayout parse_layout(const std::string& option, const std::string& name) {
    const auto found = std::find(layout_names.begin(), layout_names.end(), name);
    if (found == layout_names.end())
        throw UsageError(option + ": found the layout \"" + name + "\", expected " +
                         one_of(name, layout_names));
    return static_cast<BitLayout>(found - layout_names.begin());
}

std::vector<std::string> split_names(const std::string& text) {
    std::vector<std::string> names(1);
    for (const char c : text) {
        if (c == ',')
            names.emplace_back();
        else
            names.back() += c;
    }
    return names;
}

}  // namespace

const char* bit_layout_name(BitLayout layout) {
    return layout_names[static_cast<std::size_t>(layout)];
}

CarriedBits parse_carried_bits(const std::string& option, const std::string& text) {
    const auto reject = [&] {
        throw UsageError(option + ": found \"" + text + "\", expected " + form);
    };
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos) reject();
    const std::size_t equals = text.find('=', colon);
    CarriedBits bits{parse_layout(option, text.substr(0, colon)),
                     split_names(text.substr(colon + 1, equals - colon - 1)),
                     {}};
    if (std::find(bits.channels.begin(), bits.channels.end(), "") != bits.channels.end()) reject();
    if (equals == std::string::npos) return bits;
    bits.file = text.substr(equals + 1);
    if (bits.file.empty()) reject();
    return bits;
}

}  // namespace quadrel
