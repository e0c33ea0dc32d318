// Whether chunks of DWA-compressed EXR files hold all that their decoder goes on to use.
#pragma once

#include "io/exr/context.hpp"

namespace quadrel {

/// Throws std::runtime_error if a chunk of the rows y0 to y1 - 1 holds less, or more, than its
/// channels need: OpenEXR's decoder (3.1) would go on with what lay in memory before.
void check_dwa_chunks(const ExrContext& context, int y0, int y1);

}  // namespace quadrel
