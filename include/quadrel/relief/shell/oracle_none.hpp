// oracle-none: what the judge says of shells: nothing. Its proofs are of rays through polygons;
// over a shell every fragment is one without such a ray (Uncertified::no_ray), where it enters.
#pragma once

#include "quadrel/relief/rooms.hpp"
#include "quadrel/relief/view.hpp"

namespace quadrel {

struct OracleNone : StageDefaults {
    static constexpr StageText text{"oracle-none", "oracle", "no proof: a shell has none", "-"};
    static constexpr auto inputs = values(Value::uv);
    static constexpr auto outputs = oracle_outputs;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const F zero(0);
        const vec2<F> nothing(zero);
        io.template store<Value::oracle_s>(zero);
        io.template store<Value::oracle_uv>(io.template load<Value::uv>());
        io.template store<Value::oracle_cell>(nothing);
        io.template store<Value::oracle_place>(nothing);
        io.template store<Value::oracle_gradient>(nothing);
        io.template store<Value::oracle_condition>(zero);
        io.template store<Value::oracle_bound>(zero);
        io.template store<Value::oracle_status>(status_packet<F>(Status::no_frame));
        io.template store<Value::certified>(Int<F>(static_cast<std::int32_t>(Certificate::none)));
        io.template store<Value::certified_reason>(
            Int<F>(static_cast<std::int32_t>(Uncertified::no_ray)));
    }
};

}  // namespace quadrel
