// Chains of materials with relief: up to the search, and from the hit on.
#pragma once

#include "kernels/chain.hpp"
#include "quadrel/quad/stages.hpp"
#include "quadrel/relief/frame/gram.hpp"
#include "quadrel/relief/frame/thesis.hpp"
#include "quadrel/relief/hit/displace.hpp"
#include "quadrel/relief/occlusion/none.hpp"
#include "quadrel/relief/shadow/none.hpp"
#include "quadrel/relief/surface/none.hpp"
#include "quadrel/relief/trace/offset/offset_limit.hpp"
#include "quadrel/shade/lambert.hpp"

namespace quadrel {

using ReliefChains =
    ChainList<Chain<Interpolate, Differentiate, DepthConstant, FrameGram, OffsetLimit, Displace,
                    SurfaceNone, ShadowNone, OcclusionNone, ShadeLambert>,
              Chain<Interpolate, Differentiate, DepthConstant, FrameGram>,
              Chain<Interpolate, Differentiate, DepthConstant, FrameThesis>,
              Chain<Displace, SurfaceNone, ShadowNone, OcclusionNone, ShadeLambert>>;

}  // namespace quadrel
