// Stages of the judge, by room. They run on plain numbers alone; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/occlusion/oracle.hpp"
#include "quadrel/relief/shadow/oracle.hpp"
#include "quadrel/relief/trace/oracle/oracle.hpp"
#include "quadrel/relief/trace/oracle/traces.hpp"

namespace quadrel {

using OracleStages = StageList<Oracle>;
using OracleTraceStages =
    StageList<OracleBilinear, OracleBlock, OracleTriMain, OracleTriAnti, OracleTriMin>;
using OracleShadowStages = StageList<ShadowOracle>;
using OracleOcclusionStages = StageList<AoOracle>;

/// All of them: a group of kernels.
using OracleKernels = StageList<Oracle, OracleBilinear, OracleBlock, OracleTriMain, OracleTriAnti,
                                OracleTriMin, ShadowOracle, AoOracle>;

}  // namespace quadrel
