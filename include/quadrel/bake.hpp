// Baked maps: textures that are derived from a height field before a search can use it. The heights
// are channel 0 of level 0; the wrap modes of the sampler (and its border colour's first component)
// say how the field goes on, and a map baked for one wrap mode is wrong under another. Lengths in
// the plane are in units of one tile (u and v each run from 0 to 1 over the texture), heights as
// stored, so a ratio of the two is what the same map means whatever its resolution.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "quadrel/texture/texture.hpp"

namespace quadrel {

enum class BakeKind : std::int32_t {
    /// One channel. Level 0: the greatest corner height of each stored dual cell (cell_grid of
    /// relief/cells.hpp); each level above: the maximum of 2x2 nodes, sizes rounded up, to 1x1.
    /// Node n of level l holds cells n << l to (n + 1 << l) - 1; periodic axes do not wrap inside.
    /// Source: Tevs, Ihrke, Seidel, "Maximum Mipmaps for Fast, Accurate, and Scalable Dynamic
    /// Height Field Rendering", I3D 2008.
    max_mip,
    /// Two channels, least and greatest, laid out as max_mip.
    min_max,
    /// One channel, the same pyramid over texels (texel_grid) instead of cells. Sources: Oh, Ki,
    /// Lee, "Pyramidal Displacement Mapping", VRST 2006; Drobot, "Quadtree Displacement Mapping
    /// with Height Blending", GPU Pro, 2010.
    texel_max,
};

/// A number that steers a kind.
struct BakeParameter {
    const char* name;
    double standard, low, high;  ///< what it is unless given; allowed range, inclusive
    bool whole;                  ///< only whole numbers
    const char* text;            ///< one line
};

struct BakeKindInfo {
    BakeKind kind;
    const char* name;      ///< as in `quadrel bake --kind`
    const char* text;      ///< one line
    const char* field;     ///< what surface the map describes: "bilinear", "texels" or "block"
    const char* rounding;  ///< where values are rounded: "up", "down", "nearest", or "exact"
    std::vector<BakeParameter> parameters;
};

/// All kinds, in the order of the enumeration.
const std::vector<BakeKindInfo>& bake_kinds();
const BakeKindInfo& bake_kind_info(BakeKind kind);
/// Throws UsageError for an unknown name, with the nearest known one.
BakeKind bake_kind_from_name(std::string_view name);

struct BakeOptions {
    std::map<std::string, double> parameters;  ///< by name; the others have their standard value
    int threads = 0;                           ///< 0: one a core. The result is the same
    /// Called with the finished part, in (0, 1], never decreasing; from any thread, one at a time.
    std::function<void(double)> progress;
};

/// Derives a map. Its id() is baked_id().
/// Throws UsageError for parameters that the kind has not or that are out of range, InputError for
/// a map that would be too large, and, for kinds that measure slopes, for heights that are NaN or
/// infinite (pyramids have NaN wherever a NaN is below).
std::shared_ptr<const Texture> bake(const Texture& height, BakeKind kind,
                                    const SamplerState& sampler, const BakeOptions& options = {});

/// SHA-256 over the height texture's id, the kind and the version of its generator, wrap modes,
/// border height and parameters: everything that decides about the values.
std::string baked_id(const Texture& height, BakeKind kind, const SamplerState& sampler,
                     const BakeOptions& options = {});

/// How long a bake of this size takes at most on one core, roughly.
double bake_seconds_estimate(BakeKind kind, int width, int height);

}  // namespace quadrel
