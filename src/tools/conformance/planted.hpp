// Errors planted into an exported scene, as ports have them: each must be found.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gl/scene/manifest.hpp"

namespace quadrel::conformance {

struct PlantedError {
    std::string name;
    /// False where the scene has nothing of the kind.
    std::function<bool(gl::ExportedScene&)> plant;
};

const std::vector<PlantedError>& planted_errors();

}  // namespace quadrel::conformance
