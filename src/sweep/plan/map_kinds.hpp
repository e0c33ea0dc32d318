// Height maps that sweeps make themselves: fields that are hard for one search or another.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace quadrel::sweep {

/// A number that a kind takes.
struct MapParameter {
    std::string_view name, meaning;
    double standard, low, high;
};

using MapValues = std::map<std::string, double>;

/// A kind of map, and how it is made.
struct MapKind {
    std::string_view name, meaning;
    std::string_view format;  ///< of its texels, unless a plan says otherwise
    std::span<const MapParameter> parameters;
    /// Heights of `size` x `size` texels, row by row; all `parameters` are in `values`.
    std::vector<float> (*make)(int size, const MapValues& values);
};

std::span<const MapKind> map_kinds();

/// Null if there is none of that name.
const MapKind* find_map_kind(std::string_view name);

inline constexpr int least_map_side = 8, largest_map_side = 4096;

}  // namespace quadrel::sweep
