// render --watch: a scene drawn again whenever it or one of its files changes.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "io/tev/connection.hpp"
#include "quadrel/render.hpp"

namespace quadrel::cli {

struct WatchedRender {
    /// Loads the scene; throws InputError while it is being changed, and UsageError where it does
    /// not go with the command line. `files` becomes what was read for it, in either case.
    std::function<Scene(std::vector<std::filesystem::path>& files)> load;
    RenderOptions options;                  ///< window: of the whole image
    std::filesystem::path output, preview;  ///< preview empty: none
    ExrCompression compression = ExrCompression::zip;
    TevConnection* tev = nullptr;  ///< may be null
};

/// Draws and writes once, and then after each change, until the process is ended. What cannot be
/// drawn is said in a line, and the next change is waited for. The image is kept in memory: throws
/// as `render` does where it is too large for that.
[[noreturn]] void watch(const WatchedRender& render);

}  // namespace quadrel::cli
