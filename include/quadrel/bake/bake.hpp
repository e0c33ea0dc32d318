// Baked maps: textures that are derived from a height field before a search can use it. The heights
// are channel 0 of level 0; the wrap modes of the sampler (and its border colour's first component)
// say how the field goes on, and a map baked for one wrap mode is wrong under another. Lengths in
// the plane are in units of one tile (u and v each run from 0 to 1 over the texture), heights as
// stored, so a ratio of the two is what the same map means whatever its resolution.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
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

    // Cone maps over texels: {height, ratio} a texel of the texture. The ratio is the radius, in
    // tiles, that the cone has at unit height over its apex (the texel's centre at its height), at
    // most the parameter c_max. Between texel centres nothing is promised: bilinear look-ups can
    // read wider cones than either texel has, and the field can pierce a cone between centres.

    /// The widest cone that no texel's centre is inside of, by brute force. Source: Dummer, "Cone
    /// Step Mapping", 2006.
    cone,
    /// The same, then the least of 3x3, then rounded down to `bits` bits. Source: Ban, Valasek,
    /// Balint, Vad, "Robust Cone Step Mapping", EGSR 2024.
    cone_robust,
    /// Never wider than `cone`, from a pyramid. Source: Valasek, Ban, "Quick Cone Map Generation on
    /// the GPU", EG 2022.
    cone_quick,
    /// {height, root}: the square root of a ratio of at most 1, both rounded to 8 bits (a code over
    /// 255), bit for bit what the source's compute shader stores. Heights are cut to [0, 1] and
    /// rounded to 8 bits before. The field repeats whatever the wrap modes; rings are circles in
    /// texels, so that maps other than square are wrong. Source: Rabbid76, graphics-snippets,
    /// "Parallax Mapping", Cone Step Mapping.
    cone_rabbid,
    /// {M, ratio} a stored dual cell (cell_grid), to be fetched by cell: M is the cell's greatest
    /// height, ratio the least of distance / (M' - M) over all higher cells, the distance between
    /// the cells' rectangles in tiles, 0 where cells touch. Exact for the bilinear field.
    cone_cell,
    /// Rays from above pierce the field at most once inside of the cone, by point samples. Source:
    /// Policarpo, Oliveira, "Relaxed Cone Stepping for Relief Mapping", GPU Gems 3, chapter 18.
    relaxed_cone,
    /// Relaxed cones from falling edges, then the least of 3x3 and `bits`. Source: Ban et al. 2024.
    relaxed_cone_exact,
    /// Four ratios a texel, for offsets mostly towards -u, +u, -v, +v. Source: GPU Gems 3,
    /// chapter 18.
    quad_cone,
    /// Eight ratios a texel in two layers of four channels: sector k, channel k % 4 of layer k / 4,
    /// holds azimuths from 45 k to 45 (k + 1) degrees, from +u towards +v in tile units.
    aniso_cone,

    // Distance volumes: `slices` layers of one channel; layer k is about height (k + 1/2) / slices.
    // Distances in voxels (cubes, one texel wide) divided by `slices`.

    /// As published: vector sweeps, 8 bits. Source: Donnelly, GPU Gems 2, chapter 8.
    distance,
    /// Never above the distance to the bilinear field or to the blocks, trilinear look-ups
    /// included; may be negative near the surface, where it is to be read as 0.
    distance_exact,

    // Horizons: `azimuths` layers of one channel, the tangent of the horizon's elevation (heights
    // and tiles being of one length) towards 360 k / azimuths degrees from +u towards +v.

    /// Over the bilinear field, from texel centres, rounded up; exact towards multiples of 45
    /// degrees, otherwise as far as `reach` tiles. Source: Max, "Horizon mapping", 1988.
    horizon,
    /// From the nearest texels at texel steps.
    horizon_sampled,

    // Normals: rgb 0.5 + 0.5 n, n = normalize(-depth dh/du, -depth dh/dv, 1), alpha the height.

    normal_gather,  ///< forward differences of 2x2 texels: the slopes at the texel's far corner
    normal_4tap,    ///< central differences
    normal_sobel,   ///< Sobel's 3x3

    /// Layer b * (A + 1) + a, A = floor(log2(columns)): maximum over the 2^a x 2^b dual cells from
    /// (i, j) on, i and j stored cells. Source: Thonat et al., "RMIP", SIGGRAPH Asia 2023.
    rmq,

    /// Of depth layers, not of heights: all channels, a front and the back behind it in pairs;
    /// channels that the map lacks are 1, the bottom. Four channels, laid out as max_mip: the least
    /// front and the greatest back of each pair, of cells where the pair has any thickness; 2 and
    /// -1 where none has.
    layer_bounds,
    // Tables of directions, `slices` layers of one channel: quadrel/relief/direction_table.hpp says
    // how they lie. At most 512 MiB.

    /// The height down to which every ray is free that starts in a block of stored dual cells
    /// (cell_grid), a slice of heights and a range of directions: the directions are those of
    /// `directions` x `directions` equal squares. Level 1: for every direction. After Mehra, Kumar,
    /// "Accurate and Efficient Rendering of Detail using Directional Distance Maps", ICVGIP 2012.
    ddm,
    /// The distance to the bilinear field along a ray, in lengths of its way from height 1 to 0,
    /// from the middles of blocks of stored texels (texel_grid), heights (k + 1) / slices, towards
    /// `directions` x `directions` nodes of the square, those of its border included; 0 inside of
    /// the relief. Level 1: the least. Source: Wang, Tong, Lin, Hu, Guo, Shum, "Generalized
    /// Displacement Maps", EGSR 2004.
    gdm,
    /// The same from the top alone, with a layer for each of `curvatures` curvatures of the base
    /// along the ray from -`curvature` to `curvature`, in 1 / tile, above 0 where the base bends
    /// away; -1 where the ray leaves through the top. Source: Wang, Wang, Tong, Lin, Hu, Guo, Shum,
    /// "View-Dependent Displacement Mapping", SIGGRAPH 2003.
    vdm,
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
    const char* metric;    ///< of lengths in the plane: "tile", "voxel", or "none"
    const char* rounding;  ///< of values: "up", "down", "nearest" or "exact"
    int version;           ///< of the generator; raised whenever it gives other values
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
    /// Wall time after which a bake stops: BakeStopped.
    double seconds_limit = std::numeric_limits<double>::infinity();
};

