// Receives every look-up of a quad that is being probed. Only Quad<float> reports: the truth for
// the bits of every other float type.
#pragma once

#include <concepts>

#include "quadrel/num/functions.hpp"
#include "quadrel/texture/counters.hpp"
#include "quadrel/texture/lod.hpp"

namespace quadrel {

/// One look-up of the four lanes.
struct FetchEvent {
    const SampledTexture* texture;
    vec2<Quad<float>> uv;  ///< for cube maps: (s, t) on each lane's face
    LodRecord<Quad<float>> lod;
    QuadMask active;
    vec4<Quad<float>> value;
};

class FetchLog {
  public:
    virtual ~FetchLog() = default;
    virtual void fetch(const FetchEvent& event) = 0;
};

/// What a look-up's record is for.
template <Number F>
LodUse lod_use(const SampleContext<F>& context) {
    return context.log != nullptr ? LodUse::shown : LodUse::look_up;
}

/// Reports a look-up to the context's log. Free of cost for every type but Quad<float>.
template <Number F, class Value>
void log_fetch(const SampleContext<F>& context, const SampledTexture& texture, const vec2<F>& uv,
               const LodRecord<F>& lod, const Value& value) {
    if constexpr (std::same_as<F, Quad<float>>) {
        if (context.log != nullptr) context.log->fetch({&texture, uv, lod, context.active, value});
    }
}

}  // namespace quadrel
