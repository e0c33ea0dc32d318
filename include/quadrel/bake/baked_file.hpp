// Baked maps as EXR files: float32, each level a part of its own ("level0", "level1", ...; a single
// level has no part name), the channels Y, R G or R G B A; of maps of several layers "000.Y",
// "001.Y" and so on. Attributes quadrel:bake.* say what the map is and what it was derived from.
#pragma once

#include <filesystem>

#include "quadrel/bake/bake.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel {

/// Writes a map that bake() made from these arguments, whole or not at all. Throws OutputError.
void write_baked(const std::filesystem::path& file, const Texture& map, const Texture& height,
                 BakeKind kind, const SamplerState& sampler, const BakeOptions& options = {},
                 const ExrWriting& writing = {});

/// Reads a map for a height field, a sampler and a kind. Throws InputError for a file that is no
/// baked map, is damaged, or was derived from other heights, for other wrap modes, for another
/// kind or by another version: a map of the wrong field would be wrong without anyone noticing.
/// `key` is where a scene names the file, for the message.
std::shared_ptr<const Texture> load_baked(const std::filesystem::path& file, BakeKind kind,
                                          const SamplerState& sampler, const Texture& height,
                                          const std::string& key = "");

}  // namespace quadrel
