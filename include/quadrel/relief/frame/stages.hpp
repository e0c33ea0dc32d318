// The list of frames; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/frame/cot.hpp"
#include "quadrel/relief/frame/cot_published.hpp"
#include "quadrel/relief/frame/face.hpp"
#include "quadrel/relief/frame/gram.hpp"
#include "quadrel/relief/frame/impostor.hpp"
#include "quadrel/relief/frame/inverse_tbn.hpp"
#include "quadrel/relief/frame/inverse_tbn_published.hpp"
#include "quadrel/relief/frame/mikkt.hpp"
#include "quadrel/relief/frame/none.hpp"
#include "quadrel/relief/frame/thesis.hpp"
#include "quadrel/relief/frame/vertex.hpp"
#include "quadrel/relief/frame/vertex_published.hpp"

namespace quadrel {

using FrameStages = StageList<FrameNone, FrameThesis, FrameGram, FrameFace, FrameVertex,
                              FrameVertexPublished, FrameMikkt, FrameCot, FrameCotPublished,
                              FrameInverseTbn, FrameInverseTbnPublished, FrameImpostor>;

}  // namespace quadrel
