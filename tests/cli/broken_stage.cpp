// A plugin with a stage that breaks a promise on a part of the picture: a status that does not
// exist where u > 0.5.
#include "quadrel/plugin.hpp"
#include "quadrel/relief/trace/offset/none.hpp"

namespace {

struct BrokenTrace : quadrel::TraceNone {
    static constexpr quadrel::StageText text{"test-broken", "trace", "an unknown status",
                                             "these tests"};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        quadrel::TraceNone::operator()(io, params);
        const auto uv = io.template load<quadrel::Value::uv>();
        io.template store<quadrel::Value::hit_status>(
            select(uv.x > F(0.5f), quadrel::Int<F>(9), quadrel::Int<F>(1)));
    }
};

}  // namespace

QUADREL_STAGES(BrokenTrace);
