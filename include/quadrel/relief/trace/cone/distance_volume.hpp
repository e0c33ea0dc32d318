// Trilinear look-ups of a distance volume baked from a height field.
#pragma once

#include "quadrel/relief/trace/cone/cone_map.hpp"

namespace quadrel {

/// Layers of one channel, layer k about height (k + 1/2) / layers; bilinear within a layer by the
/// sampler's wrap modes, clamped above and below.
template <TextureSlot slot, class Io>
class DistanceVolume {
  public:
    using F = typename Io::Number;

    explicit DistanceVolume(const Io& io)
        : read_(io), layers_(io.template texture<slot>()->view.faces) {}

    F layers() const { return F(static_cast<Scalar<F>>(layers_)); }
    vec2<F> size() const { return read_.size(); }

    /// The stored distance, in units of the volume's height. Two fetches in the lanes of `active`.
    F operator()(Mask<F> active, const vec2<F>& uv, F z) const {
        const F at = clamp(z * layers() - F(0.5f), F(0), layers() - F(1));
        const F below = floor(at);
        const Int<F> layer = to_int(below);
        const Int<F> above = min(layer + Int<F>(1), Int<F>(layers_ - 1));
        return lerp(read_(active, uv, layer).channel[0], read_(active, uv, above).channel[0],
                    at - below);
    }

  private:
    BakedLookUp<slot, 1, Io> read_;
    std::int32_t layers_;
};

}  // namespace quadrel
