// Which channels are judged by the ranges that a reference holds for them.
#pragma once

#include <string>
#include <vector>

#include "quadrel/film/film.hpp"

namespace quadrel {

/// Drops the channels that no request names, by itself or as a group, and their ranges with them;
/// nothing where the reference has no ranges at all. What tells coverage (A, undecided) stays.
/// Throws UsageError for a request that the reference has no range of; `option` is for the message.
void keep_ranged_channels(const std::string& option, const std::vector<std::string>& requests,
                          Film& reference, Film& test);

}  // namespace quadrel
