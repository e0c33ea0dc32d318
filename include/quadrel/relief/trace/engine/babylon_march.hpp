// The loop of Babylon.js' parallaxOcclusion; babylon.hpp says whose shader it is, and what is odd
// about it.
#pragma once

#include "quadrel/relief/trace/search/search.hpp"

namespace quadrel {

/// The variables of parallaxOcclusion, named as there.
template <Number F>
struct BabylonMarch {
    static constexpr int iMaxSamples = 15;
    F stepSize;
    vec2<F> vMaxOffset;
    F lastSampledHeight = F(1), compared = F(0);
    vec3<F> at = vec3<F>(F(0), F(0), F(1));  ///< vCurrOffset and currRayHeight
    vec2<F> vLastOffset = vec2<F>(F(0));
    Mask<F> keepWorking, hit = Mask<F>(false), met_nan = Mask<F>(false);

    BabylonMarch(const vec3<F>& vViewDirCoT, const vec3<F>& vNormalCoT, float scale, Mask<F> active)
        : keepWorking(active) {
        const vec2<F> in_plane(vViewDirCoT);
        const F parallaxLimit = length(in_plane) / vViewDirCoT.z * F(scale);
        vMaxOffset = normalize(in_plane) * parallaxLimit;
        stepSize = F(1) / (F(15) + dot(vViewDirCoT, vNormalCoT) * F(4 - 15));
    }

    vec2<F> vCurrOffset() const { return vec2<F>(at); }
    F currRayHeight() const { return at.z; }

    vec3<F> next(const vec3<F>& from, F side) const {
        return from + vec3<F>(vMaxOffset * stepSize * side, -stepSize);
    }

    /// Takes in the height of a sample in the lanes that work. `side`: 1 or -1.
    void test(F currSampledHeight, F side) {
        met_nan = met_nan | (keepWorking & is_nan(currSampledHeight));
        compared = select(keepWorking, currSampledHeight, compared);
        const Mask<F> above = keepWorking & (currSampledHeight > currRayHeight());
        hit = hit | above;
        keepWorking = keepWorking & !above;
        at = select(above, vec3<F>(secant(currSampledHeight), currRayHeight()), at);
        vLastOffset = select(keepWorking, vCurrOffset(), vLastOffset);
        at = select(keepWorking, next(at, side), at);
        lastSampledHeight = select(keepWorking, currSampledHeight, lastSampledHeight);
    }

    /// Where there is no direction in the plane to march in.
    Mask<F> lost() const { return is_nan(at.x) | is_nan(at.y); }

  private:
    vec2<F> secant(F currSampledHeight) const {
        const F delta1 = currSampledHeight - currRayHeight();
        const F delta2 = currRayHeight() + stepSize - lastSampledHeight;
        const F ratio = delta1 / (delta1 + delta2);
        return vLastOffset * ratio + vCurrOffset() * (F(1) - ratio);
    }
};

}  // namespace quadrel
