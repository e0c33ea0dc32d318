// Chains of materials without relief.
#pragma once

#include "kernels/chain.hpp"
#include "quadrel/quad/stages.hpp"
#include "quadrel/relief/frame/none.hpp"
#include "quadrel/relief/hit/displace.hpp"
#include "quadrel/relief/occlusion/none.hpp"
#include "quadrel/relief/shadow/none.hpp"
#include "quadrel/relief/surface/none.hpp"
#include "quadrel/relief/trace/offset/none.hpp"
#include "quadrel/shade/lambert.hpp"
#include "quadrel/shade/texture.hpp"

namespace quadrel {

/// Lit by the cosine, or by nothing, as a whole; any other lighting up to itself.
using PlainChains =
    ChainList<Chain<Interpolate, Differentiate, FrameNone, TraceNone, Displace, SurfaceNone,
                    ShadowNone, OcclusionNone, ShadeLambert>,
              Chain<Interpolate, Differentiate, FrameNone, TraceNone, Displace, ShadeTexture>,
              Chain<Interpolate, Differentiate, FrameNone, TraceNone, ShadeTexture>,
              Chain<Interpolate, Differentiate, FrameNone, TraceNone, Displace, SurfaceNone,
                    ShadowNone, OcclusionNone>>;

}  // namespace quadrel
