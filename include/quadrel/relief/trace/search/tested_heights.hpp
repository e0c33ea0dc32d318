// The heights of a march as linear searches and their refinements take them.
#pragma once

#include "quadrel/relief/trace/search/near_surface.hpp"

namespace quadrel {

/// `height(active, s, uv, ray height)` fetches, and reports the step to a probe.
template <class Io, class Heights>
class TestedHeights {
  public:
    using F = typename Io::Number;

    /// Both must outlive this object.
    TestedHeights(const Io& io, const Heights& heights) : io_(io), heights_(heights) {}

    F operator()(Mask<F> active, F s, const vec2<F>& uv, F ray_height) const {
        const F h = heights_(active, uv);
        io_.march_step(active, s, uv, ray_height, h);
        last_ = {uv, ray_height - h};
        return h;
    }

    CeilingLevels ceiling(Mask<F> active) const {
        return ceiling_levels(io_, heights_.lod(), active);
    }

    const LastLook<F>& last_look() const { return last_; }

  private:
    const Io& io_;
    const Heights& heights_;
    mutable LastLook<F> last_;
};

template <class Io, class Heights>
TestedHeights<Io, Heights> tested_heights(const Io& io, const Heights& heights) {
    return {io, heights};
}

}  // namespace quadrel
