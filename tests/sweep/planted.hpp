// Errors that checks of the room have to notice.
#pragma once

#include <cstdint>

namespace quadrel::sweep_tests {

enum class Planted : std::int32_t {
    mean_for_percentile,
    row_left_out,     ///< of a plan
    task_off_by_one,  ///< tasks that leave out runs, or have some twice
    wall_too_thick,
    number_changed,  ///< between results.json and the page
};

}  // namespace quadrel::sweep_tests
