// The recipes: each writes one family of textures (height, colour, gloss, ...).
#pragma once

#include <filesystem>
#include <span>

namespace quadrel::textures {

struct Recipe {
    const char* name;
    void (*write)(const std::filesystem::path& directory);
};

std::span<const Recipe> recipes();

void write_bricks(const std::filesystem::path& directory);
void write_calibration(const std::filesystem::path& directory);
void write_city(const std::filesystem::path& directory);
void write_dunes(const std::filesystem::path& directory);
void write_layers(const std::filesystem::path& directory);
void write_mip_levels(const std::filesystem::path& directory);
void write_obstacles(const std::filesystem::path& directory);
void write_sky(const std::filesystem::path& directory);
void write_spikes(const std::filesystem::path& directory);
void write_stones(const std::filesystem::path& directory);
void write_text(const std::filesystem::path& directory);

}  // namespace quadrel::textures
