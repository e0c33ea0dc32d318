// The look-ups of a march, and what it reports of them.
#pragma once

#include "quadrel/relief/trace/search/search.hpp"

namespace quadrel {

/// Heights that `heights(active, uv)` gives, counted and shown to a probe.
template <class Io, class Heights>
class CountedHeights {
  public:
    using F = typename Io::Number;

    /// Both must outlive this object.
    CountedHeights(const Io& io, const Heights& heights) : io_(io), heights_(heights) {}

    /// The height at uv, which the search makes a point at depth s of; lanes outside of `active`
    /// get one that does not count.
    F operator()(Mask<F> active, F s, const vec2<F>& uv) {
        const F height = heights_(active, uv);
        io_.march_step(active, s, uv, F(1) - s, height);
        last_ = select(active, height, last_);
        met_nan_ = met_nan_ | (active & is_nan(height));
        count_in<F>(made_, active);
        return height;
    }

    const Heights& heights() const { return heights_; }

    /// The last height of each lane.
    F last() const { return last_; }

    /// NAN where a height was not a number, or s or a coordinate is not finite.
    SearchResult<F> result(F s, const vec2<F>& uv, Mask<F> found) const {
        SearchResult<F> result;
        result.s = s;
        result.h = last_;
        result.status = search_status<F>(found, met_nan_ | !is_finite(s + uv.x + uv.y));
        result.steps = made_;
        result.fetches = made_;
        return result;
    }

  private:
    const Io& io_;
    const Heights& heights_;
    F last_ = F(0);
    Mask<F> met_nan_ = Mask<F>(false);
    Int<F> made_ = Int<F>(0);
};

}  // namespace quadrel
