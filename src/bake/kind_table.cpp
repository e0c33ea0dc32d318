// The table of kinds: what each is called, takes, promises and costs.
#include <cmath>

#include "bake/generators.hpp"
#include "bake/kinds.hpp"

namespace quadrel {

namespace {

// Seconds of one core where the heights are easy: about half of what the walls of data/textures
// take (bench/bake_bench.cpp has harder fields).
double linear_time(double texels) { return 2e-8 * texels; }
double logarithmic_time(double texels) { return 4e-7 * texels; }
double layered_time(double texels) { return 2e-6 * texels; }
double table_time(double texels) { return 4e-7 * texels; }
double ray_time(double texels) { return 2.5e-8 * texels * std::sqrt(texels); }
double sampled_ray_time(double texels) { return 2.5e-8 * texels * std::sqrt(texels); }
double pair_time(double texels) { return 3e-11 * texels * texels; }
double sector_time(double texels) { return 5e-6 * texels; }
double block_table_time(double texels) { return 1e-4 * std::min(texels, 4096.0); }
double node_table_time(double texels) { return 3e-4 * std::min(texels, 1024.0); }
double cone_time(double texels) { return 1.5e-6 * texels; }
double relaxed_time(double texels) { return 1e-10 * texels * texels; }

const BakeParameter c_max{"c_max", 1, 0x1p-20, 16, false, "widest cone: tiles at unit height"};
const BakeParameter bits{"bits", 0,    0,
                         16,     true, "round ratios down to codes of so many bits; 0: no"};
const BakeParameter near_side{
    "near_side", 1, 0, 1, true, "1: heights stand on the near side of a node; 0: on texel centres"};
const BakeParameter steps{"steps", 128, 1, 4096, true, "samples below each texel"};
const BakeParameter slices{"slices", 16, 2, 256, true, "voxels between heights 0 and 1"};
const BakeParameter azimuths{"azimuths", 8, 4, 64, true, "directions"};
const BakeParameter reach{
    "reach", 4,     0,
    64,      false, "tiles to look at, at least, towards other than multiples of 45 degrees"};
const BakeParameter columns{"columns", 64,   1,
                            4096,      true, "blocks along u, or all cells if there are fewer"};
const BakeParameter thick_slices{"slices", 8, 2, 64, true, "slices between heights 0 and 1"};
const BakeParameter directions{
    "directions", 8, 2, 64, true, "ranges of directions along a side of their square"};
const BakeParameter few_columns{"columns", 32,   1,
                                4096,      true, "nodes along u, or all texels if there are fewer"};
const BakeParameter few_slices{"slices", 4, 1, 64, true, "heights of nodes above 0, to 1"};
const BakeParameter direction_nodes{
    "directions", 9, 3, 65, true, "nodes along a side of the square of directions"};
const BakeParameter curvatures{"curvatures", 5, 1, 65, true, "curvatures of the base; 1: none"};
const BakeParameter most_curvature{"curvature", 1,     0x1p-10,
                                   1024,        false, "the greatest of them, in 1 / tile"};
const BakeParameter table_depth{
    "depth", 0.1,   0x1p-10,
    16,      false, "depth of the relief in tiles that directions are spread for"};
const BakeParameter relief_depth{"depth", 0.1, 0, 16, false, "depth of the relief in tiles"};

/// How lengths in the plane and values are to be read.
struct Units {
    const char* field;
    const char* metric;
    const char* rounding;
};

/// A kind in its first version.
BakeKindRow make_row(BakeKind kind, const char* name, const char* text, Units units,
                     std::vector<BakeParameter> parameters, Generator generate, Heights heights,
                     double (*seconds)(double)) {
    return {{kind, name, text, units.field, units.metric, units.rounding, 1, std::move(parameters)},
            generate,
            heights,
            seconds};
}

std::vector<BakeKindRow> pyramid_rows() {
    return {
        make_row(BakeKind::max_mip, "max-mip", "pyramid of the greatest heights of dual cells",
                 {"bilinear", "none", "exact"}, {}, bake_max_mip, Heights::any, linear_time),
        make_row(BakeKind::min_max, "min-max",
                 "pyramid of least and greatest heights of dual cells",
                 {"bilinear", "none", "exact"}, {}, bake_min_max, Heights::any, linear_time),
        make_row(BakeKind::texel_max, "texel-max", "pyramid of the greatest heights of texels",
                 {"block", "none", "exact"}, {}, bake_texel_max, Heights::any, linear_time),
    };
}

std::vector<BakeKindRow> cone_rows() {
    return {
        make_row(BakeKind::cone, "cone", "heights and the widest conservative cones",
                 {"texels", "tile", "down"}, {c_max}, bake_cone, Heights::finite, cone_time),
        make_row(BakeKind::cone_robust, "cone-robust", "conservative cones, least of 3x3",
                 {"texels", "tile", "down"}, {c_max, bits}, bake_cone_robust, Heights::finite,
                 cone_time),
        make_row(BakeKind::cone_quick, "cone-quick", "conservative cones from a pyramid",
                 {"texels", "tile", "down"}, {c_max, near_side}, bake_cone_quick, Heights::finite,
                 logarithmic_time),
        make_row(BakeKind::cone_rabbid, "cone-rabbid",
                 "heights and roots of cones as Rabbid76's shader packs them, 8 bits",
                 {"texels", "tile", "nearest"}, {}, bake_cone_rabbid, Heights::finite, pair_time),
        make_row(BakeKind::cone_cell, "cone-cell", "greatest heights and cones of dual cells",
                 {"bilinear", "tile", "down"}, {c_max}, bake_cone_cell, Heights::finite,
                 logarithmic_time),
        make_row(BakeKind::relaxed_cone, "relaxed-cone", "relaxed cones by 128 samples",
                 {"texels", "tile", "nearest"}, {steps}, bake_relaxed_cone, Heights::finite,
                 relaxed_time),
        make_row(BakeKind::relaxed_cone_exact, "relaxed-cone-exact",
                 "relaxed cones by falling edges", {"texels", "tile", "down"}, {c_max, bits},
                 bake_relaxed_cone_exact, Heights::finite, cone_time),
        make_row(BakeKind::quad_cone, "quad-cone", "cones of four sectors",
                 {"texels", "tile", "down"}, {c_max}, bake_quad_cone, Heights::finite, sector_time),
        make_row(BakeKind::aniso_cone, "aniso-cone", "cones of eight sectors of azimuth",
                 {"texels", "tile", "down"}, {c_max}, bake_aniso_cone, Heights::finite,
                 sector_time),
    };
}

std::vector<BakeKindRow> other_rows() {
    return {
        make_row(BakeKind::distance, "distance", "distance volume by vector sweeps, 8 bits",
                 {"block", "voxel", "down"}, {slices}, bake_distance, Heights::finite,
                 layered_time),
        make_row(BakeKind::distance_exact, "distance-exact",
                 "distance volume that is never too large", {"bilinear", "voxel", "down"}, {slices},
                 bake_distance_exact, Heights::finite, layered_time),
        make_row(BakeKind::horizon, "horizon", "horizons of the bilinear field",
                 {"bilinear", "tile", "up"}, {azimuths, reach}, bake_horizon, Heights::finite,
                 ray_time),
        make_row(BakeKind::horizon_sampled, "horizon-sampled", "horizons by texel samples",
                 {"texels", "tile", "nearest"}, {azimuths, reach}, bake_horizon_sampled,
                 Heights::finite, sampled_ray_time),
        make_row(BakeKind::normal_gather, "normal-gather", "normals by forward differences",
                 {"texels", "tile", "nearest"}, {relief_depth}, bake_normal_gather, Heights::finite,
                 linear_time),
        make_row(BakeKind::normal_4tap, "normal-4tap", "normals by central differences",
                 {"texels", "tile", "nearest"}, {relief_depth}, bake_normal_4tap, Heights::finite,
                 linear_time),
        make_row(BakeKind::normal_sobel, "normal-sobel", "normals by Sobel's kernel",
                 {"texels", "tile", "nearest"}, {relief_depth}, bake_normal_sobel, Heights::finite,
                 linear_time),
        make_row(BakeKind::rmq, "rmq", "range-maximum tables of dual cells",
                 {"bilinear", "none", "exact"}, {}, bake_rmq, Heights::any, table_time),
        make_row(BakeKind::layer_bounds, "layer-bounds",
                 "pyramid of least fronts and greatest backs of depth layers",
                 {"bilinear", "none", "exact"}, {}, bake_layer_bounds, Heights::layers,
                 linear_time),
        make_row(BakeKind::ddm, "ddm", "heights down to which ranges of directions are free",
                 {"bilinear", "tile", "up"}, {columns, thick_slices, directions, table_depth},
                 bake_ddm, Heights::finite, block_table_time),
        make_row(BakeKind::gdm, "gdm", "distances along rays from places, heights and directions",
                 {"bilinear", "none", "nearest"},
                 {few_columns, few_slices, direction_nodes, table_depth}, bake_gdm, Heights::finite,
                 node_table_time),
        make_row(BakeKind::vdm, "vdm", "distances along rays from the top of curved bases",
                 {"bilinear", "none", "nearest"},
                 {few_columns, direction_nodes, curvatures, most_curvature, table_depth}, bake_vdm,
                 Heights::finite, node_table_time),
    };
}

std::vector<BakeKindRow> make_rows() {
    std::vector<BakeKindRow> rows = pyramid_rows();
    for (const BakeKindRow& row : cone_rows()) rows.push_back(row);
    for (const BakeKindRow& row : other_rows()) rows.push_back(row);
    return rows;
}

}  // namespace

const std::vector<BakeKindRow>& bake_rows() {
    static const std::vector<BakeKindRow> rows = make_rows();
    return rows;
}

}  // namespace quadrel
