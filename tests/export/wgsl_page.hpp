// Shaders in WGSL before a browser's compiler.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "browser.hpp"
#include "page/template.hpp"

namespace quadrel::export_tests {

/// What the browser says of each part of a file, by a page of tests/data/page, a line each:
/// "linear: ok"; a line "none" where it has no WebGPU.
inline std::vector<std::string> browser_verdicts(const std::string& page_name,
                                                 const std::string& shaders) {
    page::PageTemplate page(std::filesystem::path(QUADREL_SOURCE_DIR) / "tests/data/page" /
                            page_name);
    page.fill("{{SHADERS}}", shaders);
    const testing_films::TemporaryFolder folder;
    testing_films::write_bytes(folder / "page.html", page.text());
    if (!testing_browser::browse(folder, "page.html",
                                 "--use-angle=swiftshader --enable-unsafe-swiftshader "
                                 "--enable-unsafe-webgpu --use-webgpu-adapter=swiftshader "
                                 "--virtual-time-budget=20000 --dump-dom",
                                 "dom"))
        return {"no answer: " + testing_films::file_bytes(folder / "err")};
    const std::string dom = testing_films::file_bytes(folder / "dom"),
                      start = "<pre id=\"verdicts\">";
    const std::size_t from = dom.find(start) + start.size();
    std::istringstream lines(dom.substr(from, dom.find("</pre>", from) - from));
    std::vector<std::string> verdicts;
    for (std::string line; std::getline(lines, line);) verdicts.push_back(line);
    return verdicts;
}

}  // namespace quadrel::export_tests
