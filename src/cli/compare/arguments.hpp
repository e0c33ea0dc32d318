// What compare's options mean for two given images.
#pragma once

#include <functional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "quadrel/compare.hpp"

namespace quadrel::cli {

/// Tolerances as given: each "VALUE" for all channels or "CHANNEL=VALUE" for one channel or group.
struct ToleranceArguments {
    std::vector<std::string> abs, rel, ulp, fraction;
};

/// The channels that a request stands for in either image: the one of that name, else those below
/// it. Throws UsageError if there are none; `option` is for the message.
std::set<std::string> matching_channels(const std::string& option, const std::string& request,
                                        const Film& reference, const Film& test);

/// Drops the channels that the comma-separated `list` does not name. Throws UsageError.
void select_channels(const std::string& list, Film& reference, Film& test);

/// One of them, read but not yet matched with the channels of images.
struct ToleranceRule {
    std::string option;                      ///< "--abs"; for messages
    std::string channel;                     ///< a channel or group; empty for all
    bool for_integers = false;               ///< whether a group's integer channels are meant too
    std::function<void(Tolerance&)> assign;  ///< sets its part of a tolerance
};

/// Throws UsageError.
std::vector<ToleranceRule> parse_tolerances(const ToleranceArguments& arguments);

/// For each of abs, rel, ulp and fraction, a channel's own value wins over one for all; of several,
/// the last. A group stands for its float channels, and with fraction for all. Throws UsageError
/// for a channel that neither image has.
CompareRules match_tolerances(std::span<const ToleranceRule> rules, const Film& reference,
                              const Film& test);

/// "REF=TEST" each. Throws UsageError.
std::vector<ChannelMapping> parse_mappings(std::span<const std::string> arguments);

}  // namespace quadrel::cli
