// The runs of a sweep as files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/document/json.hpp"

namespace quadrel::sweep {

/// results.json: {"title", "columns", "runs"}, without pictures.
Json results_json(const std::string& title, const std::vector<Json>& records);

/// One line per run, columns as columns.hpp has them, then look-ups by texture.
std::string results_csv(const std::vector<Json>& records);

/// A Markdown table of frames per second and errors, those of rows that have published figures
/// beside these.
std::string frames_table(const std::vector<Json>& records);

/// Writes results.csv, results.json, page.html and plots/*.svg, together or not at all. Throws
/// OutputError.
void write_results(const std::filesystem::path& folder, const std::string& title,
                   const std::vector<Json>& records);

}  // namespace quadrel::sweep
