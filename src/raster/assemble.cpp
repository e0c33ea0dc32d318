#include "quadrel/raster/assemble.hpp"

namespace quadrel {
namespace {

VertexWeights vertex_weights(const ClipVertex& vertex, const std::array<glm::vec4, 3>& clip) {
    return {vertex.weight, window_linear_weights(vertex, clip)};
}

void count(SetupOutcome outcome, PrimitiveCounts& counts) {
    switch (outcome) {
        case SetupOutcome::drawn:
            ++counts.drawn;
            break;
        case SetupOutcome::zero_area:
            ++counts.zero_area;
            break;
        case SetupOutcome::culled:
            ++counts.culled;
            break;
        case SetupOutcome::off_frame:
            ++counts.off_frame;
            break;
    }
}

void count(ClipStatus status, PrimitiveCounts& counts) {
    ++counts.submitted;
    counts.non_finite += status == ClipStatus::non_finite;
    counts.outside += status == ClipStatus::outside;
    counts.clipped += status == ClipStatus::clipped;
}

}  // namespace

PrimitiveCounts& PrimitiveCounts::operator+=(const PrimitiveCounts& other) {
    submitted += other.submitted;
    non_finite += other.non_finite;
    outside += other.outside;
    clipped += other.clipped;
    zero_area += other.zero_area;
    culled += other.culled;
    off_frame += other.off_frame;
    drawn += other.drawn;
    return *this;
}

void assemble_triangle(const std::array<glm::vec4, 3>& clip, const RasterState& state,
                       std::vector<AssembledTriangle>& out, PrimitiveCounts& counts) {
    const ClippedPolygon polygon = clip_triangle(clip, state.viewport);
    count(polygon.status, counts);
    for (int i = 1; i + 1 < polygon.count; ++i) {
        const ClipVertex* corner[3] = {&polygon.vertex[0], &polygon.vertex[i],
                                       &polygon.vertex[i + 1]};
        AssembledTriangle piece;
        const SetupOutcome outcome = set_up_triangle(
            {corner[0]->position, corner[1]->position, corner[2]->position}, state, piece.screen);
        count(outcome, counts);
        if (outcome != SetupOutcome::drawn) continue;
        for (int k = 0; k < 3; ++k) piece.weights[k] = vertex_weights(*corner[k], clip);
        piece.clipped = polygon.status == ClipStatus::clipped;
        out.push_back(piece);
    }
}

}  // namespace quadrel
