// Baked maps by need: from memory, from the disk cache, or made.
//
// The cache is the folder quadrel/baked in $XDG_CACHE_HOME, or in ~/.cache: a file an entry, named
// by baked_id, with a checksum that is verified. A damaged or foreign entry is made anew. At most
// QUADREL_CACHE_MIB MiB (default 1024, 0: no cache); what was used longest ago goes first. A cache
// that cannot be written is no error, unless the caller wants the map to be kept.
#pragma once

#include "quadrel/bake/bake.hpp"

namespace quadrel {

struct BakedTextureOptions : BakeOptions {
    BakedTextureOptions() { seconds_limit = 20; }

    bool disk = true;  ///< read and write the disk cache
    /// For this process alone: no disk cache, and the map's id is made of the height map's, not of
    /// its texels, of which a hash takes as long as a pyramid.
    bool in_memory = false;
    bool must_keep = false;  ///< a map that the disk cache cannot keep is an OutputError
    /// Told why the disk cache, being asked for and not switched off, does not keep the map.
    std::function<void(const std::string& reason)> not_kept;
    /// For the refusal: the heights as arguments of `quadrel bake`, and where a scene asks for
    /// them.
    std::string input = "HEIGHTMAP", key;
};

/// Whether a map of the kind is made in less time than it takes to read it again: a pyramid.
bool is_quick_to_bake(BakeKind kind);

/// The map that bake() gives for the same arguments (under another id if `in_memory`). While
/// someone holds it, memory has it once. May be called from several threads; one bakes at a time.
/// Throws as bake() does, but for BakeStopped: a map that is in no cache and takes longer than
/// seconds_limit is an InputError that names the command that bakes it; at once where even easy
/// heights of this size would take several times that long. UsageError if QUADREL_CACHE_MIB is not
/// a number.
std::shared_ptr<const Texture> baked_texture(const Texture& height, BakeKind kind,
                                             const SamplerState& sampler,
                                             const BakedTextureOptions& options = {});

}  // namespace quadrel
