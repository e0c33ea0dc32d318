// oracle-bilinear, oracle-block, oracle-tri-main, oracle-tri-anti, oracle-tri-min: the judge's hits
// as a trace, for shading and for comparing frames by.
//
// No source's. Level 0, whatever filters the sampler has; its wrap modes hold. One ray after the
// other on plain numbers, whatever --isa says: clarity before speed. hit.steps counts nodes and
// cells that were looked at; hit.fetches is 0, since no one's look-ups are counted by a judge.
// `ambiguous` says that nothing was proven.
#pragma once

#include "quadrel/relief/trace/oracle/lanes.hpp"

namespace quadrel {

template <oracle::Surface surface>
struct OracleTrace : StageDefaults {
    static constexpr auto inputs = level_0_search_inputs;
    static constexpr auto outputs = values_and(
        trace_outputs, Value::oracle_s, Value::oracle_uv, Value::oracle_cell, Value::oracle_place,
        Value::oracle_gradient, Value::oracle_condition, Value::oracle_bound, Value::oracle_status,
        Value::certified, Value::certified_reason);
    static constexpr auto textures = slots(TextureSlot::height, TextureSlot::max_mip);
    static constexpr bool needs_height_map = true;
    static constexpr bool reads_finest_heights_only = true;

    template <class Io>
    void operator()(Io& io, const NoParams&) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const oracle::QuadHits<Scalar<F>> hits(io, ray, surface);
        oracle::store_hits(io, hits);
        SearchResult<F> result;
        result.s = hits.s();
        result.h = hits.real([](const oracle::Hit& hit) { return hit.height; });
        result.status = hits.status();
        result.steps = hits.integer([](const oracle::Hit& hit) { return hit.steps; });
        const vec2<F> uv = ray.at(result.s);  // as every trace has it; oracle_uv is nearer
        const Mask<F> wrapped = (floor(uv.x) != floor(ray.uv.x)) | (floor(uv.y) != floor(ray.uv.y));
        const Mask<F> meets = result.status == status_packet<F>(Status::hit);
        const Int<F> proven = hits.integer([](const oracle::Hit& hit) { return hit.certificate; });
        result.flags = select(wrapped & meets, Int<F>(HitFlag::wrapped), Int<F>(0)) |
                       select(proven == Int<F>(0), Int<F>(HitFlag::ambiguous), Int<F>(0));
        store_search(io, ray, result);
    }
};

struct OracleBilinear : OracleTrace<oracle::Surface::bilinear> {
    static constexpr StageText text{"oracle-bilinear", "trace",
                                    "first hit of bilinear patches, proven", "-"};
};
struct OracleBlock : OracleTrace<oracle::Surface::block> {
    static constexpr StageText text{"oracle-block", "trace",
                                    "first hit of texels as blocks, proven", "-"};
};
struct OracleTriMain : OracleTrace<oracle::Surface::tri_main> {
    static constexpr StageText text{"oracle-tri-main", "trace",
                                    "first hit of triangles along main diagonals, proven", "-"};
};
struct OracleTriAnti : OracleTrace<oracle::Surface::tri_anti> {
    static constexpr StageText text{"oracle-tri-anti", "trace",
                                    "first hit of triangles along the other diagonals, proven",
                                    "-"};
};
struct OracleTriMin : OracleTrace<oracle::Surface::tri_min> {
    static constexpr StageText text{"oracle-tri-min", "trace",
                                    "first hit of triangles along the flatter diagonals, proven",
                                    "-"};
};

}  // namespace quadrel
