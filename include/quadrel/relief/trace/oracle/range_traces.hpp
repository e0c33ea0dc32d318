// The judge's stages on ranges: its hits are those of every exact search, and what it says of them
// beside that is not followed.
#pragma once

#include "quadrel/relief/trace/oracle/stages.hpp"
#include "quadrel/relief/trace/search/range_first_hit.hpp"

namespace quadrel {

template <oracle::Surface surface>
struct OracleOnRanges : FirstHitOnRanges<OracleTrace<surface>, surface> {
    static constexpr StageText text = surface == oracle::Surface::bilinear   ? OracleBilinear::text
                                      : surface == oracle::Surface::block    ? OracleBlock::text
                                      : surface == oracle::Surface::tri_main ? OracleTriMain::text
                                      : surface == oracle::Surface::tri_anti ? OracleTriAnti::text
                                                                             : OracleTriMin::text;

    template <class Io>
    void operator()(Io& io, const NoParams& params) const {
        const Ranges any(Ranged::anything());
        const vec2<Ranges> any_pair(any, any);
        io.template store<Value::oracle_s>(any);
        io.template store<Value::oracle_uv>(any_pair);
        io.template store<Value::oracle_cell>(any_pair);
        io.template store<Value::oracle_place>(any_pair);
        io.template store<Value::oracle_gradient>(any_pair);
        io.template store<Value::oracle_condition>(any);
        io.template store<Value::oracle_bound>(any);
        const RangeInt any_integer = range_detail::any_count();
        io.template store<Value::oracle_status>(any_integer);
        io.template store<Value::certified>(any_integer);
        io.template store<Value::certified_reason>(any_integer);
        FirstHitOnRanges<OracleTrace<surface>, surface>::operator()(io, params);
    }
};

/// A share of the sky, and a standard error of it: from 0 to 1.
struct AoOracleOnRanges : AoOracle {
    template <class Io>
    void operator()(Io& io, const Params&) const {
        const Ranges share(Ranged(0.0, 1.0));
        io.template store<Value::occlusion>(share);
        io.template store<Value::occlusion_error>(share);
    }
};

}  // namespace quadrel
