// quadrel bake --kind depth-layers: depth layers of a mesh.
#pragma once

#include <string>

#include "cli/verbs.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel::cli {

/// The kind's name; it is made of a mesh, not of a height field.
inline constexpr const char* depth_layers_kind = "depth-layers";

struct LayerArguments {
    std::string mesh, output, size = "256x256", towards = "0,0,-1";
    double margin = 1.0 / 16;
    int solids = 2;
    ExrCompression compression = ExrCompression::zip;
    int threads = 0;
};

/// Peels the mesh into the output file and says what the relief's depth in tiles is.
ExitCode bake_layers(const LayerArguments& arguments);

}  // namespace quadrel::cli
