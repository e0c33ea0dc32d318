// Where coverage depends on how vertices are snapped.
#pragma once

#include <cstddef>
#include <set>
#include <string>

#include "quadrel/scene/scene.hpp"

namespace quadrel::conformance {

/// Pixels of the scene's frame, row by row, whose centre some edge may pass where its vertices snap
/// otherwise, as `limits` permits.
std::set<std::size_t> pixels_beside_edges(const Scene& scene, const std::string& limits);

}  // namespace quadrel::conformance
