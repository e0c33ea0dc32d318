#include "render/exact/exact_batch.hpp"

#include <utility>

#include "quadrel/num/dual.hpp"
#include "quadrel/texture/lod.hpp"

namespace quadrel {
namespace {

bool is_level_of_detail(Value v) { return v == Value::lod_rho || v == Value::lod_lambda; }

/// The level of detail of these gradients on the map that stage `lod` looks at.
LodRecord<double> lod_of(const StageCall& call, const vec2<double>& dx, const vec2<double>& dy) {
    const SampledTexture* height = call.textures[static_cast<int>(TextureSlot::height)];
    const SampledTexture* map =
        height ? height : call.textures[static_cast<int>(TextureSlot::color)];
    return map ? compute_lod(*map, dx, dy) : LodRecord<double>{};
}

/// The lanes of a batch that dFdx or dFdy subtracts: the first from the second.
std::pair<int, int> lanes_of_difference(int axis, DerivativeMode mode, int lane) {
    const int step = axis == 0 ? 1 : 2;
    const int from = mode == DerivativeMode::fine ? lane & ~step : lane & ~3;
    return {from, from + step};
}

}  // namespace

ExactBatch::ExactBatch(const ProbeCommand* command) : batch_(sizeof(Dual), command) {}

void ExactBatch::run(const MaterialPlan& plan, const StageCall& call, const QuadCoverage* quads,
                     int count, const Geometry& geometry, int samples, bool centroid) {
    if (prepared_ != &plan) batch_.prepare(plan);
    prepared_ = &plan;
    call_ = call;
    call_.counters = nullptr;  // look-ups of what is drawn are counted
    call_.log = nullptr;
    batch_.load(quads, count, geometry, samples, centroid);
    batch_.run(plan, call_, geometry);
}

void ExactBatch::observe(const std::vector<ChannelSource>& channels, const Batch& drawn) {
    for (Beside& beside : beside_) beside = {};
    for (const ChannelSource& channel : channels) {
        Beside& made = beside_[static_cast<std::size_t>(channel.observed)];
        if (channel.observed != Observed::none && made.duals.empty())
            observe(channel.observed, drawn, made);
    }
}

void ExactBatch::observe(Observed what, const Batch& drawn, Beside& beside) const {
    const Value form = form_of(what);
    const auto elements = static_cast<std::size_t>(arrays_of(form)) * batch_lanes;
    beside.duals.resize(elements);
    beside.doubles.resize(elements);
    beside.floats.resize(elements);
    const bool heights = call_.textures[static_cast<int>(TextureSlot::height)] != nullptr ||
                         call_.material->noise_octaves > 0;
    if (reads_heights(what) && !heights) return;  // all of it is 0
    batch_.run_beside(observer(what, sizeof(Dual)), call_, form, beside.duals.data());
    void* const as_drawn = drawn.scalar_bytes() == sizeof(float)
                               ? static_cast<void*>(beside.floats.data())
                               : beside.doubles.data();
    drawn.run_beside(observer(what, drawn.scalar_bytes()), call_, form, as_drawn);
}

double ExactBatch::derivative(Value v, int component, int axis, int lane) const {
    const Dual& dual = batch_.dual(slot_of(v) + component, lane);
    return axis == 0 ? dual.dx : dual.dy;
}

double ExactBatch::level_of_detail(const ChannelSource& channel, int lane) const {
    const auto gradient = [&](int axis) {
        return vec2<double>(derivative(Value::uv, 0, axis, lane),
                            derivative(Value::uv, 1, axis, lane));
    };
    const LodRecord<double> lod = lod_of(call_, gradient(0), gradient(1));
    return channel.value == Value::lod_rho ? lod.rho : lod.lambda;
}

double ExactBatch::exact(const ChannelSource& channel, int lane) const {
    if (channel.observed != Observed::none) {
        const Dual& dual =
            beside(channel).duals[static_cast<std::size_t>(channel.component * batch_lanes + lane)];
        return channel.axis == 0 ? dual.dx : dual.dy;
    }
    if (is_level_of_detail(channel.value)) return level_of_detail(channel, lane);
    return derivative(channel.value, channel.component, channel.axis, lane);
}

/// What is drawn.
double ExactBatch::finite(const ChannelSource& channel, const Batch& drawn, int lane) const {
    if (is_level_of_detail(channel.value)) return drawn.number(slot_of(channel.value), lane);
    const DerivativeMode mode = call_.frame->derivatives;
    if (channel.observed == Observed::none)
        return finite_difference(drawn, channel.value, channel.component, channel.axis, mode, lane);
    const auto [from, to] = lanes_of_difference(channel.axis, mode, lane);
    const auto first = static_cast<std::size_t>(channel.component * batch_lanes);
    const auto at = [&](int of) { return first + static_cast<std::size_t>(of); };
    const Beside& values = beside(channel);
    if (drawn.scalar_bytes() == sizeof(float))
        return values.floats[at(to)] - values.floats[at(from)];
    return values.doubles[at(to)] - values.doubles[at(from)];
}

double ExactBatch::value(const ChannelSource& channel, const Batch& drawn, int lane) const {
    if (channel.kind == ChannelSource::Kind::exact) return exact(channel, lane);
    return finite(channel, drawn, lane) - exact(channel, lane);
}

double finite_difference(const Batch& batch, Value v, int component, int axis, DerivativeMode mode,
                         int lane) {
    const auto [from, to] = lanes_of_difference(axis, mode, lane);
    return batch.difference(slot_of(v) + component, to, from);
}

}  // namespace quadrel
