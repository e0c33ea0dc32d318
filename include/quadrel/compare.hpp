// A strict comparison of two images. What cannot be compared counts as a difference: a missing or
// extra channel, another size or window, a NaN on one side only.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "quadrel/film/comparable.hpp"
#include "quadrel/film/film.hpp"

namespace quadrel {

/// A float value passes if its bits are equal (all NaNs count as equal, -0 and +0 do not) or if any
/// of abs, rel and ulp, where not 0, allows it; infinities and NaNs pass by equal bits only.
struct Tolerance {
    double abs = 0;         ///< |test - reference| <= abs
    double rel = 0;         ///< |test - reference| <= rel * |reference|
    std::uint32_t ulp = 0;  ///< ulp_distance(test, reference) <= ulp, in units of the encoding
    double fraction = 0;    ///< share of pixels, 0 to 1, that may exceed; never excuses a NaN

    bool operator==(const Tolerance&) const = default;
};

struct CompareRules {
    Tolerance all;                                ///< of every channel not named in `channels`
    std::map<std::string, Tolerance> channels;    ///< by full name
    std::map<std::string, Encoding> encodings{};  ///< what both images were rounded to, by channel
    std::vector<bool> left_out{};  ///< pixels, row by row, at which nothing is compared; or empty

    /// What holds for a channel. Integer channels pass by equal bits only, except for `fraction`,
    /// and for `abs` of the channel's own entry.
    Tolerance tolerance_of(const std::string& channel, ChannelType type) const;
    Encoding encoding_of(const std::string& channel) const;
};

/// The bits of hit.flags of these names (quad/value.hpp). Throws UsageError.
std::uint32_t parse_hit_flags(const std::vector<std::string>& names);

/// The pixels of the reference at which hit.flags has one of the bits: for CompareRules::left_out.
/// Throws UsageError where it has no such channel.
std::vector<bool> flagged_pixels(const Film& reference, std::uint32_t flags);

/// Whether a value leaves its tolerance (which is as CompareRules::tolerance_of gives it).
bool exceeds(ChannelType type, Encoding encoding, const Tolerance& tolerance,
             std::uint32_t reference, std::uint32_t test);

/// One pixel of one channel, in image coordinates; the values by their bits.
struct PixelDifference {
    int x = 0, y = 0;
    std::uint32_t reference = 0, test = 0;
};

/// How many of the worst pixels a report names.
inline constexpr std::size_t most_worst_pixels = 10;

/// How one channel differs. Statistics are over all pixels whose values are finite in both images.
struct ChannelReport {
    std::string name;
    ChannelType type = ChannelType::float32;
    Encoding encoding = Encoding::none;
    Tolerance tolerance;
    std::uint64_t pixels = 0;
    std::uint64_t unequal = 0;              ///< pixels with other bits, within the tolerance or not
    std::uint64_t differing = 0;            ///< pixels beyond the tolerance, all kinds
    std::uint64_t nan_mismatches = 0;       ///< of these: NaN on one side only
    std::uint64_t infinite_mismatches = 0;  ///< of these: infinite on one side only, or other signs
    double max_abs = 0, mean_abs = 0, rms = 0;
    /// Peak signal-to-noise ratio in dB for a peak of 1: -20 log10(rms); +inf if rms is 0,
    /// NaN if it is and there are pixels of which one side alone is finite.
    double psnr = 0;
    std::uint32_t max_ulp = 0;  ///< in units of the encoding; floats only
    /// The worst pixels beyond the tolerance: a NaN on one side before anything infinite before any
    /// finite error, then the largest |error|, then the first from the top-left, row by row.
    std::vector<PixelDifference> worst;

    /// Whether no more pixels exceed than may, and none by a NaN.
    bool passes() const;
};

/// Where the values of the worst pixel first go wrong.
struct Blame {
    int x = 0, y = 0;     ///< the worst pixel of `symptom`
    std::string symptom;  ///< the last channel in data flow that does not pass
    std::string first;    ///< the first channel in data flow that leaves its tolerance there
    std::uint32_t reference = 0, test = 0;  ///< its bits
    std::vector<std::string>
        upstream;                    ///< channels before it, in data flow, that are as they should
    std::string command;             ///< what to run next; the caller's
    std::optional<bool> same_scene;  ///< whether the reference was rendered from that scene
};

/// What was done to the images before they were compared.
struct Preparation {
    std::string reference_file, test_file;
    std::string reference_storage, test_storage;  ///< "unorm8"; several: "float32 uint32"
    Encoding encoding = Encoding::none;
    bool flip_y = false;
    std::vector<ChannelMapping> mappings;
    std::vector<std::string> by_value{};  ///< integers on one side, floats on the other
    std::optional<Window> window{};       ///< the only pixels that were compared, where asked for
    std::vector<std::string> decoded{};   ///< one line each: channels that were codes of an image
};

struct CompareReport {
    std::optional<Preparation> preparation;  ///< the caller's
    std::vector<std::string> structure;   ///< one line each: sizes, windows, channels that differ
    std::vector<ChannelReport> channels;  ///< those that both have, with the same type and window
    std::uint64_t left_out = 0;           ///< pixels at which nothing was compared
    std::optional<Blame> blame;           ///< the caller's, by find_blame

    bool equal() const;
};

/// Compares all channels; nothing is compared pixel by pixel if the windows differ.
CompareReport compare(const Film& reference, const Film& test, const CompareRules& rules);
CompareReport compare(const Film& reference, const Film& test, const Tolerance& tolerance = {});

/// Place of a channel in the data flow: what was drawn, geometry, derivatives, frame, level of
/// detail, hit, normal, shadow, light, colour; unknown names last. Equal for components of a
/// vector.
std::size_t data_flow_rank(const std::string& channel);

/// Looks at the worst pixel of the last channel in data flow that does not pass, and there for the
/// first that leaves its tolerance, among the channels of `report`. None if every channel passes.
/// The films and rules are those of the report.
std::optional<Blame> find_blame(const Film& reference, const Film& test, const CompareRules& rules,
                                const CompareReport& report);

/// For people, several lines; values in decimal and as hex floats, codes or bits.
std::string to_text(const CompareReport& report);
/// One JSON object. NaN and infinities are strings; every value stands beside its bits in hex.
std::string to_json(const CompareReport& report);

}  // namespace quadrel
