// Ctrl-C removes what would be left behind.
#pragma once

#include <filesystem>

namespace quadrel::peers {

/// From then on SIGINT, SIGTERM and SIGHUP remove the folders of remove_if_interrupted and end the
/// program with 128 and their number. To be called before there are threads, and after processes
/// were forked that are to be ended as usual.
void watch_for_interruption();

void remove_if_interrupted(const std::filesystem::path& folder);
/// It is gone, or to be kept.
void forget_if_interrupted(const std::filesystem::path& folder);

}  // namespace quadrel::peers
