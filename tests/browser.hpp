// A browser without a window, for pages.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "film/films.hpp"

namespace quadrel::testing_browser {

/// A browser's name; empty where there is none.
inline std::string browser() {
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
        if (std::system((std::string("command -v ") + name + " >/dev/null 2>&1").c_str()) == 0)
            return name;
    return "";
}

inline constexpr const char* no_browser = "no chromium, chromium-browser or google-chrome on PATH";

/// Runs the browser in `folder`, which is its home, too, on a page there, which may have an anchor:
/// "out/page.html#place". Standard output goes into the file `out`, errors into the file err.
inline bool browse(const testing_films::TemporaryFolder& folder, const std::string& page,
                   const std::string& options, const std::string& out) {
    const std::string line = "cd '" + folder.path().string() + "' && HOME=. timeout 120 " +
                             browser() + " --headless --no-sandbox --hide-scrollbars " + options +
                             " 'file://" + (folder / page).string() + "' >" + out + " 2>err";
    return std::system(line.c_str()) == 0;
}

}  // namespace quadrel::testing_browser
