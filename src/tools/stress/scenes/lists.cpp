#include "stress/scenes/lists.hpp"

#include <fmt/format.h>

#include <functional>

#include "quadrel/num/math.hpp"
#include "quadrel/relief/registry.hpp"
#include "render/plan/shell_check.hpp"
#include "stress/scenes/random_mesh.hpp"

namespace quadrel::stress {
namespace {

using Scenes = std::vector<StressScene>;
using Change = std::function<void(StressScene&)>;

/// One search of each class.
const std::vector<std::string>& classes() {
    static const std::vector<std::string> ids = {"offset-limit",  "linear",    "pom",
                                                 "relief-binary", "cone-step", "relaxed-cone",
                                                 "max-mip",       "qdm",       "oracle-bilinear"};
    return ids;
}

/// Frames that follow the derivatives, and one that follows the vertices.
const std::vector<std::string>& frames() {
    static const std::vector<std::string> ids = {"frame-gram", "frame-thesis", "frame-cot",
                                                 "frame-mikkt"};
    return ids;
}

const MapName smooth{"fractal", 64, 64}, cruel{"noise", 16, 16};

void add(Scenes& scenes, const std::string& name, const MapName& map, double degrees,
         const std::string& trace, const Change& change = {}) {
    StressScene scene = plain_scene(name, map, degrees, trace);
    if (change) change(scene);
    scenes.push_back(std::move(scene));
}

Json& mesh_of(StressScene& scene) { return scene.document["objects"][0]["mesh"]; }

/// E.1: every map under every class of search, and in sizes that wrap onto themselves.
void add_height_maps(Scenes& scenes) {
    for (const auto* kinds : {&map_kinds(), &nan_map_kinds()})
        for (const std::string& kind : *kinds) {
            for (const std::string& trace : classes())
                add(scenes, fmt::format("E.1/{}/{}", kind, trace), {kind, 64, 64}, 60, trace);
            for (const auto& [width, height] : map_sizes())
                add(scenes, fmt::format("E.1/{}-{}x{}", kind, width, height), {kind, width, height},
                    75, width % 2 ? "max-mip" : "relief-binary");
        }
}

/// E.2: angles, and an eye in the wrong place.
void add_views(Scenes& scenes) {
    for (const double degrees : {0.0, 80.0, 85.0, 89.0, 89.9, 89.99, 90.0, 95.0, 180.0})
        for (const std::string& trace : classes())
            for (const std::string& frame : frames())
                add(scenes, fmt::format("E.2/{} degrees/{}/{}", degrees, frame, trace), smooth,
                    degrees, trace, [&](StressScene& s) { relief_of(s)["frame"] = frame; });
    for (const double height : {0.05, 0.0, -0.05, 1e-6, 1e-30})
        for (const double seat : {0.0, 0.5, 1.0})
            add(scenes, fmt::format("E.2/eye at {}, seat {}", height, seat), smooth, 0, "max-mip",
                [&](StressScene& s) {
                    s.document["camera"] = {{"eye", {0, -0.5, height}},
                                            {"target", {0, 0.5, height - 0.1}},
                                            {"near", 1e-3}};
                    relief_of(s)["seat"] = seat;
                });
    for (const char* shape : {"sphere", "icosahedron", "teapot", "torus", "cube"})
        for (const std::string& frame : frames())
            add(scenes, fmt::format("E.2/{}/{}", shape, frame), smooth, 20, "linear",
                [&](StressScene& s) {
                    mesh_of(s) = Json::object({{"shape", shape}});
                    relief_of(s)["frame"] = frame;
                });
    for (const int samples : {1, 4, 16})
        add(scenes, fmt::format("E.2/triangles below a pixel, {} samples", samples), smooth, 30,
            "max-mip", [&](StressScene& s) {
                Random random(1, static_cast<std::uint64_t>(samples));
                s.mesh = tiny_triangles(random, 300);
                mesh_of(s) = Json::object({{"file", s.mesh_file()}});
                s.document["samples"] = samples;
            });
}

/// E.3: maps of texture coordinates.
void add_coordinates(Scenes& scenes) {
    const struct {
        const char* name;
        double a, b, c, d, e, f;
    } maps[] = {{"one to eight", 4, 0, 0, 0, 0.5, 0},
                {"sheared", 0.5, 0.87, 0, 0, 0.5, 0},
                {"turned", 0.35, -0.35, 0, 0.35, 0.35, 0},
                {"mirrored in u", -0.5, 0, 0, 0, 0.5, 0},
                {"mirrored in both", -0.5, 0, 0, 0, -0.5, 0},
                {"a point", 0, 0, 0.3, 0, 0, 0.7},
                {"a line", 0.5, 0, 0, 0.5, 0, 0},
                {"a millionth of a tile", 1e-6, 0, 0.5, 0, 1e-6, 0.5},
                {"1e-38 of a tile", 1e-38, 0, 0, 0, 1e-38, 0},
                {"1e-44 of a tile", 1e-44, 0, 0, 0, 1e-44, 0},
                {"1e5 tiles", 1e5, 0, 0, 0, 1e5, 0},
                {"1e6 tiles", 1e6, 0, 0, 0, 1e6, 0},
                {"offset 1e5", 0.5, 0, 1e5, 0, 0.5, 1e5},
                {"offset 1e9", 0.5, 0, 1e9, 0, 0.5, 1e9},
                {"offset -1e9", 0.5, 0, -1e9, 0, 0.5, -1e9},
                {"offset 1e30", 0.5, 0, 1e30, 0, 0.5, 1e30},
                {"borders of texels", 1.0 / 64, 0, 0, 0, 1.0 / 64, 0},
                {"centres of texels", 1.0 / 64, 0, 1.0 / 128, 0, 1.0 / 64, 1.0 / 128}};
    for (const auto& map : maps)
        for (const std::string& trace : classes())
            for (const std::string& frame : frames()) {
                // A judge needs some microseconds a tile.
                if (map.a >= 1e5 && trace.starts_with("oracle")) continue;
                add(scenes, fmt::format("E.3/{}/{}/{}", map.name, frame, trace), smooth, 45, trace,
                    [&](StressScene& s) {
                        s.mesh = square_with_uv(map.a, map.b, map.c, map.d, map.e, map.f);
                        mesh_of(s) = Json::object({{"file", s.mesh_file()}});
                        relief_of(s)["frame"] = frame;
                    });
            }
}

/// E.4: ends of parameters, formats, wrap modes.
void add_parameters(Scenes& scenes) {
    for (const double depth : {0.0, 1e-44, 1e-30, 1e-6, 20.0, 1e6, 1e12})
        for (const std::string& trace : classes())
            add(scenes, fmt::format("E.4/depth {}/{}", depth, trace), smooth, 60, trace,
                [&](StressScene& s) { relief_of(s)["depth"] = depth; });
    for (const double seat : {0.0, 0.5})
        for (const std::string& trace : classes())
            add(scenes, fmt::format("E.4/seat {}/{}", seat, trace), smooth, 60, trace,
                [&](StressScene& s) { relief_of(s)["seat"] = seat; });
    for (const char* format : {"unorm8", "srgb8", "unorm16", "half", "float"})
        for (const char* filter : {"nearest", "linear", "nearest-mipmap-linear"})
            add(scenes, fmt::format("E.4/{}, {}", format, filter), cruel, 60, "linear",
                [&](StressScene& s) {
                    Json& height = material_of(s)["height"];
                    height["format"] = format;
                    height["min"] = filter;
                    height["mag"] = std::string(filter) == "nearest" ? "nearest" : "linear";
                });
    for (const char* wrap : {"mirrored-repeat", "clamp-to-edge", "clamp-to-border", "mirror-once"})
        for (const std::string& trace : classes())
            add(scenes, fmt::format("E.4/{}/{}", wrap, trace), {"noise", 33, 17}, 80, trace,
                [&](StressScene& s) { material_of(s)["height"]["wrap"] = wrap; });
}

/// Each stage of a room with its defaults, and each parameter at its ends.
void add_stages(Scenes& scenes, const std::string& room, const std::string& key) {
    for (const std::string& id : stage_ids(room)) {
        const auto with = [&](const std::string& name, const Change& change) {
            add(scenes, fmt::format("E.4/{}{}", id, name), cruel, 70, "linear",
                [&](StressScene& s) {
                    Json& place = key == "shade" ? material_of(s)[key] : relief_of(s)[key];
                    place = Json{{"id", id}};
                    if (room == "trace") place = id;
                    if (change) change(s);
                });
        };
        with("", {});
        for (const ParameterText& parameter : find_stage(id)->parameters)
            for (const double end : {parameter.minimum, parameter.maximum}) {
                if (parameter.integer && end > 65536) continue;
                with(fmt::format(", {} {}", parameter.name, end), [&](StressScene& s) {
                    if (room == "trace")
                        relief_of(s)[parameter.name] = end;
                    else if (key == "shade")
                        material_of(s)[key][parameter.name] = end;
                    else
                        relief_of(s)[key][parameter.name] = end;
                });
            }
    }
}

/// E.5: lights at the zenith, the horizon, below, along walls, inside of the slab.
void add_lights(Scenes& scenes) {
    const auto towards = [](double x, double y, double z) {
        return Json::object({{"type", "directional"}, {"direction_to_light", {x, y, z}}});
    };
    const auto at = [](double x, double y, double z) {
        return Json::object({{"type", "point"}, {"position", {x, y, z}}});
    };
    const std::vector<std::pair<const char*, Json>> lights = {
        {"zenith", towards(0, 0, 1)},           {"horizon", towards(1, 0, 0)},
        {"just above", towards(1, 0, 1e-6)},    {"below", towards(0.3, 0, -1)},
        {"along the wall", towards(0, 1, 0.2)}, {"in the slab", at(0, 0, -0.02)},
        {"in the plane", at(0, 0, 0)},          {"far", at(1e18, 0, 1e18)},
        {"very far", at(1e30, 0, 1e30)}};
    for (auto [name, light] : lights)
        for (const std::string& shadow : stage_ids("shadow"))
            for (const char* map : {"wall-x", "fractal"})
                add(scenes, fmt::format("E.5/{}/{}/{}", name, shadow, map), {map, 64, 64}, 0,
                    "max-mip", [&](StressScene& s) {
                        light["space"] = "world";
                        s.document["lights"] = Json::array({light});
                        relief_of(s)["shadow"] = shadow;
                    });
}

/// Everything larger or smaller, and far from the origin.
void add_scales(Scenes& scenes) {
    for (const double scale : {1e-20, 1e-15, 1e-10, 1e-5, 1e5, 1e10, 1e15, 1e20})
        for (const std::string& frame : stage_ids("frame"))
            add(scenes, fmt::format("E.2/scale {}/{}", scale, frame), smooth, 45, "max-mip",
                [&](StressScene& s) {
                    scale_scene(s, scale);
                    relief_of(s)["frame"] = frame;
                });
    for (const double far : {1e3, 1e5, 1e7, 1e9})
        for (const std::string& frame : stage_ids("frame"))
            add(scenes, fmt::format("E.2/{} from the origin/{}", far, frame), smooth, 45, "max-mip",
                [&](StressScene& s) {
                    move_scene(s, far);
                    relief_of(s)["frame"] = frame;
                });
}

/// The searches of shells.
std::vector<std::string> shell_searches() {
    std::vector<std::string> ids;
    for (const StageInfo& stage : all_stages())
        if (stage.text.room == std::string_view("trace") && is_of_shells(stage.text.id))
            ids.emplace_back(stage.text.id);
    return ids;
}

/// Shells over meshes: thin, thicker than the mesh, around the eye, over a surface without area.
void add_shells(Scenes& scenes) {
    const auto shell = [&](const std::string& name, const std::string& trace,
                           const Change& change) {
        add(scenes, fmt::format("E.6/{}/{}", name, trace), cruel, 30, trace, [&](StressScene& s) {
            const std::string frame(frame_of_search(trace));
            relief_of(s)["frame"] = frame;
            if (frame.ends_with("@published")) relief_of(s)["seat"] = 0;
            relief_of(s)["surface"] = "h2n-patch";
            relief_of(s)["frag_depth"] = "frag-depth";
            if (change) change(s);
        });
    };
    for (const std::string& trace : shell_searches()) {
        for (const char* shape : {"quad", "sphere", "torus", "teapot", "cube"})
            for (const double depth : {0.0, 1e-30, 0.1, 5.0, 1e3})
                shell(fmt::format("{}, depth {}", shape, depth), trace, [&](StressScene& s) {
                    mesh_of(s) = Json::object({{"shape", shape}});
                    relief_of(s)["depth"] = depth;
                    if (!trace.ends_with("@published")) relief_of(s)["seat"] = 0.5;
                });
        for (const double height : {0.05, 0.0, -0.05, -0.2})
            shell(fmt::format("eye at {}", height), trace, [&](StressScene& s) {
                s.document["camera"] = {
                    {"eye", {0, -0.5, height}}, {"target", {0, 0.5, height - 0.1}}, {"near", 1e-3}};
            });
        for (const double scale : {1e-15, 1e-5, 1e5, 1e15})
            shell(fmt::format("scale {}", scale), trace,
                  [&](StressScene& s) { scale_scene(s, scale); });
        for (const double far : {1e3, 1e6})
            shell(fmt::format("{} from the origin", far), trace,
                  [&](StressScene& s) { move_scene(s, far); });
    }
}

}  // namespace

std::vector<StressScene> listed_scenes() {
    Scenes scenes;
    add_height_maps(scenes);
    add_views(scenes);
    add_scales(scenes);
    add_coordinates(scenes);
    add_parameters(scenes);
    for (const char* room : {"frame", "trace", "surface", "shadow", "clip", "occlusion", "shade"})
        add_stages(scenes, room, room);
    add_stages(scenes, "frag-depth", "frag_depth");
    add_lights(scenes);
    add_shells(scenes);
    for (std::size_t i = 0; i < scenes.size(); ++i) scenes[i].number = i;
    return scenes;
}

}  // namespace quadrel::stress
