// What can be asked for: every channel of a rendered image.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "quadrel/film/film.hpp"

namespace quadrel {

/// One line of the table. A name with "<i>" stands for one channel per light, counted from 0.
struct ChannelInfo {
    std::string name;
    ChannelType type;
    std::string unit;  ///< unit or space of the values
    std::string meaning;
};

/// Every channel, in the order in which they are listed to people.
const std::vector<ChannelInfo>& channel_table();

/// R G B A Z.
const std::vector<std::string>& default_channels();

/// The table's line for a full name ("uv.U", "shadow.2.visibility"), or null.
const ChannelInfo* find_channel(const std::string& name);

/// Whether a full name is one of exact.* or derr.*, for which stages run once more, on dual
/// numbers, where they do at all.
bool is_exact_derivative(const std::string& name);

/// Whether a full name is one of err.*, for which stages run once more with the judge's hit.
bool is_error_channel(const std::string& name);

/// What stands before X in the names of the channels that say what a GPU may give for X.
inline constexpr std::array gpu_range_prefixes = {"gpu.lo.", "gpu.hi.", "gpu.paths.", "gpu.gap.lo.",
                                                  "gpu.gap.hi."};

/// A channel with such a name, bound.lo.X or bound.hi.X, taken apart.
struct RangeChannel {
    std::string set;      ///< gpu or bound
    std::string part;     ///< lo, hi, paths, gap.lo or gap.hi
    std::string channel;  ///< X: the full name of a float channel of stages, or Z
};

/// Empty for other channels. (Those of an X that there is no range of, too.)
std::optional<RangeChannel> range_channel(const std::string& name);

/// Whether there is a range of that channel.
bool has_range(const std::string& channel);

/// Whether a name is a range's (gpu.*, bound.*), or `undecided`: stages run once more for it, on
/// ranges, where they do at all.
bool needs_ranges(const std::string& name);

/// Whether a full name is one of integral.*, which integrals over pixels alone have.
bool is_integral_channel(const std::string& name);

/// Whether a full name is none that every render can draw beside the others: stages run once more
/// for it, on dual numbers, with the judge's stages, on ranges, or pixels are integrals.
bool is_drawn_apart(const std::string& name);

/// R G B A integral.error.R G B integral.samples.
const std::vector<std::string>& integral_channels();

/// Full names for what a user asks for: each request is a full name or a group, which stands for
/// every channel below it ("uv" for uv.U and uv.V, "hit" for all hit.*; "B" is blue, the bitangent
/// is "B.X" and so on). Order is kept, repetition dropped; no request at all gives the default.
/// Throws UsageError with the nearest known name.
std::vector<std::string> expand_channels(std::span<const std::string> requests);

/// The bits of a pixel that nothing covers: +inf for Z, 0xffffffff for id.*, else 0 (colour is the
/// scene's background instead).
std::uint32_t uncovered_bits(const std::string& name);

}  // namespace quadrel
