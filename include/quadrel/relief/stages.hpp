// The list of stages. A new algorithm is one header, and one line here.
#pragma once

#include "quadrel/quad/differentiate.hpp"
#include "quadrel/quad/interpolate.hpp"
#include "quadrel/quad/level_of_detail.hpp"
#include "quadrel/relief/frame/gram.hpp"
#include "quadrel/relief/frame/none.hpp"
#include "quadrel/relief/frame/thesis.hpp"
#include "quadrel/relief/shadow/march_thesis.hpp"
#include "quadrel/relief/shadow/march_thesis_published.hpp"
#include "quadrel/relief/shadow/none.hpp"
#include "quadrel/relief/surface/h2n_thesis.hpp"
#include "quadrel/relief/surface/h2n_thesis_published.hpp"
#include "quadrel/relief/surface/none.hpp"
#include "quadrel/relief/trace/displace.hpp"
#include "quadrel/relief/trace/linear.hpp"
#include "quadrel/relief/trace/linear_thesis.hpp"
#include "quadrel/relief/trace/none.hpp"

namespace quadrel {

template <class... Stages>
struct StageList {};

using ReliefStages =
    StageList<Interpolate, Differentiate, LevelOfDetail, FrameNone, FrameThesis, FrameGram,
              TraceNone, Linear, LinearThesis, Displace, SurfaceNone, H2nThesis, H2nThesisPublished,
              ShadowNone, ShadowMarchThesis, ShadowMarchThesisPublished>;

}  // namespace quadrel
