// The search of Open 3D Engine's AdvancedParallaxMapping and its refinements; o3de.hpp says whose
// shader it is, and what is odd about it. Names with capitals are the shader's.
#pragma once

#include "quadrel/relief/trace/search/counted_heights.hpp"
#include "quadrel/relief/trace/search/course.hpp"
#include "quadrel/relief/trace/search/course_heights.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

struct O3deParams {
    std::int32_t algorithm = 2, quality = 0;
    float scale = 0.05f, offset = 0;
};

/// The range of depths that is searched, [0, 1] from its top to its bottom: the one from
/// `start` to `start` + factor below the polygon.
template <Number F>
class O3deRange {
  public:
    O3deRange(float factor, F start) {
        const F end = start + F(factor);
        least_ = -start * (F(1) / F(factor));
        has_depth_ = end - start > F(0.0001f);
    }
    F normalized_depth(F height) const {
        return select(has_depth_, max(F(1) - height, least_), F(0));
    }

  private:
    F least_;  ///< depth of the polygon
    Mask<F> has_depth_;
};

/// Heights with ddx_fine and ddy_fine of the undisplaced UV, whatever the frame's derivatives.
template <class Io, class F = typename Io::Number>
SettledHeights<Io> o3de_heights(const Io& io, const vec2<F>& uv) {
    return {io, compute_lod(height_map(io), dFdx(uv, DerivativeMode::fine),
                            dFdy(uv, DerivativeMode::fine))};
}

template <class Io>
class O3deSearch {
  public:
    using F = typename Io::Number;

    O3deSearch(const O3deSearch&) = delete;
    /// At the top of the range, with the first look-up made.
    O3deSearch(const Io& io, const SearchRay<F>& ray, const vec3<F>& dirToCameraTS,
               const O3deParams& params)
        : ray_(ray),
          heights_(o3de_heights(io, ray.uv)),
          height_(io, heights_),
          range_(params.scale, F(-params.offset)),
          numSteps_(16 << params.quality),
          step_(F(1) / F(static_cast<Scalar<F>>(numSteps_))) {
        const F zInverse = F(1) / dirToCameraTS.z;
        delta_ = -dirToCameraTS * F(params.scale) * zInverse * step_;
        at_ = vec4<F>(-dirToCameraTS * zInverse * F(-params.offset), F(0));
        sample(ray.active);
    }

    void march() { march(step_, delta_); }

    /// POM: the chord between the last two samples.
    void interpolate() {
        const F prevStep = currentStep() - step_;
        const F currentDiff = currentStep() - currentSample_;
        const F prevDiff = prevSample_ - prevStep;
        const F ratio = prevDiff / (prevDiff + currentDiff);
        const vec4<F> between(lerp(parallaxOffset() - delta_, parallaxOffset(), ratio),
                              lerp(prevStep, currentStep(), ratio));
        at_ = select(below_top(), between, at_);
    }

    /// Relief: half steps on or back, smaller and smaller.
    void halve() {
        const Mask<F> moved = below_top();
        vec3<F> reliefDelta = delta_;
        F reliefStep = step_;
        for (const auto k : steps<F>(1, numSteps_)) {
            reliefDelta = reliefDelta * F(0.5f);
            reliefStep = reliefStep * F(0.5f);
            const F depthSign = sign(currentSample_ - currentStep());
            move(moved, reliefStep * depthSign, reliefDelta * depthSign);
            sample(moved);
        }
    }

    /// Contact refinement: back by a step, then on in steps of a step's square.
    void march_again() {
        const Mask<F> moved = below_top();
        move(moved, -step_, -delta_);
        currentSample_ = select(moved, prevSample_, currentSample_);
        march(step_ * step_, delta_ * step_);
    }

    /// The displaced coordinates: undisplaced where the point lies above the polygon.
    vec2<F> uv() const { return ray_.uv + select(at_.z > F(0), vec2<F>(F(0)), vec2<F>(at_)); }
    SearchResult<F> result() const {
        SearchResult<F> result = height_.result(currentStep(), uv(), !capped_);
        result.status = select(capped_, status_packet<F>(Status::cap), result.status);
        return result;
    }

  private:
    vec3<F> parallaxOffset() const { return vec3<F>(at_); }
    F currentStep() const { return at_.w; }
    Mask<F> below_top() const { return ray_.active & (currentStep() > F(0)) & !capped_; }

    void move(Mask<F> lanes, F step, const vec3<F>& delta) {
        at_ = select(lanes, at_ + vec4<F>(delta, step), at_);
    }

    void sample(Mask<F> lanes) {
        const F height = height_(lanes, currentStep(), ray_.uv + vec2<F>(at_));
        currentSample_ = select(lanes, range_.normalized_depth(height), currentSample_);
    }

    void march(F step, const vec3<F>& delta) {
        Mask<F> above = ray_.active & !capped_ & (currentSample_ > currentStep());
        const auto next = [&](const vec4<F>& from) { return from + vec4<F>(delta, step); };
        const Course course{[&](const vec4<F>& from) { return ray_.uv + vec2<F>(next(from)); },
                            [&](const vec4<F>& from, F height) {
                                return range_.normalized_depth(height) > next(from).w;
                            },
                            next};
        for (const auto k :
             steps_on_course<F, Before::needed>(course, at_, heights_, above, 1, most_steps)) {
            if (none(above)) break;
            move(above, step, delta);
            prevSample_ = select(above, currentSample_, prevSample_);
            sample(above);
            above = above & (currentSample_ > currentStep());
        }
        capped_ = capped_ | above;
    }

    const SearchRay<F>& ray_;
    SettledHeights<Io> heights_;
    CountedHeights<Io, SettledHeights<Io>> height_;
    O3deRange<F> range_;
    int numSteps_;
    F step_;  ///< of normalised depth
    vec3<F> delta_;
    vec4<F> at_;  ///< parallaxOffset and currentStep
    F currentSample_ = F(0), prevSample_ = F(0);
    Mask<F> capped_ = Mask<F>(false);
};

}  // namespace quadrel
