// Where and how much two images differ, as a picture: channels of one kind share a panel and a
// scale.
#pragma once

#include <string>
#include <vector>

#include "quadrel/film/preview.hpp"

namespace quadrel {

/// What the differences of a channel are measured by.
enum class HeatKind : std::int32_t {
    colour,  ///< R G B A Y, light.*, visibility: absolute, 2^-24 and less to 1 and more
    value,   ///< other floats: relative to the larger of 1 and the reference's magnitude; so, too
    count,   ///< steps, fetches: how many more or less, 1 to 256 and more
    code     ///< status, flags, indices: another code is another code
};

/// The kind of a channel by its name, as the table of channels has it (film/channels.hpp); unknown
/// names are values, or codes if they are integers.
HeatKind heat_kind(const std::string& channel, ChannelType type);

struct HeatPanel {
    HeatKind kind = HeatKind::value;
    std::vector<std::string> channels;  ///< that both images have with the same type
    Picture picture;                    ///< of the window; without legend
};

/// One panel for each kind that the images have, in the order of the kinds: the largest difference
/// of each pixel over the panel's channels. Black: equal; then dark blue over red to white; NaN or
/// infinite on one side only is magenta. Throws UsageError if the windows differ.
std::vector<HeatPanel> heat_panels(const Film& reference, const Film& test);

/// The panels side by side. Below each stand its kind, its channels, and its scale from end to end.
Picture heatmap(const Film& reference, const Film& test);

}  // namespace quadrel
