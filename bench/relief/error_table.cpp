// quadrel-relief-errors [ROW]...: how late and how early searches are on the bilinear field, and
// what they cost, as a Markdown table. A ROW is an id and parameters: "linear steps=32". Without
// rows, a choice of all classes; --tables: tables by direction; --curved: see curved_table.hpp.
//
// 4000 random rays a figure, in double, over maps of 128 x 128 texels that repeat, a tenth of a
// tile deep, at 45, 70 and 85 degrees, level 0, against texel-exact. "Late" and "early": further
// than one texel beyond or before the first hit, measured in the plane.
#include <fmt/format.h>

#include <cmath>
#include <exception>

#include "quadrel/error.hpp"
#include "relief/curved_table.hpp"
#include "relief/error_maps.hpp"

namespace quadrel::bench {
namespace {

constexpr int rays = 4000;

const std::vector<std::string> standard_rows{
    "linear steps=32",
    "linear steps=128",
    "pom steps_grazing=32 steps_normal=32",
    "relief-binary steps=15 binary_steps=6",
    "cone-rabbid",
    "cone-step",
    "cone-robust",
    "cone-robust-exact",
    "relaxed-cone",
    "relaxed-cone@published",
    "relaxed-cone-exact",
    "texel-exact",
    "max-mip",
    "cone-cell",
    "rmq-leap",
    "ddm",
};

/// Tables by direction, at some resolutions.
const std::vector<std::string> table_rows{
    "ddm bake.columns=32 bake.slices=4 bake.directions=8",
    "ddm bake.columns=64 bake.slices=8 bake.directions=8",
    "ddm bake.columns=128 bake.slices=8 bake.directions=8",
    "ddm bake.columns=64 bake.slices=8 bake.directions=16",
    "gdm bake.columns=32 bake.slices=4 bake.directions=9",
    "gdm bake.columns=64 bake.slices=4 bake.directions=9",
    "gdm bake.columns=128 bake.slices=4 bake.directions=9",
    "gdm bake.columns=64 bake.slices=8 bake.directions=9",
    "gdm bake.columns=64 bake.slices=4 bake.directions=17",
    "vdm bake.columns=32 bake.directions=9 bake.curvatures=1",
    "vdm bake.columns=64 bake.directions=9 bake.curvatures=1",
    "vdm bake.columns=128 bake.directions=9 bake.curvatures=1",
    "vdm bake.columns=64 bake.directions=17 bake.curvatures=1",
    "vdm bake.columns=64 bake.directions=33 bake.curvatures=1",
};

/// Per cent late and early, mean distance in texels, look-ups per ray, memory of baked maps where
/// the row says how they are baked.
struct Figures {
    double late = 0, early = 0, distance = 0, fetches = 0, mebibytes = 0;
};

Figures measure(Fragments& fragments, const Row& row, const std::vector<double>& truth) {
    Figures sum;
    fragments.run(row);
    for (int lane = 0; lane < rays; ++lane) {
        const double Ku = fragments.real(Value::K, lane, 0), Kv = fragments.real(Value::K, lane, 1);
        const double by = (fragments.real(Value::hit_s, lane) - truth[std::size_t(lane)]) *
                          std::sqrt(Ku * Ku + Kv * Kv) * texels;
        sum.late += by > 1;
        sum.early += by < -1;
        sum.distance += std::fabs(by);
        sum.fetches += fragments.integer(Value::hit_fetches, lane);
    }
    return {100 * sum.late / rays, 100 * sum.early / rays, sum.distance / rays, sum.fetches / rays,
            row.baking.empty() ? 0 : fragments.baked_mebibytes()};
}

/// One cell of the table: a figure at all angles.
std::string cell(const std::vector<Figures>& figures, double Figures::*figure) {
    std::string text;
    for (const Figures& f : figures) text += (text.empty() ? "" : " / ") + number(f.*figure);
    return text;
}

/// Without the lines that are all zero.
void print_row(const std::string& name, const std::vector<std::vector<Figures>>& a_map) {
    const std::pair<const char*, double Figures::*> lines[] = {{"late %", &Figures::late},
                                                               {"early %", &Figures::early},
                                                               {"mean texels", &Figures::distance},
                                                               {"look-ups", &Figures::fetches}};
    const double mebibytes = a_map.at(0).at(0).mebibytes;
    const std::string memory = mebibytes > 0 ? fmt::format(", {:.2g} MiB", mebibytes) : "";
    bool first = true;
    for (const auto& [title, figure] : lines) {
        std::string cells;
        bool zero = true;
        for (const auto& figures : a_map) {
            cells += fmt::format(" {} |", cell(figures, figure));
            for (const Figures& f : figures) zero &= number(f.*figure) == "0";
        }
        if (zero) continue;
        fmt::print("| {} | {} |{}\n", first ? "`" + name + "`" + memory : "", title, cells);
        first = false;
    }
}

void print_table(const std::vector<Row>& rows) {
    print_head("search");
    std::vector<std::vector<std::vector<Figures>>> all(rows.size());
    SamplerState sampler;
    sampler.mip = MipFilter::none;
    const Row exact("texel-exact");
    for (const NamedMap& map : error_maps()) {
        const auto texture = make_error_map(map);
        Fragments fragments(rays, depth);
        fragments.bind(*texture, sampler);
        for (auto& row : all) row.emplace_back();
        for (const int angle : angles) {
            set_rays(fragments, angle);
            fragments.run(exact);
            std::vector<double> truth;
            for (int lane = 0; lane < rays; ++lane)
                truth.push_back(fragments.real(Value::hit_s, lane));
            for (std::size_t i = 0; i < rows.size(); ++i)
                all[i].back().push_back(measure(fragments, rows[i], truth));
        }
    }
    for (std::size_t i = 0; i < rows.size(); ++i) print_row(rows[i].text, all[i]);
}

}  // namespace
}  // namespace quadrel::bench

int main(int argc, char** argv) {
    using namespace quadrel;
    try {
        std::vector<std::string> texts(argv + 1, argv + argc);
        if (texts.empty()) texts = bench::standard_rows;
        if (texts == std::vector<std::string>{"--curved"}) {
            bench::print_curved_table();
            return 0;
        }
        if (texts == std::vector<std::string>{"--tables"}) texts = bench::table_rows;
        std::vector<bench::Row> rows;
        for (const std::string& text : texts) rows.emplace_back(text);
        bench::print_table(rows);
    } catch (const UsageError& error) {
        fmt::print(stderr, "quadrel-relief-errors: {}\n", error.what());
        return static_cast<int>(ExitCode::usage);
    } catch (const std::exception& error) {
        fmt::print(stderr, "quadrel-relief-errors: {}\n", error.what());
        return static_cast<int>(ExitCode::input);
    }
    return 0;
}
