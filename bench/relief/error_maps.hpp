// The maps and the rays over them of which searches' errors are told, and how tables are written.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "relief/fragments.hpp"

namespace quadrel::bench {

/// Texels a side of maps, the relief's depth in tiles, degrees between views and the normal.
inline constexpr int texels = 128;
inline constexpr double depth = 0.1;
inline constexpr int angles[] = {45, 70, 85};

/// Heights by texel, that repeat.
struct NamedMap {
    const char* name;
    std::function<double(int x, int y)> height;
};
const std::vector<NamedMap>& error_maps();
std::shared_ptr<const Texture> make_error_map(const NamedMap& map);

/// Rays from anywhere in any direction at an angle.
void set_rays(Fragments& fragments, double degrees);

/// Two digits; 0 below 0.005.
std::string number(double x);
/// "| first | | fractal | ... |", and the line under it.
void print_head(const std::string& first);

}  // namespace quadrel::bench