/// A bake that took longer than it might.
struct BakeStopped : std::runtime_error {
    explicit BakeStopped(double share) : std::runtime_error("a bake took too long"), done(share) {}

    double done;  ///< part of the work that was finished, 0 to 1
};

/// Derives a map. Its id() is baked_id().
/// Throws UsageError for parameters that the kind has not or that are out of range, InputError for
/// a map that would be too large and, for kinds that measure slopes, for heights that are NaN or
/// infinite (pyramids have NaN wherever a NaN is below), BakeStopped after seconds_limit.
std::shared_ptr<const Texture> bake(const Texture& height, BakeKind kind,
                                    const SamplerState& sampler, const BakeOptions& options = {});

/// Whether a kind is made of depth layers instead of heights: of all channels.
bool bakes_layers(BakeKind kind);

/// SHA-256 over size and heights: what a map is derived from, whatever file, channel or format the
/// heights came in.
std::string height_id(const Texture& height);

/// SHA-256 over height_id (of layers: all channels), the kind and the version of its generator,
/// wrap modes, border height and parameters: everything that decides about the values.
std::string baked_id(const Texture& height, BakeKind kind, const SamplerState& sampler,
                     const BakeOptions& options = {});

/// How long a bake of this size takes on one core, roughly, where the heights are easy: those of a
/// wall of bricks. Others take many times as long.
double bake_seconds_estimate(BakeKind kind, int width, int height);

}  // namespace quadrel
