#include "sweep/report/columns.hpp"

namespace quadrel::sweep {
namespace {

constexpr Column all_columns[] = {
    {"scene", "", "name in the plan"},
    {"map", "", "name in the plan"},
    {"map_kind", "", "how the map was made, or its name"},
    {"map_width", "texels", ""},
    {"map_height", "texels", ""},
    {"view", "", "the angle, or camera"},
    {"angle", "degrees", "between view and normal"},
    {"algorithm", "", "trace and what the plan sets of it"},
    {"trace", "", "the stage's id"},
    {"family", "", "offset, march, cone, exact, oracle, engine or other"},
    {"steps_asked", "", "the plan's value of the parameter that counts steps"},
    {"number", "", "float or double"},
    {"isa", "", "instruction set that ran"},
    {"threads", "", ""},
    {"width", "pixels", ""},
    {"height", "pixels", ""},
    {"samples", "a pixel", ""},
    {"draw_ms", "ms", "drawing R G B A, the least of the repeats"},
    {"draw_ms_median", "ms", "their median"},
    {"kernel_ms", "ms of CPU", "in stages alone, each on its own, all threads together, least"},
    {"kernel_ms_median", "ms of CPU", "its median"},
    {"trace_ms", "ms of CPU", "of it the search, median"},
    {"fps", "1/s", "1000 / draw_ms"},
    {"published_fps", "1/s", "what the plan says was published"},
    {"load_ms", "ms", "reading maps and deriving what the search needs, once"},
    {"clock", "", "cpu for one thread, else wall"},
    {"fragments", "", "covered lanes"},
    {"helpers", "", "helper lanes"},
    {"look_ups", "a fragment", "in all textures, helper lanes included"},
    {"search_look_ups", "a fragment", "of the search"},
    {"lockstep_look_ups", "a fragment", "where 8 x 4 pixels wait for one another"},
    {"steps", "a fragment", "of the search, helper lanes included"},
    {"texels_touched", "", "distinct"},
    {"lines_touched", "", "distinct cache lines of 64 bytes"},
    {"rays", "", "that were judged"},
    {"s_median", "thicknesses", "distance from the true hit in depth"},
    {"s_p99", "thicknesses", ""},
    {"s_max", "thicknesses", ""},
    {"texels_mean", "texels", "distance from the true hit in the plane of the map"},
    {"texels_median", "texels", ""},
    {"texels_p90", "texels", ""},
    {"texels_p99", "texels", ""},
    {"texels_max", "texels", ""},
    {"wrong", "share", "of the rays: all of the following"},
    {"late", "share", "beyond the true hit by more than the plan allows"},
    {"early", "share", "before it"},
    {"hit_of_miss", "share", "a hit, where the ray meets nothing"},
    {"miss_of_hit", "share", "no hit, where it meets the surface"},
    {"nan", "share", "ended at a NaN"},
    {"machine", "", "processor and host"},
    {"build", "", "version, and hashes of the program and its kernels"},
    {"load", "processes", "that wanted to run in the minute before"},
    {"failed", "", "why it was not measured"},
    {"command", "", "draws the picture"},
};

}  // namespace

std::span<const Column> columns() { return all_columns; }

}  // namespace quadrel::sweep
