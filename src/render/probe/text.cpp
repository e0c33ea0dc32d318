// A probe's report for people: four columns, one per lane, decimal above hex float.
#include <fmt/format.h>

#include "quadrel/probe.hpp"
#include "text/printable.hpp"

namespace quadrel {
namespace {

constexpr int label_width = 26;

std::string hex_float(float x) { return fmt::format("{:a}", x); }

void line(std::string& out, const std::string& label, const std::array<std::string, 4>& cells) {
    out += fmt::format("    {:<{}}", label, label_width);
    for (const std::string& cell : cells) out += fmt::format(" {:>18}", cell);
    while (!out.empty() && out.back() == ' ') out.pop_back();
    out += '\n';
}

template <class Format>
std::array<std::string, 4> cells(const Format& format) {
    return {format(0), format(1), format(2), format(3)};
}

void append(std::string& out, const ProbeValue& value) {
    if (value.integer) {
        line(out, value.name, cells([&](int i) { return fmt::format("{}", value.whole[i]); }));
        return;
    }
    line(out, value.name, cells([&](int i) { return fmt::format("{}", value.real[i]); }));
    line(out, "", cells([&](int i) { return hex_float(value.real[i]); }));
}

void append(std::string& out, const TexelTap& tap) {
    out += fmt::format("          level {} texel ({}, {}) weight {:a} = {}", tap.level, tap.x,
                       tap.y, tap.weight, tap.weight);
    out += fmt::format(": {} {} {} {}{}\n", tap.value[0], tap.value[1], tap.value[2], tap.value[3],
                       tap.border ? " (border)" : "");
}

void append(std::string& out, const ProbeFetch& fetch) {
    for (int lane = 0; lane < 4; ++lane) {
        if (!fetch.active[lane]) continue;
        const LaneFootprint& footprint = fetch.footprint[lane];
        out += fmt::format("      lane {}: {} at ({}, {}) rho {} lambda {} level {} frac {}{}\n",
                           lane, fetch.texture, fetch.u[lane], fetch.v[lane], footprint.lod.rho,
                           footprint.lod.lambda, footprint.lod.level, footprint.lod.frac,
                           footprint.lod.magnified ? " magnified" : "");
        for (const TexelTap& tap : footprint.taps) append(out, tap);
        const auto& value = fetch.value[lane];
        out += fmt::format("          gives {} {} {} {} ({} {} {} {})\n", value[0], value[1],
                           value[2], value[3], hex_float(value[0]), hex_float(value[1]),
                           hex_float(value[2]), hex_float(value[3]));
    }
}

void append(std::string& out, const ProbeStep& step, std::size_t number) {
    out += fmt::format("    step {}\n", number);
    const auto row = [&](const char* label, const std::array<float, 4>& v) {
        line(out, label, cells([&](int i) {
                 return step.active[i] ? fmt::format("{}", v[i]) : std::string("-");
             }));
        line(out, "",
             cells([&](int i) { return step.active[i] ? hex_float(v[i]) : std::string(""); }));
    };
    row("  s", step.s);
    row("  u", step.u);
    row("  v", step.v);
    row("  ray height", step.ray_height);
    row("  map height", step.map_height);
}

void append(std::string& out, const ProbeStage& stage) {
    out += fmt::format("  {}{}\n", stage.id,
                       stage.light >= 0 ? fmt::format(", light {}", stage.light) : "");
    std::size_t next = 0;
    for (std::size_t i = 0; i < stage.steps.size(); ++i) {
        append(out, stage.steps[i], i);
        for (; next < stage.steps[i].fetches_end; ++next) append(out, stage.fetches[next]);
    }
    for (; next < stage.fetches.size(); ++next) append(out, stage.fetches[next]);
    for (const ProbeValue& value : stage.outputs) append(out, value);
}

void append(std::string& out, const ProbeFragment& fragment) {
    out += fmt::format("object {} \"{}\", primitive {}, material \"{}\"\n", fragment.object,
                       printable(fragment.object_name), fragment.primitive,
                       printable(fragment.material));
    line(out, "lane", {"0", "1", "2", "3"});
    line(out, "covered samples",
         cells([&](int i) { return fmt::format("{:#06x}", fragment.covered[i]); }));
    line(out, "visible samples",
         cells([&](int i) { return fmt::format("{:#06x}", fragment.visible[i]); }));
    for (int e = 0; e < 3; ++e)
        line(out, fmt::format("edge {}", e),
             cells([&](int i) { return fmt::format("{}", fragment.edges[e][i]); }));
    line(out, "depth", cells([&](int i) { return fmt::format("{}", fragment.depth[i]); }));
    line(out, "", cells([&](int i) { return hex_float(fragment.depth[i]); }));
    for (const ProbeStage& stage : fragment.stages) append(out, stage);
    out += "  derivatives\n";
    for (const ProbeValue& value : fragment.derivatives) append(out, value);
}

}  // namespace

std::string to_text(const ProbeReport& report) {
    std::string out = fmt::format(
        "image pixel {},{} = window pixel {},{} ({}), lane {} of the quad at {},{}; {} sample{}; "
        "{} on {}\n",
        report.image_x, report.image_y, report.window_x, report.window_y, report.conventions,
        report.lane, report.quad_x, report.quad_y, report.samples, report.samples > 1 ? "s" : "",
        report.number, report.isa);
    if (report.fragments.empty()) out += "nothing covers this quad: background\n";
    for (const ProbeFragment& fragment : report.fragments) append(out, fragment);
    return out;
}

}  // namespace quadrel
