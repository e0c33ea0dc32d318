// What compare's options mean for two given images.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "film/compare/tolerances.hpp"
#include "quadrel/compare.hpp"

namespace quadrel::cli {

/// Tolerances as given: each "VALUE" for all channels or "CHANNEL=VALUE" for one channel or group.
struct ToleranceArguments {
    std::vector<std::string> abs, rel, ulp, fraction;
};

/// Drops the channels that the comma-separated `list` does not name. Throws UsageError.
void select_channels(const std::string& list, Film& reference, Film& test);

/// Throws UsageError.
std::vector<ToleranceRule> parse_tolerances(const ToleranceArguments& arguments);

/// "REF=TEST" each. Throws UsageError.
std::vector<ChannelMapping> parse_mappings(std::span<const std::string> arguments);

}  // namespace quadrel::cli
