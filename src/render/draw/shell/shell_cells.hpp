// The rows of a shell's tetrahedra, each with its neighbours (quadrel/relief/shell/shell_cell.hpp).
#pragma once

#include <vector>

#include "quadrel/relief/shell/shell_cell.hpp"
#include "render/draw/shell.hpp"

namespace quadrel {

/// Three per triangle of the mesh, in its order; rows of neighbours are counted from `first` on.
/// Those without volume are no one's neighbours.
std::vector<ShellCell> shell_cells(const Shell& shell, const Mesh& mesh, std::int32_t first);

}  // namespace quadrel
