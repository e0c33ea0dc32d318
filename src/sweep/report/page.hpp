// One HTML page that needs nothing else: charts, pictures and a table of all runs.
#pragma once

#include <string>
#include <vector>

#include "io/document/json.hpp"

namespace quadrel::sweep {

/// `results` as results_json gives them; pictures are taken from `records`. The template lies in
/// the data directory: sweep/page.html, page.css, page.js, and page/base.*. Throws InputError if it
/// does not.
std::string page_html(const Json& results, const std::vector<Json>& records);

}  // namespace quadrel::sweep
