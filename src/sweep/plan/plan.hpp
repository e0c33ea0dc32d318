// What a sweep measures: scenes x maps x views x algorithms x how they are run.
#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "quadrel/scene/parameter_value.hpp"

namespace quadrel::sweep {

/// A scene and what is changed in it before anything else.
struct PlannedScene {
    std::string name;                    ///< in tables
    std::filesystem::path file_or_name;  ///< as load_scene takes it; relative to the plan
    std::vector<std::string> overrides;  ///< "key=value"
};

/// Where the camera is: the scene's own, or at an angle before a quad that fills the frame.
struct View {
    std::optional<double> angle;  ///< degrees between view and normal; none: the scene's camera
    std::string name() const;     ///< "45", or "camera"
};

using Parameters = std::map<std::string, ParameterValue>;

/// One search with one set of values.
struct Algorithm {
    std::string trace;  ///< a stage's id
    Parameters parameters;
    /// Frames per second that were published for it, by angle; see `published_on` of the plan.
    std::map<double, double> published;

    /// "linear steps=256".
    std::string name() const;
};

/// A height map: the scene's own, a file's, or one that is made.
struct PlannedMap {
    enum class Source { scene, file, made };
    Source source = Source::scene;
    std::string name;            ///< in tables
    std::filesystem::path file;  ///< of Source::file
    std::string kind;            ///< of Source::made: one of map_kinds.hpp
    int size = 0;                ///< texels a side; 0: not known before the map is read
    std::map<std::string, double> parameters;
    std::string format;  ///< as scenes have it; empty: the file's own
    std::string wrap = "repeat";
};

/// The scene's own.
inline PlannedMap scene_map() {
    PlannedMap map;
    map.name = "scene";
    return map;
}

/// How thumbnails of the page are made.
struct PictureSettings {
    int side = 96;               ///< pixels
    int most = 320;              ///< runs that get any
    std::vector<double> angles;  ///< empty: the steepest of the plan
};

struct Plan {
    std::filesystem::path file;
    std::string title;
    std::vector<PlannedScene> scenes;
    std::vector<PlannedMap> maps;
    std::vector<View> views;
    std::vector<Algorithm> algorithms;
    int width = 256, height = 256;  ///< of every frame, pixels
    int samples = 1;                ///< a pixel
    std::vector<std::string> numbers{"float"};
    std::vector<std::string> isas{"auto"};
    std::vector<int> threads{1};
    int repeats = 5;
    /// No drawing is repeated once those of its run have taken so long.
    double repeat_seconds = std::numeric_limits<double>::infinity();
    double wrong_texels = 0.5;  ///< further from the true hit than this is late, or early
    std::string published_on;   ///< what the published figures were measured on; may be empty
    PictureSettings pictures;
};

/// Reads a plan: JSON with comments, every key checked. Throws InputError with file, line, key,
/// what was found and what was expected.
Plan read_plan(const std::filesystem::path& file);

}  // namespace quadrel::sweep
