#include "render/exact/exact_batch.hpp"

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
    if (is_level_of_detail(channel.value)) return level_of_detail(channel, lane);
    return derivative(channel.value, channel.component, channel.axis, lane);
}

double ExactBatch::value(const ChannelSource& channel, const Batch& drawn, int lane) const {
    if (channel.kind == ChannelSource::Kind::exact) return exact(channel, lane);
    const double finite = is_level_of_detail(channel.value)
                              ? drawn.number(slot_of(channel.value), lane)
                              : finite_difference(drawn, channel.value, channel.component,
                                                  channel.axis, call_.frame->derivatives, lane);
    return finite - exact(channel, lane);
}

double finite_difference(const Batch& batch, Value v, int component, int axis, DerivativeMode mode,
                         int lane) {
    const int step = axis == 0 ? 1 : 2;
    const int from = mode == DerivativeMode::fine ? lane & ~step : lane & ~3;
    return batch.difference(slot_of(v) + component, from + step, from);
}

}  // namespace quadrel
