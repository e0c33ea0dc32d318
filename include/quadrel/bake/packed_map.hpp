// Cone maps in the channels that their authors pack them in, for programs that read these.
#pragma once

#include <filesystem>

#include "quadrel/bake/bake.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel {

enum class Packing : std::int32_t {
    /// "dummer": height in red, the square root of the ratio in green, blue 0. Source: Dummer,
    /// "Cone
    /// Step Mapping", 2006.
    height_sqrt_cone,
    /// "gg3": the normal's x and y as 0.5 + 0.5 n in red and green (normal_4tap, depth 0.1; y with
    /// the other sign than there, since the source's shader negates what it reads), the ratio in
    /// blue, depth in alpha: the top is black. Source: Policarpo, Oliveira, GPU Gems 3, chapter 18.
    normal_cone_depth,
    /// "dummer" for BakeKind::cone_rabbid, whose maps hold the root already: the very codes that
    /// its
    /// source stores, whatever the rounding.
    height_root,
};

enum class PackRounding : std::int32_t {
    conservative,  ///< heights up, ratios down: every cone lies in the one that was packed
    nearest,       ///< as published
};

/// Whether maps of a kind hold what a packing takes: {height, ratio} a texel, or {height, root}.
bool is_packable(BakeKind kind, Packing packing);

/// Writes a map of {height, ratio} or {height, root} texels: 8 bits per channel if the file's name
/// ends in .png, float32 if in .exr. Heights and ratios are cut to [0, 1]. Throws OutputError,
/// UsageError for a map that does not hold {height, ratio} a texel of `height`, and for other
/// names.
void write_packed(const std::filesystem::path& file, const Texture& map, const Texture& height,
                  const SamplerState& sampler, Packing packing,
                  PackRounding rounding = PackRounding::conservative,
                  const ExrWriting& writing = {});

/// A packed file's contents, as a height field and as a map of what the packing takes. What field,
/// wrap mode and generator they are of, the file does not say. Throws InputError.
struct PackedMap {
    std::shared_ptr<const Texture> height, cones;
};
PackedMap load_packed(const std::filesystem::path& file, Packing packing,
                      const std::string& key = "");

/// By the names above, for maps of a kind. Throws UsageError.
Packing packing_from_name(std::string_view name, BakeKind kind = BakeKind::cone);

}  // namespace quadrel
