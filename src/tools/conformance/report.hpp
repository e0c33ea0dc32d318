// What conformance found, for people and tools.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "conformance/judge/verdicts.hpp"

namespace quadrel::conformance {

struct Report {
    std::string renderer, version, hardware, limits;
    int size = 0;                 ///< pixels a side
    std::size_t most_ranged = 0;  ///< as JudgeOptions has it
    std::vector<CaseReport> cases;
};

/// Shares of pixels that each verdict may have, of all in a group of a case; more is a failure.
struct Bounds {
    double perturbed = 0.2, legal = 1, open = 0.05, left = 1, coverage = 0.02, divergent = 0.05,
           unordered = 0.05, defect = 0.5;
};

/// A line for each group of a case that has something unexplained, or of which a class is larger
/// than its bound, for each case that the implementation failed to draw, and where all were refused
/// and nothing was judged. None: it conforms.
std::vector<std::string> complaints(const Report& report, const Bounds& bounds);

/// A line per row, counts over its maps and angles; what is unexplained below.
std::string to_text(const Report& report);
/// Tables in Markdown: a line for the channels of each place in the data flow, over all rows, and
/// a line per row, those that are equal bit for bit together.
std::string to_markdown(const Report& report);
nlohmann::ordered_json to_json(const Report& report);
/// What to_json has written to a file. Throws InputError.
Report read_report(const std::filesystem::path& file);

}  // namespace quadrel::conformance
