// Depth layers of a closed mesh: what searches that look behind things read.
#pragma once

#include <functional>
#include <glm/vec3.hpp>

#include "quadrel/film/exr.hpp"
#include "quadrel/scene/mesh.hpp"

namespace quadrel {

/// Twelve depths, three maps of four channels.
inline constexpr int most_solids = 6;

struct DepthLayerOptions {
    int width = 256, height = 256;  ///< texels, 1 to 16384
    glm::dvec3 towards{0, 0, -1};   ///< object space, not null: along it depth grows
    double margin = 1.0 / 16;       ///< tiles that the mesh leaves free on its longer side, < 1/2
    int solids = 2;                 ///< behind each other that are kept, 1 to most_solids
    /// Told from 0 to 1 how much is done, on the calling thread; what it throws ends the work.
    std::function<void(double)> progress = {};
};

/// What a texel is worth, for the material that shows the layers.
struct DepthLayers {
    /// Channels R G B A: front, back, second front, second back, sorted; row 0 first. 0 is where
    /// the mesh is nearest, 1 where it ends. Of more than two solids the third and fourth are in
    /// second.R second.G second.B second.A, the rest in third.R and so on.
    Film film;
    double tile = 0;       ///< length of the square of texture space, object units
    double thickness = 0;  ///< of the relief, object units: depths from 0 to 1
    glm::dvec3 middle{0};  ///< of what is in the layers, object space
    /// Texels under whose centre there are more solids than are kept, the nearest ones.
    std::size_t deeper = 0;
};

/// Peels a mesh: depths where the ray through each texel's centre goes into the mesh and out of it.
/// u grows to the right and v upwards, as one looks along `towards` with y up (z, if that is along
/// y); the mesh lies in the middle of [0, 1]^2, its proportions kept.
///
/// Which triangles a ray meets is decided exactly, for corners rounded to 2^-24 of a texel, each
/// crossing once, however it hits an edge or a corner: so a ray goes out as often as in. Depths are
/// rounded once. Solid is what any of its surfaces encloses (winding number not 0). Where a texel
/// has fewer solids than are kept, the pairs that are left over are without thickness: beside
/// texels that have them, in the middle of these, so that interpolation closes solids between texel
/// centres; elsewhere at the bottom.
///
/// Throws InputError, with the mesh's name, for a mesh that is not closed (every edge must be as
/// often a triangle's as the other way round of another's), has no thickness or no extent.
DepthLayers peel_depth_layers(const Mesh& mesh, const DepthLayerOptions& options = {});

/// Attributes for a file of them: kind, tile, thickness, middle.
Attributes attributes_of(const DepthLayers& layers);

}  // namespace quadrel
