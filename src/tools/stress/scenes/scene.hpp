// A scene of the stress test: its document, and the mesh file that goes with it.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "stress/scenes/maps.hpp"

namespace quadrel::stress {

using Json = nlohmann::ordered_json;

struct StressScene {
    std::string name;          ///< "E.1/impulse-16x16/linear" or "random/17"
    std::uint64_t number = 0;  ///< among the listed or the random ones
    Json document;             ///< a scene file; maps and mesh lie beside it
    std::string mesh;          ///< an OBJ file's text, or empty
    bool has_nan = false;      ///< whether what it reads holds NaN or infinities

    bool measured_only = false;  ///< by floats and doubles; neither lanes nor duals nor all steps
    std::string planted;         ///< the finding that an error planted in it must give; mostly none

    std::string mesh_file() const { return "mesh.obj"; }
};

/// Writes scene.json, its mesh and the maps that it names into a folder, to be rendered from there.
void write_scene(const std::filesystem::path& folder, const StressScene& scene);

/// The ids of a room that scenes may choose from, in the registry's order, without those of oracles
/// if `judges` is false, and without those of shells.
std::vector<std::string> stage_ids(const std::string& room, bool judges = true);

/// A texture that reads one of our maps.
Json texture_of(const MapName& map);

/// A square of side 2 under `map`, seen at `degrees` by frame-gram and `trace`: what every scene of
/// the lists is a variation of.
StressScene plain_scene(const std::string& name, const MapName& map, double degrees,
                        const std::string& trace);

/// Makes a plain scene larger, camera, light and relief with it.
void scale_scene(StressScene& scene, double factor);
/// Moves square and camera along x and y.
void move_scene(StressScene& scene, double distance);

/// The relief of the only material.
inline Json& relief_of(StressScene& scene) {
    return scene.document["materials"]["stress"]["relief"];
}
inline Json& material_of(StressScene& scene) { return scene.document["materials"]["stress"]; }

}  // namespace quadrel::stress
