#include "render/exact/observed.hpp"

#include "quadrel/num/dual.hpp"
#include "quadrel/relief/heights.hpp"
#include "quadrel/relief/view.hpp"

namespace quadrel {
namespace {

/// What bump-blinn takes the differences of.
struct ObservedHeight : StageDefaults {
    static constexpr auto inputs = values(Value::dUVdx, Value::dUVdy, Value::hit_uv);
    static constexpr auto outputs = values(Value::hit_h);
    static constexpr auto textures = slots(TextureSlot::height);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        io.template store<Value::hit_h>(
            march_heights(io)(io.active(), io.template load<Value::hit_uv>()));
    }
};

/// What the environment is looked up along, but for the turn to world space.
struct ObservedMirrored : StageDefaults {
    static constexpr auto inputs = values(Value::P, Value::N);
    static constexpr auto outputs = values(Value::light_reflection);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const vec3<F> V = to_viewer(io.template load<Value::P>(), io.frame());
        io.template store<Value::light_reflection>(
            normalize(reflect(-V, io.template load<Value::N>())));
    }
};

template <class Stage>
StageFunction function_of(int scalar_bytes) {
    if (scalar_bytes == sizeof(Dual)) return &run_stage<Stage, Quad<Dual>>;
    if (scalar_bytes == sizeof(double)) return &run_stage<Stage, Quad<double>>;
    return &run_stage<Stage, Quad<float>>;
}

}  // namespace

std::span<const Value> inputs_of(Observed what) {
    if (what == Observed::height) return ObservedHeight::inputs;
    if (what == Observed::mirrored) return ObservedMirrored::inputs;
    return {};
}

Value form_of(Observed what) {
    return what == Observed::height ? Value::hit_h : Value::light_reflection;
}

StageFunction observer(Observed what, int scalar_bytes) {
    return what == Observed::height ? function_of<ObservedHeight>(scalar_bytes)
                                    : function_of<ObservedMirrored>(scalar_bytes);
}

}  // namespace quadrel
