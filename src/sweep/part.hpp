// Which runs a folder should have: what a task was asked for stands beside what it has measured, so
// that a part that failed or was lost is known to lack.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sweep/plan/plan.hpp"

namespace quadrel::sweep {

/// The plan that was last run into a folder.
struct Part {
    std::string title;
    std::string plan_id;   ///< the same for equal lists of runs; records have it, too
    std::size_t runs = 0;  ///< of the whole plan
    int of = 1;            ///< in how many parts; 0: folders of several numbers were joined
};

/// A hash of the names of all runs, in the plan's order.
std::string plan_id(const std::vector<std::string>& names);

/// Writes folder/part.json whole or not at all. Throws OutputError.
void write_part(const std::filesystem::path& folder, const Part& part);

/// None where there is none, as in folders of older versions, or it cannot be read.
std::optional<Part> read_part(const std::filesystem::path& folder);

/// Of a plan's runs those that are there, and which of the parts lack how many: "8 of the 12 runs
/// of plan \"x\" (--task 3/3 lacks 4)". Empty where all are there. `orders`: places in the plan,
/// counted from 0.
std::string lacking_runs(const Part& part, const std::set<std::size_t>& orders);

}  // namespace quadrel::sweep
