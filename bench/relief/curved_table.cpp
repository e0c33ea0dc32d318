#include "relief/curved_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "bake/direction/relief_ray.hpp"
#include "relief/error_maps.hpp"

namespace quadrel::bench {
namespace {

constexpr int rays = 4000;
/// Of the bases, in 1 / tile: between the nodes of every map.
constexpr double curvatures[] = {-1.3, -0.3, 0.3, 1.3};

const std::vector<std::string> curved_rows{
    "vdm bake.columns=64 bake.directions=17 bake.curvatures=1",
    "vdm bake.columns=64 bake.directions=17 bake.curvatures=3 bake.curvature=2",
    "vdm bake.columns=64 bake.directions=17 bake.curvatures=5 bake.curvature=2",
    "vdm bake.columns=64 bake.directions=17 bake.curvatures=9 bake.curvature=2",
};

struct CurvedFigures {
    double wrong = 0;     ///< per cent: clipped though they meet the relief, or the other way round
    double distance = 0;  ///< mean, in texels, of those that meet it
};

/// How far each ray goes, as s counts; negative if it leaves through the top.
std::vector<double> true_falls(const Fragments& fragments, const HeightPlane& plane,
                               double curvature) {
    std::vector<double> falls;
    for (int lane = 0; lane < rays; ++lane) {
        const double Ku = fragments.real(Value::K, lane, 0), Kv = fragments.real(Value::K, lane, 1);
        ReliefRay ray{};
        ray.x = fragments.real(Value::uv, lane, 0) * texels - 0.5;
        ray.y = fragments.real(Value::uv, lane, 1) * texels - 0.5;
        ray.dx = Ku * texels;
        ray.dy = Kv * texels;
        ray.z = 1;
        ray.bend = curvature / 2 * (Ku * Ku + Kv * Kv) / depth;
        falls.push_back(first_meeting(plane, ray));
    }
    return falls;
}

CurvedFigures measure(Fragments& fragments, const Row& row, const std::vector<double>& falls) {
    CurvedFigures sum;
    fragments.run(row);
    int meet = 0;
    for (int lane = 0; lane < rays; ++lane) {
        const bool meets = falls[std::size_t(lane)] >= 0;
        const bool found =
            fragments.integer(Value::hit_status, lane) == static_cast<int>(Status::hit);
        sum.wrong += meets != found;
        if (!meets || !found) continue;
        const double Ku = fragments.real(Value::K, lane, 0), Kv = fragments.real(Value::K, lane, 1);
        const double u =
            fragments.real(Value::hit_uv, lane, 0) - fragments.real(Value::uv, lane, 0);
        const double v =
            fragments.real(Value::hit_uv, lane, 1) - fragments.real(Value::uv, lane, 1);
        const double shift = std::sqrt(Ku * Ku + Kv * Kv);
        ++meet;
        sum.distance +=
            std::fabs((u * Ku + v * Kv) / shift - falls[std::size_t(lane)] * shift) * texels;
    }
    return {100 * sum.wrong / rays, meet > 0 ? sum.distance / meet : 0};
}

}  // namespace

void print_curved_table() {
    // By row and curvature, a cell for each map.
    struct Line {
        std::string wrong, distance;
        double mebibytes = 0;
    };
    std::vector<Row> rows(curved_rows.begin(), curved_rows.end());
    std::vector<Line> lines(rows.size() * std::size(curvatures));
    SamplerState sampler;
    sampler.mip = MipFilter::none;
    for (const NamedMap& map : error_maps()) {
        const auto texture = make_error_map(map);
        const HeightPlane plane(*texture, sampler);
        Fragments fragments(rays, depth);
        fragments.bind(*texture, sampler);
        auto line = lines.begin();
        for (const Row& row : rows)
            for (const double curvature : curvatures) {
                fragments.curve_base(curvature);
                std::string wrong, distance;
                for (const int angle : angles) {
                    set_rays(fragments, angle);
                    const CurvedFigures figures =
                        measure(fragments, row, true_falls(fragments, plane, curvature));
                    const char* const between = wrong.empty() ? "" : " / ";
                    wrong += between + number(figures.wrong);
                    distance += between + number(figures.distance);
                }
                line->wrong += " " + wrong + " |";
                line->distance += " " + distance + " |";
                line->mebibytes = fragments.baked_mebibytes();
                ++line;
            }
    }
    print_head("curvatures of the map, base");
    auto line = lines.begin();
    for (const Row& row : rows)
        for (const double curvature : curvatures) {
            fmt::print("| {:g}, {:.2g} MiB; {:g} | wrong % |{}\n", row.baking.at("curvatures"),
                       line->mebibytes, curvature, line->wrong);
            fmt::print("| | mean texels |{}\n", line->distance);
            ++line;
        }
}

}  // namespace quadrel::bench
