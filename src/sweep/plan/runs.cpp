#include "sweep/plan/runs.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "quadrel/num/math.hpp"
#include "quadrel/relief/registry.hpp"
#include "text/shell_word.hpp"
#include "texture/texel_format.hpp"

namespace quadrel::sweep {
namespace {

using Json = nlohmann::ordered_json;

/// Of the camera in degrees: small, so that the angle between view and normal is nearly the same
/// everywhere, and smaller where the quad would otherwise reach behind the eye.
double field_of_view(double angle) { return angle <= 80 ? 4.0 : 0.4 * (90 - angle); }

double radians(double degrees) { return degrees * 0.017453292519943295; }

double tangent(double x) { return sin(x) / cos(x); }

/// A quad that fills the frame at this angle, and a little more; seen from the front a unit of
/// length, which is one tile of the maps, is as high as the frame.
void append_quad(const View& view, double aspect, std::vector<std::string>& overrides) {
    const double angle = *view.angle, fov = field_of_view(angle);
    const double half = radians(fov / 2), distance = 0.5 / tangent(half);
    const double side =
        2.04 * distance * sin(half) / cos(radians(angle) + half) * (aspect > 1 ? aspect : 1);
    overrides.push_back("camera=" + Json{{"type", "perspective"},
                                         {"fov_y", fov},
                                         {"eye", {0, 0, distance}},
                                         {"target", {0, 0, 0}}}
                                        .dump());
    const Json mesh{{"shape", "quad"}, {"size", side}};
    const Json turn{{"rotate", -angle}, {"axis", {1, 0, 0}}};
    overrides.push_back("objects=" +
                        Json::array({Json{{"mesh", mesh}, {"transform", {turn}}}}).dump());
    overrides.push_back("material.texture_matrix=" + Json{{"scale", {side, side}}}.dump());
}

/// The names of enum class Wrap, in its order.
constexpr const char* wrap_names[] = {"repeat", "mirrored-repeat", "clamp-to-edge",
                                      "clamp-to-border", "mirror-once"};

const char* name_of(Wrap wrap) { return wrap_names[static_cast<std::size_t>(wrap)]; }

const char* name_of(TexelFormat format) {
    for (const auto& [name, value] : named_formats)
        if (value == format) return name.data();
    return "float";
}

/// A texture of level 0 alone.
Json finest_texture(const std::filesystem::path& file) {
    return {{"file", file.string()}, {"mip", "none"}, {"min", "linear"}};
}

std::vector<std::string> common_overrides(const Plan& plan, const Run& run,
                                          const std::string& heights) {
    std::vector<std::string> overrides = plan.scenes[run.scene].overrides;
    if (!heights.empty()) overrides.push_back(heights);
    const View& view = plan.views[run.view];
    if (view.angle) append_quad(view, double(plan.width) / plan.height, overrides);
    overrides.push_back(fmt::format("size=[{},{}]", plan.width, plan.height));
    if (plan.samples != 1) overrides.push_back(fmt::format("samples={}", plan.samples));
    return overrides;
}

}  // namespace

std::vector<Run> runs_of(const Plan& plan) {
    std::vector<Run> runs;
    for (std::size_t scene = 0; scene < plan.scenes.size(); ++scene)
        for (std::size_t map = 0; map < plan.maps.size(); ++map)
            for (std::size_t view = 0; view < plan.views.size(); ++view)
                for (std::size_t algorithm = 0; algorithm < plan.algorithms.size(); ++algorithm)
                    for (const std::string& number : plan.numbers)
                        for (const std::string& isa : plan.isas)
                            for (const int threads : plan.threads)
                                runs.push_back({scene, map, view, algorithm, number, isa, threads});
    return runs;
}

std::vector<Run> runs_of_task(const std::vector<Run>& all, int task, int of) {
    std::vector<Run> runs;
    for (std::size_t i = static_cast<std::size_t>(task - 1); i < all.size();
         i += static_cast<std::size_t>(of))
        runs.push_back(all[i]);
    return runs;
}

std::string height_override(const PlannedMap& map, const std::filesystem::path& file) {
    Json texture = finest_texture(file);
    texture["swizzle"] = "r";
    texture["wrap"] = map.wrap;
    if (!map.format.empty()) texture["format"] = map.format;
    if (map.kind == "nan") texture["allow_nan"] = true;
    return "material.height=" + texture.dump();
}

std::string height_override(const TextureReference& own) {
    Json texture = finest_texture(std::filesystem::absolute(own.file));
    if (!own.selection.layer.empty()) texture["layer"] = own.selection.layer;
    if (!own.selection.part.empty()) texture["part"] = own.selection.part;
    if (!own.swizzle.empty()) texture["swizzle"] = own.swizzle;
    if (own.srgb) texture["colour_space"] = "srgb";
    if (own.format) texture["format"] = name_of(*own.format);
    texture["flip_v"] = own.flip_v;
    texture["allow_nan"] = own.allow_nan;
    texture["wrap"] = {name_of(own.sampler.wrap_u), name_of(own.sampler.wrap_v)};
    if (own.sampler.mag == Filter::nearest) texture["mag"] = "nearest";
    texture["border"] = own.sampler.border;
    return "material.height=" + texture.dump();
}

std::vector<std::string> overrides_of(const Plan& plan, const Run& run, const std::string& heights,
                                      const std::filesystem::path& normal_file) {
    std::vector<std::string> overrides = common_overrides(plan, run, heights);
    if (!normal_file.empty())
        overrides.push_back("material.normal=" +
                            Json{{"file", normal_file.string()}, {"format", "float"}}.dump());
    const Algorithm& algorithm = plan.algorithms[run.algorithm];
    overrides.push_back("material.relief.trace=" + algorithm.trace);
    // What is not asked for is the row's own, whatever the scene's file has for its search.
    for (const ParameterText& text : find_stage(algorithm.trace)->parameters) {
        const auto given = algorithm.parameters.find(text.name);
        const ParameterValue value =
            given == algorithm.parameters.end() ? text.default_value : given->second;
        overrides.push_back(std::string("material.relief.") + text.name + "=" +
                            (value.name() ? *value.name() : Json(*value.number()).dump()));
    }
    return overrides;
}

std::string render_command(const Plan& plan, const Run& run,
                           const std::vector<std::string>& overrides) {
    std::string line = "quadrel render " + shell_word(plan.scenes[run.scene].file_or_name.string());
    for (const std::string& assignment : overrides) line += " -D " + shell_word(assignment);
    if (run.number != "float") line += " --number " + run.number;
    if (run.isa != "auto") line += " --isa " + run.isa;
    return line;
}

}  // namespace quadrel::sweep
