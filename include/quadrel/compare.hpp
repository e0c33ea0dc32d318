// A strict comparison of two images. What cannot be compared counts as a difference: a missing or
// extra channel, another size or window, a NaN or an infinity on one side only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "quadrel/film/film.hpp"

namespace quadrel {

/// A float value passes if its bits are equal (all NaNs count as equal, -0 and +0 do not) or if any
/// of these, where given, allows it; infinities and NaNs pass by equal bits only. Integer channels
/// pass by equal bits only.
struct Tolerance {
    double abs = 0;         ///< |test - reference| <= abs
    double rel = 0;         ///< |test - reference| <= rel * |reference|
    std::uint32_t ulp = 0;  ///< at most so many float32 values apart; -0 and +0 are none apart
};

/// How one channel differs. Statistics are over all pixels whose values are finite in both images.
struct ChannelReport {
    std::string name;
    ChannelType type = ChannelType::float32;
    std::uint64_t pixels = 0;
    std::uint64_t differing = 0;            ///< pixels beyond the tolerance, all kinds
    std::uint64_t nan_mismatches = 0;       ///< of these: NaN on one side only
    std::uint64_t infinite_mismatches = 0;  ///< of these: infinite on one side only, or other signs
    double max_abs = 0, mean_abs = 0, rms = 0;
    std::uint32_t max_ulp = 0;  ///< floats only
    /// The worst pixel beyond the tolerance, in image coordinates: a NaN or infinite mismatch
    /// before any finite error, then the largest |error|, then the first. -1: none.
    int worst_x = -1, worst_y = -1;
    std::uint32_t worst_reference = 0, worst_test = 0;  ///< bits
};

struct CompareReport {
    std::vector<std::string> structure;   ///< one line each: sizes, windows, channels that differ
    std::vector<ChannelReport> channels;  ///< those that both have, with the same type and window

    bool equal() const;
};

/// Compares all channels; nothing is compared pixel by pixel if the windows differ.
CompareReport compare(const Film& reference, const Film& test, const Tolerance& tolerance = {});

/// For people, several lines.
std::string to_text(const CompareReport& report);
/// One JSON object: equal, structure, channels.
std::string to_json(const CompareReport& report);

}  // namespace quadrel
