// Tolerances for channels and groups of channels, as people name them, and what they mean for two
// given images.
#pragma once

#include <functional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "quadrel/compare.hpp"

namespace quadrel {

/// The channels that a request stands for in either image: the one of that name, else those below
/// it. Throws UsageError if there are none; `option` is for the message.
std::set<std::string> matching_channels(const std::string& option, const std::string& request,
                                        const Film& reference, const Film& test);

/// Drops the channels that none of the requests stands for. Throws UsageError as matching_channels
/// does.
void keep_channels(const std::string& option, const std::vector<std::string>& requests,
                   Film& reference, Film& test);

/// What is allowed, not yet matched with the channels of images.
struct ToleranceRule {
    std::string option;                      ///< what set it, such as "--abs"; for messages
    std::string channel;                     ///< a channel or group; empty for all
    bool for_integers = false;               ///< whether a group's integer channels are meant too
    std::function<void(Tolerance&)> assign;  ///< sets its part of a tolerance
};

/// For each of abs, rel, ulp and fraction, a channel's own value wins over one for all; of several,
/// the last. A group stands for its float channels, and with fraction for all. Throws UsageError
/// for a channel that neither image has.
CompareRules match_tolerances(std::span<const ToleranceRule> rules, const Film& reference,
                              const Film& test);

}  // namespace quadrel
