// What is drawn on both sides: installed scenes of one row each, over maps and angles.
#pragma once

#include <string>
#include <vector>

#include "quadrel/scene/scene.hpp"

namespace quadrel::conformance {

/// A height map with a picture to match; of data/textures.
struct Map {
    const char* name;
    const char* color;
    const char* height;
    const char* normal_height;  ///< for rows that read normals: the map whose alpha is a height
};

const std::vector<Map>& maps();
/// Throws UsageError.
const Map& find_map(const std::string& name);

struct Case {
    std::string row;  ///< an installed scene, without "rows/"
    std::string map;
    int angle = 45;  ///< degrees between the view and the surface's normal
    int size = 256;  ///< pixels a side
};

/// All rows.
std::vector<std::string> all_rows();

/// The row's scene, on that map at that angle, with the renderer's own rules (`hardware`).
Scene scene_of(const Case& what, const std::string& hardware);

/// The preset of `hardware` that is named after a renderer; `exact` for others.
std::string hardware_of(const std::string& renderer);

}  // namespace quadrel::conformance
