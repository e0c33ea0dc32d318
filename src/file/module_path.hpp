// Where Quadrel's loadable modules lie: the instruction-set kernels and the image reader.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace quadrel {

/// The file <name>.so, first found of: $QUADREL_MODULES, the executable's own directory /modules,
/// the installed lib/quadrel beside the executable's directory, the build tree's modules, the
/// directory that the build was configured to install to. Nothing if there is none.
std::optional<std::filesystem::path> find_module(const std::string& name);

}  // namespace quadrel
