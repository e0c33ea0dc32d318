// What bounds the heights of marches on a course (course.hpp), and those of them whose levels of
// detail are settled beforehand.
#pragma once

#include "quadrel/relief/trace/search/near_surface.hpp"

namespace quadrel {

/// The bounds that hold whatever levels look-ups read.
template <class Io>
class CourseHeights {
  public:
    using F = typename Io::Number;

    explicit CourseHeights(const Io& io)
        : io_(io),
          leaves_out_(io.call().log == nullptr &&
                      marks_of(io.template context<TextureSlot::height>()) == nullptr) {}

    /// No look-up gives more.
    Scalar<F> highest() const {
        return leaves_out_ ? height_bounds(io_).high : HeightBounds<Scalar<F>>().high;
    }

    /// What is known of parts of the map; null: nothing.
    const HeightMaxima* maxima() const { return leaves_out_ ? io_.material().maxima : nullptr; }

    /// Along the map's longer side.
    int texels() const {
        const TextureView& view = height_map(io_).view;
        return std::max(view.width[0], view.height[0]);
    }

  protected:
    const Io& io_;

  private:
    bool leaves_out_;  ///< nothing shows or marks every look-up
};

/// Heights of levels of detail that a march has settled, per lane.
template <class Io>
class SettledHeights : public CourseHeights<Io> {
  public:
    using F = typename Io::Number;

    SettledHeights(const Io& io, const LodRecord<F>& lod)
        : CourseHeights<Io>(io), heights_(io, height_map(io), lod) {}

    F operator()(Mask<F> active, const vec2<F>& uv) const { return heights_(active, uv); }

    /// What look-ups read, wherever they are made.
    CeilingLevels levels_between(Mask<F> active, const vec2<F>&, const vec2<F>&, int) const {
        return ceiling_levels(this->io_, heights_.lod(), active);
    }

  private:
    MarchHeights<Io> heights_;
};

/// Of a level of detail a lane, 0 the finest; see march_heights_of_level.
template <class Io, class F = typename Io::Number>
SettledHeights<Io> settled_heights_of_level(const Io& io, F level) {
    return {io, lod_from_level(height_map(io), level)};
}

}  // namespace quadrel
