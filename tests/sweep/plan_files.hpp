// Plans for tests.
#pragma once

#include <string>

#include "film/films.hpp"
#include "sweep/plan/plan.hpp"

namespace quadrel::sweep_tests {

/// A plan in a folder of its own; `more` is put in front of its other keys.
inline std::string small_plan(const std::string& more = "") {
    return R"({"sweep": 1, )" + more + R"(
  "scenes": [{"name": "clay", "scene": "rows/linear", "set": {
    "material.color": null, "material.shade": "shade-lambert", "material.relief.shadow": "none",
    "material.relief.depth": 0.1}}],
  "maps": [{"kind": "spikes", "size": 16}],
  "views": [0, 60],
  "algorithms": [{"trace": "linear", "parameters": {"steps": [4, 16]}}, "max-mip"],
  "size": [16, 16], "repeats": 1, "pictures": {"side": 16}})";
}

inline sweep::Plan plan_of(const testing_films::TemporaryFolder& folder, const std::string& text) {
    testing_films::write_bytes(folder / "plan.json", text);
    return sweep::read_plan(folder / "plan.json");
}

}  // namespace quadrel::sweep_tests
