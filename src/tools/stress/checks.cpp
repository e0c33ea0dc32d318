#include "stress/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "quadrel/compare.hpp"
#include "quadrel/error.hpp"
#include "quadrel/quad/value.hpp"
#include "quadrel/relief/registry.hpp"
#include "quadrel/render.hpp"
#include "quadrel/scene/load.hpp"
#include "stress/affordable.hpp"
#include "stress/departure.hpp"
#include "stress/planted.hpp"
#include "stress/scenes/listings.hpp"

namespace quadrel::stress {
namespace {

/// Tiles that a ray may pass before it takes too long to judge: some microseconds each.
constexpr float most_tiles = 100;

/// The most that a ray of the film passes; of rays that are not finite none.
float tiles_on_the_way(const Film& film) {
    float most = 0;
    for (const char* channel : {"K.U", "K.V"}) {
        const Plane& plane = *film.find(channel);
        for (std::size_t i = 0; i < plane.bits.size(); ++i)
            if (const float tiles = std::abs(plane.as_float(i)); std::isfinite(tiles))
                most = std::max(most, tiles);
    }
    return most;
}

/// What all renders of a scene have in common.
struct Drawn {
    std::optional<Window> window;
    bool judged = false;
};

RenderOptions options_for(const char* number, const char* isa, const Drawn& drawn) {
    RenderOptions options;
    options.window = drawn.window;
    options.channels = plain_channels();
    if (drawn.judged)
        options.channels.insert(options.channels.end(),
                                {"oracle", "certified", "certified.reason"});
    options.number = number;
    options.isa = isa;
    options.threads = 1;
    return options;
}

bool follows_listing(const Scene& scene) {
    const Material& m = scene.materials.front();
    for (const StageChoice* choice : {&m.frame, &m.trace, &m.surface, &m.shadow, &m.shade})
        if (is_listing(choice->id)) return true;
    return false;
}

std::string stages_of(const Scene& scene) {
    const Material& material = scene.materials.front();
    return material.frame.id + " " + material.trace.id;
}

/// The stage that stores what a channel shows.
std::string stage_behind(const Scene& scene, const std::string& channel) {
    const Material& material = scene.materials.front();
    const auto starts = [&](const char* prefix) { return channel.starts_with(prefix); };
    if (starts("uv") || starts("dUV") || starts("dP") || starts("exact.dUV") ||
        starts("exact.dP") || starts("P.") || starts("Ng") || starts("bary") || starts("lod") ||
        channel == "depth" || starts("id"))
        return "geometry";
    if (starts("oracle") || starts("certified")) return "oracle";
    if (starts("hit")) return material.trace.id;
    if (starts("N.")) return material.surface.id;
    if (starts("shadow")) return material.shadow.id;
    if (channel.size() == 1 || starts("light"))
        return channel == "r" || channel == "K" ? material.frame.id : material.shade.id;
    return material.frame.id;
}

bool covers(const Film& film, std::size_t i) { return film.find("hit.status")->bits[i] != 0; }

/// The first channel in the data flow that is NaN at a pixel, of those that have one anywhere.
void find_nan(const Film& film, const Scene& scene, const char* number,
              std::vector<Finding>& findings) {
    const Plane* first = nullptr;
    std::size_t at = 0;
    for (const Plane& plane : film.planes) {
        if (plane.type != ChannelType::float32) continue;
        const auto nan = std::find(plane.bits.begin(), plane.bits.end(), canonical_nan);
        if (nan == plane.bits.end()) continue;
        if (first != nullptr && data_flow_rank(plane.name) >= data_flow_rank(first->name)) continue;
        first = &plane;
        at = static_cast<std::size_t>(nan - plane.bits.begin());
    }
    if (first == nullptr) return;
    const auto width = static_cast<std::size_t>(film.window.width());
    const std::string stage = stage_behind(scene, first->name);
    // An implementation's interpolation overflows where the implementation's does.
    const bool as_listed = follows_listing(scene) ||
                           (stage == "geometry" &&
                            hardware_model(scene.hardware).interpolation != Interpolation::exact);
    findings.push_back({as_listed ? Finding::of_listing : "NaN",
                        fmt::format("{} of {}", first->name, stage),
                        fmt::format("{}, pixel {},{}, status {}", number, at % width, at / width,
                                    film.find("hit.status")->bits[at])});
}

/// Why a pixel's status cannot be; empty if it can.
std::string unexplained(const Film& film, std::size_t i, const StressScene& stress,
                        const Scene& scene) {
    const auto status = static_cast<Status>(film.find("hit.status")->bits[i]);
    const float s = film.find("hit.s")->as_float(i);
    const std::string& trace = scene.materials.front().trace.id;
    const bool corrected = !is_listing(trace) && !is_offset(trace);
    switch (status) {
        case Status::none:
            return "";
        case Status::hit:
            return corrected && !(s >= -1e-3f && s <= 1.001f) ? fmt::format("HIT at s = {}", s)
                                                              : "";
        case Status::floor:
            return corrected && !(std::abs(s - 1) <= 1e-3f) ? fmt::format("FLOOR at s = {}", s)
                                                            : "";
        case Status::cap:
        case Status::clip:
        case Status::outside:
        case Status::no_frame:
            return "";
        case Status::nan:
            return stress.has_nan || follows_listing(scene) ? ""
                                                            : "NAN without a NaN among the texels";
    }
    return fmt::format("status {}", static_cast<int>(status));
}

void check_statuses(const Film& film, const StressScene& stress, const Scene& scene,
                    const char* number, SceneResult& result) {
    std::set<std::string> told;
    const auto width = static_cast<std::size_t>(film.window.width());
    for (std::size_t i = 0; i < film.window.area(); ++i) {
        const std::string text = unexplained(film, i, stress, scene);
        if (text.empty()) continue;
        const std::string where = text.substr(0, text.find(" at ")) + ", " + stages_of(scene);
        if (told.insert(where).second)
            result.findings.push_back(
                {"status", where,
                 fmt::format("{}, pixel {},{}: {}", number, i % width, i / width, text)});
    }
}

void count_pixels(const Film& film, SceneResult& result) {
    for (std::size_t i = 0; i < film.window.area(); ++i) {
        ++result.statuses[film.find("hit.status")->bits[i]];
        if (!covers(film, i)) continue;
        ++result.fragments;
        if (result.judged) result.certified += film.find("certified")->bits[i] != 0;
    }
}

/// Two films that must be one.
void expect_same(const Film& a, const Film& b, const std::string& what, const Scene& scene,
                 SceneResult& result) {
    for (const Plane& plane : a.planes) {
        const Plane* other = b.find(plane.name);
        if (other == nullptr || other->bits == plane.bits) continue;
        const auto at = std::mismatch(plane.bits.begin(), plane.bits.end(), other->bits.begin());
        result.findings.push_back({"other bits",
                                   fmt::format("{}: {} of {}", what, plane.name, stages_of(scene)),
                                   fmt::format("{:#x} for {:#x}", *at.second, *at.first)});
        return;
    }
}

/// Exact derivatives, where the stages run on duals.
void check_duals(const Scene& scene, const StressScene& stress, const Drawn& drawn,
                 SceneResult& result) {
    const StageInfo* trace = find_stage(scene.materials.front().trace.id);
    const auto& types = trace->number_types;
    const bool dual = std::find(types.begin(), types.end(), "dual") != types.end();
    RenderOptions options = options_for("float", "scalar", {drawn.window});
    options.channels = {"exact.dUVdx", "exact.dUVdy", "exact.dPdx", "derr.dPdy", "hit.status"};
    if (dual) options.channels.insert(options.channels.end(), {"exact.dhitUVdx", "exact.dhitUVdy"});
    const Film film = render(scene, options);
    if (!stress.has_nan) find_nan(film, scene, "dual", result.findings);
}

/// What a message is about, without numbers and names.
std::string gist(const std::string& message) {
    std::string text = message.substr(message.rfind('/') + 1);
    for (char& c : text)
        if (c >= '0' && c <= '9') c = '#';
    return text.substr(0, 160);
}

/// The same bits by lanes and without shortcuts; and duals.
void draw_otherwise(const Scene& scene, const StressScene& stress, std::uint64_t sample,
                    const Drawn& drawn, const Film& single, const Film& lanes,
                    SceneResult& result) {
    expect_same(single, lanes, "lanes", scene, result);
    if (sample % 4 == 0) {
        RenderOptions everything = options_for("float", "auto", drawn);
        everything.skip = false;
        expect_same(single, render(scene, everything), "no-skip", scene, result);
    }
    if (sample % 2 == 0) check_duals(scene, stress, drawn, result);
}

void draw_all(const Scene& scene, const StressScene& stress, const CheckOptions& options,
              SceneResult& result) {
    plant_fault(stress);
    Drawn drawn;
    if (!stress.measured_only) drawn.window = affordable_window(scene, options.look_ups);
    if (drawn.window)
        result.left_out =
            static_cast<std::uint64_t>(scene.width) * static_cast<std::uint64_t>(scene.height) -
            drawn.window->area();
    Film single = render(scene, options_for("float", "scalar", drawn));
    drawn.judged = result.judged = tiles_on_the_way(single) <= most_tiles;
    if (drawn.judged) single = render(scene, options_for("float", "scalar", drawn));
    Film lanes = stress.measured_only ? single : render(scene, options_for("float", "auto", drawn));
    plant_error(stress, single, lanes);
    count_pixels(single, result);
    if (!stress.measured_only)
        draw_otherwise(scene, stress, options.sample, drawn, single, lanes, result);
    const Film exact = render(scene, options_for("double", "scalar", drawn));
    const auto look = [&](const Film& film, const char* number) {
        check_statuses(film, stress, scene, number, result);
        if (!stress.has_nan) find_nan(film, scene, number, result.findings);
    };
    look(single, "float");
    look(exact, "double");
    if (result.judged) result.departures.push_back(departure(single, exact, scene));
}

}  // namespace

SceneResult check_scene(const std::filesystem::path& folder, const StressScene& scene,
                        const CheckOptions& options) {
    SceneResult result;
    try {
        draw_all(load_scene(folder / "scene.json"), scene, options, result);
    } catch (const InputError& error) {
        result.refused = true;
        result.refusal = gist(error.what());
    } catch (const UsageError& error) {
        result.refused = true;
        result.refusal = gist(error.what());
    } catch (const std::exception& error) {
        result.findings.push_back({"unexpected", gist(error.what()), error.what()});
    }
    return result;
}

}  // namespace quadrel::stress
