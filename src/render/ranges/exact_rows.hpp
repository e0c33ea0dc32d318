// Which rows exact interpolation reads, whatever planes hardware makes of them.
#pragma once

#include "quadrel/quad/stage.hpp"
#include "render/draw/geometry.hpp"

namespace quadrel {

/// By the pieces that triangles have been cut into, whose vertices the edges belong to.
inline void interpolate_exactly(StageCall& call, const Geometry& geometry) {
    call.planes = nullptr;
    const PrimitiveRows& pieces = geometry.pieces;
    if (pieces.data.empty()) return;
    call.primitives = pieces.data.data();
    if (!pieces.frames.empty()) call.frames = pieces.frames.data();
    if (!pieces.vertices.empty()) call.vertices = pieces.vertices.data();
}

}  // namespace quadrel
