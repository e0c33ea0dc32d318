// Writing grids as image files, rounded to the texel format that a scene declares for them, so that
// loading rounds nothing. All throw std::runtime_error (or what OpenEXR throws) on failure.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "grid.hpp"

namespace quadrel::textures {

/// One channel Y, 32-bit float, each value k / 65535. Heights are clamped to [0, 1].
void write_height(const std::filesystem::path& file, const Grid<double>& height);

/// R G B linear light, A opacity, as half; colours first rounded to 8-bit sRGB codes, alpha to
/// c / 255, which half holds precisely enough to find the code again.
void write_colour(const std::filesystem::path& file, const Grid<glm::dvec4>& colour);

/// R G B data in [0, 1], each rounded to c / 255, as half.
void write_data(const std::filesystem::path& file, const Grid<glm::dvec3>& data);

/// R G B linear radiance, unbounded, as half.
void write_radiance(const std::filesystem::path& file, const Grid<glm::dvec3>& radiance);

/// R G B tangent-space normal as n * 0.5 + 0.5, rounded to c / 255; A height, k / 65535; float.
void write_normal_height(const std::filesystem::path& file, const Grid<glm::dvec4>& texels);

/// The first 2 (R G) or 4 (R G B A) depths of each texel in [0, 1], each k / 65535; float.
void write_depths(const std::filesystem::path& file, int channels, const Grid<glm::dvec4>& depths);

/// 16-bit grey PNG.
void write_height_png(const std::filesystem::path& file, const Grid<double>& height);

/// 8-bit sRGB-encoded RGB PNG; alpha is dropped.
void write_colour_png(const std::filesystem::path& file, const Grid<glm::dvec4>& colour);

}  // namespace quadrel::textures
