// Heights as texture() gives them, without gradients of one's own.
#pragma once

#include "quadrel/relief/trace/search/course_heights.hpp"

namespace quadrel {

/// A look-up of the height map with implicit derivatives; all lanes need a coordinate.
template <class Io, class F = typename Io::Number>
F implicit_height(const Io& io, Mask<F> active, const vec2<F>& uv) {
    const auto context = io.template context<TextureSlot::height>(active);
    if (heights_are_noise(io)) return noise_height(io, context, uv);
    return texture(height_map(io), context, uv, io.frame().derivatives).x;
}

/// implicit_height for a whole march: where the level of detail does not matter, by the short way.
template <class Io>
class ImplicitHeights : public CourseHeights<Io> {
  public:
    using F = typename Io::Number;

    explicit ImplicitHeights(const Io& io)
        : CourseHeights<Io>(io),
          settled_(io, height_map(io), finest_lod<F>()),
          is_settled_(io.call().log == nullptr && !lod_matters(height_map(io))) {}

    F operator()(Mask<F> active, const vec2<F>& uv) const {
        return is_settled_ ? settled_(active, uv) : by_level(active, uv);
    }

    /// What look-ups read between two points that lie `steps` steps apart, where every lane goes
    /// straight on, all at once, or stays. Differences of coordinates are linear then but for what
    /// sums round off, and the greatest level is at one of the ends.
    CeilingLevels levels_between(Mask<F> active, const vec2<F>& from, const vec2<F>& to,
                                 int steps) const {
        const HeightMaxima& maxima = *this->io_.material().maxima;
        if (is_settled_) return {&maxima, 0, 0};
        const Scalar<F> level = greatest_level(active, from, to, steps);
        return {&maxima, 0, std::clamp(to_int(ceil(level)), 0, maxima.levels - 1)};
    }

  private:
    [[gnu::noinline]] F by_level(Mask<F> active, const vec2<F>& uv) const {
        return implicit_height(this->io_, active, uv);
    }

    [[gnu::noinline]] Scalar<F> greatest_level(Mask<F> active, const vec2<F>& from,
                                               const vec2<F>& to, int steps) const {
        const SampledTexture& map = height_map(this->io_);
        const F size = max(max(max(abs(from.x), abs(from.y)), max(abs(to.x), abs(to.y))), F(1));
        const F off = size * F(static_cast<Scalar<F>>(this->texels())) *
                      F(static_cast<Scalar<F>>(steps + 4) * 0x1p-22f);
        const F length = sqrt(max(greatest_square(map, from), greatest_square(map, to))) + off;
        const Gradients<F> raised{{length, F(0)}, {F(0), length}};
        const F level =
            lod_of_scale(map, scale_factor(map.sampler.lod_form, raised.x, raised.y)).level;
        return greatest(level, active);
    }

    /// At least the square of rho, infinite where gradients are no numbers.
    F greatest_square(const SampledTexture& map, const vec2<F>& uv) const {
        const auto [x, y] =
            texel_gradients<F>(map, implicit_gradients(map, uv, this->io_.frame().derivatives));
        const F square =
            map.sampler.lod_form == LodForm::ellipse ? dot(x, x) + dot(y, y) : largest_square(x, y);
        return select(is_finite(x.x + x.y + y.x + y.y), square,
                      F(std::numeric_limits<Scalar<F>>::infinity()));
    }

    MarchHeights<Io> settled_;
    bool is_settled_;
};

}  // namespace quadrel
