// What the vertex programs of a material's stages give, by Quadrel's own arithmetic: with the bits
// that the stages interpolate.
#pragma once

#include "export/table.hpp"

namespace quadrel::recorded {

/// Runs them, and hands on what they give. Throws RecordingError where one does what is not known
/// here.
void put_vertex_values(const VertexRun& run);

}  // namespace quadrel::recorded
