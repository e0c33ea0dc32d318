// Where Quadrel's loadable modules lie, the instruction-set kernels and the image reader, and what
// else is installed with the binary that this code was linked into.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace quadrel {

/// Where `inner` ("share/quadrel") of an installation may be, the likeliest first: beside the
/// folder of the executable, as share is beside bin; or, where this code is part of a shared
/// object, such as a module of Python, whose host lies anywhere, in the folder of that object and
/// all above it.
std::vector<std::filesystem::path> installed_near_binary(const std::filesystem::path& inner);

/// The file <name>.so, first found of: $QUADREL_MODULES, the executable's own directory /modules,
/// the installed lib/quadrel near this binary, the build tree's modules, the directory that the
/// build was configured to install to. Nothing if there is none.
std::optional<std::filesystem::path> find_module(const std::string& name);

}  // namespace quadrel
