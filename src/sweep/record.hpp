// What is kept of a run: one flat JSON object, whose keys columns.hpp explains.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/document/json.hpp"
#include "sweep/machine.hpp"
#include "sweep/measure.hpp"
#include "sweep/plan/runs.hpp"
#include "sweep/run_error.hpp"

namespace quadrel::sweep {

/// What a run is and where: what is known before it is measured.
Json describe_run(const Plan& plan, const Run& run, const Machine& machine);

void add_time(Json& record, const RunTime& time, int threads);
void add_counts(Json& record, const RunCounts& counts, const SearchCost& cost);
void add_error(Json& record, const RunError& error);

/// Writes folder/KEY.json whole or not at all. Throws OutputError.
void write_record(const std::filesystem::path& folder, const Json& record);

/// A finished run of that key; none where there is none or it cannot be read.
std::optional<Json> read_record(const std::filesystem::path& folder, const std::string& key);

/// All runs of a folder, in the order of their plan. Throws InputError for a file that is no run.
std::vector<Json> read_records(const std::filesystem::path& folder);

}  // namespace quadrel::sweep
