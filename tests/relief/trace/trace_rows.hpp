// What each offset and march promises, as data: the properties of trace_properties_test.cpp and the
// vectors of march_rows_test.cpp are driven by this table.
#pragma once

#include "relief/surface_rays.hpp"

namespace quadrel::test {

enum class TraceKind {
    offset,   ///< one or more shifts, no search
    march,    ///< the first sample of a lattice that is at or below the surface
    refined,  ///< a march, and a closer look at its last step; or one in steps that are safe
};

/// A trace at parameters for which its lattice is known.
struct TraceRow {
    std::string id;
    TraceKind kind;
    Parameters parameters{};
    /// Steps over the depth seen straight down; the least number at any angle.
    int lattice = 0, least_lattice = 0;
    /// March and refined: how far from the one crossing there is, in s, early and late.
    double early = 0, late = 0;
    bool ends_below = true;        ///< a hit is at or below the surface
    bool exact_on_planes = false;  ///< finds the crossing with a planar height field
    double gap = 0;                ///< how far above the surface a hit may be
    bool may_cap = false;          ///< may give up above the surface
    bool takes_nan = true;         ///< its baked maps, if any, can be made of NaN
    bool by_points = true;         ///< tests points of the ray, not cells
};

/// Corrected rows, 16 steps and more.
inline std::vector<TraceRow> trace_rows() {
    using enum TraceKind;
    const Parameters by_angle = {{"steps_grazing", 16}, {"steps_normal", 16}};
    const double step = 1.0 / 16;
    std::vector<TraceRow> rows = {
        {"parallax", offset, {}},
        {"parallax-bias", offset, {}},
        {"offset-limit", offset, {}},
        {"offset-limit-042", offset, {}},
        {"offset-limit-fixed", offset, {}},
        {"parallax-slope-nz", offset, {}},
        {"parallax-slope-nv", offset, {}},
        {"linear", march, {{"steps", 16}}, 16, 16, 0, step},
        {"height-outward", march, {{"points", 16}}, 16, 16, 0, step},
        {"steep", march, {{"steps", 8}}, 8, 8, 0, 2 * step},
        {"steep-constant-xy", march, {{"min_steps", 16}, {"max_steps", 100}}, 16, 16, 0, step},
        {"steep-adaptive", march, by_angle, 16, 16, 0, step},
        {"steep-adaptive-rabbid",
         march,
         {{"quality_normal", 0.33}, {"quality_grazing", 0.33}},
         16,
         16,
         0,
         step},
        {"steep-quality", march, {{"quality", 0}}, 16, 16, 0, step},
        {"steep-mip-c", march, {{"steps", 16}}, 16, 16, 0, step},
        {"steep-mip-i", march, {{"steps", 16}}, 16, 16, 0, step},
    };
    const std::vector<TraceRow> closer = {
        {"pom", refined, by_angle, 16, 16, step / 2, step / 2, false, true},
        {"relief-binary", refined, {{"steps", 16}, {"binary_steps", 8}}, 16, 16, 0, step / 256},
        {"secant", refined, {{"steps", 16}, {"iterations", 4}}, 16, 16, 1e-4, 1e-4, false, true},
        {"interval", refined, {{"steps", 16}, {"iterations", 4}}, 16, 16, 3e-3, 3e-3, false, true},
        {"contact", refined, {{"steps", 16}, {"fine_steps", 16}}, 16, 16, 0, step / 16},
        {"contact",
         refined,
         {{"steps", 16}, {"fine_steps", 16}, {"interpolate", 1}},
         16,
         16,
         step / 16,
         step / 16,
         false,
         true},
        {"thesis-linear-binary", refined, {{"binary_steps", 16}}, 16, 1, 0, 1.0 / 65536},
        {.id = "thesis-sphere",
         .kind = refined,
         .parameters = {{"steps", 4000}},
         .early = 1.0 / 512,
         .gap = 1.0 / 1024,
         .may_cap = true},
    };
    rows.insert(rows.end(), closer.begin(), closer.end());
    // By cones between texel centres: within a gap of the surface, or bisected.
    for (const char* id : {"cone-step", "cone-quad", "cone-aniso"})
        rows.push_back({.id = id,
                        .kind = refined,
                        .parameters = {{"steps", 400}},
                        .early = 1.0 / 512,
                        .late = 1.0 / 64,
                        .gap = 1.0 / 1024,
                        .may_cap = true,
                        .takes_nan = false});
    for (const char* id : {"cone-robust", "relaxed-cone", "relaxed-cone-exact", "cone-hybrid"})
        rows.push_back({.id = id,
                        .kind = refined,
                        .parameters = {{"steps", 400}, {"binary_steps", 16}},
                        .early = 1.0 / 2048,
                        .late = 1.0 / 64,
                        .gap = 1.0 / 2048,
                        .may_cap = true,
                        .takes_nan = false});
    for (const char* id : {"texel-exact", "max-mip", "rmq-leap", "cone-cell", "ddm",
                           "cone-robust-exact", "oracle-bilinear"})
        rows.push_back({.id = id,
                        .kind = refined,
                        .early = 1e-5,
                        .late = 1e-5,
                        .exact_on_planes = true,
                        .takes_nan = std::string_view(id).substr(0, 4) != "cone" &&
                                     std::string_view(id) != "ddm",
                        .by_points = false});
    return rows;
}

/// The id with its parameters, for messages.
inline std::string name_of(const TraceRow& row) {
    std::string name = row.id;
    for (const auto& [key, value] : row.parameters) name += " " + key + "=" + std::to_string(value);
    return name;
}

}  // namespace quadrel::test
