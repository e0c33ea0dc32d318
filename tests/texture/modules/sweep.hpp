// One sweep over every kind of look-up, the same source for Quad<float> and for each instruction
// set's lanes; results must agree bit for bit.
#pragma once

#include <cstdint>

#include "quadrel/texture/cube.hpp"
#include "quadrel/texture/height_sampler.hpp"

namespace quadrel::test {

inline constexpr int sweep_inputs = 8;    ///< u v s, dx (3), dy (2): arrays of `count` floats
inline constexpr int sweep_outputs = 39;  ///< arrays of `count` floats

/// Plain data: it crosses into modules.
struct SweepRequest {
    const SampledTexture* flat;    ///< a two-dimensional texture
    const SampledTexture* height;  ///< one channel
    const SampledTexture* cube;
    const float* input[sweep_inputs];
    float* output[sweep_outputs];
    std::int32_t count;  ///< a multiple of 16
    FetchCounters* counters;
    std::int32_t lanes;  ///< set by the sweep: how wide it ran
};

/// Called as `extern "C"` from a module.
using SweepFunction = void(SweepRequest*);

/// Stores results one after the other.
template <Number F>
class SweepWriter {
  public:
    SweepWriter(const SweepRequest& request, int at) : request_(request), at_(at) {}
    void operator()(F value) { store(request_.output[next_++] + at_, value); }
    void operator()(const vec4<F>& value) {
        for (int c = 0; c < 4; ++c) (*this)(value[c]);
    }
    void operator()(const LodRecord<F>& lod) {
        for (const F value : {lod.rho, lod.lambda, lod.level, lod.frac}) (*this)(value);
    }

  private:
    const SweepRequest& request_;
    int at_, next_ = 0;
};

template <Number F>
void sweep_packet(const SweepRequest& request, int at) {
    const auto input = [&](int i) { return load<F>(request.input[i] + at); };
    const vec2<F> uv(input(0), input(1)), dx(input(3), input(4)), dy(input(6), input(7));
    const vec3<F> direction(input(0), input(1), input(2));
    const vec3<F> direction_dx(input(3), input(4), input(5));
    const SampleContext<F> context{input(2) > F(-0.5f), request.counters};
    const SampledTexture& flat = *request.flat;
    SweepWriter<F> write(request, at);
    LodRecord<F> lod;
    write(texture_grad(flat, context, uv, dx, dy, &lod));
    write(lod);
    write(texture(flat, context, uv));
    write(texture(flat, context, uv, DerivativeMode::coarse));
    write(texture_bias(flat, context, uv, input(2)));
    write(texture_lod(flat, context, uv, input(2)));
    const Int<F> x = to_int(input(0)), y = to_int(input(1)), level = to_int(input(2));
    write(texel_fetch<F>(flat, context, x, y, level));
    write(texture_gather(flat, context, uv, 1));
    write(FastHeight<F>(*request.height)(context, uv));
    write(GeneralHeight<F>(*request.height, dx, dy)(context, uv));
    write(texture_cube_grad(*request.cube, context, direction, direction_dx, direction).x);
    write(texture_cube(*request.cube, context, direction).y);
    write(texture_cube_lod(*request.cube, context, direction, input(3)).z);
    const vec2<F> query = texture_query_lod(flat, uv, dx, dy);
    write(query.x);
    write(query.y);
}

template <Number F>
void sweep(SweepRequest& request) {
    request.lanes = lanes_of<F>;
    for (int at = 0; at < request.count; at += lanes_of<F>) sweep_packet<F>(request, at);
}

}  // namespace quadrel::test
