// Meshes that are hard on coverage and on derivatives, as OBJ.
#pragma once

#include <string>

#include "stress/scenes/random.hpp"

namespace quadrel::stress {

/// A square of side 2 or less in random triangles, whose texture coordinates are a random map of
/// the place: tiles, sheared, mirrored, far from 0, constant along a direction or everywhere, on
/// borders of texels. `wild`, 0 to 1, is how far from ordinary.
std::string random_mesh(Random& random, double wild);

/// `count` triangles, each a thousandth of the square.
std::string tiny_triangles(Random& random, int count);

/// The square, its texture coordinates by (x, y) -> (a x + b y + c, d x + e y + f).
std::string square_with_uv(double a, double b, double c, double d, double e, double f);

}  // namespace quadrel::stress
