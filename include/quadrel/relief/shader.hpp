// Searches written as a shader: a ray that looks up heights, counts, and keeps what was hit. The
// same bits as a search written out over search.hpp.
//
//     struct Steep : ReliefShader {
//         static constexpr StageText text{"my-steep", "trace", "summary", "source"};
//         template <class Io>
//         void operator()(Io& io, const Params&) const {
//             ReliefRay ray(io);
//             for (const auto k : ray.steps(0, 64)) {
//                 const auto s = ray.number(k) / 64;
//                 const auto h = ray.height(s);
//                 ray.hit(h >= 1 - s, s);
//                 if (none(ray.active())) break;
//             }
//             ray.store();
//         }
//     };
#pragma once

#include "quadrel/relief/trace/search/search.hpp"

namespace quadrel {

/// What a search declares that reads the height map and no more.
struct ReliefShader : StageDefaults {
    static constexpr auto inputs = search_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::height);
};

/// The view ray of every lane on its way through the relief: s in [0, 1] is its depth below the top
/// plane, in units of the relief's own depth. A lane searches until it has hit.
template <class Io>
class ReliefRay {
  public:
    using Float = typename Io::Number;
    using Bool = Mask<Float>;

    explicit ReliefRay(Io& io)
        : io_(io), ray_(search_ray(io)), heights_(march_heights(io)), active_(ray_.active) {}

    /// A plain number in every lane.
    template <class T>
    Float number(T x) const {
        return Float(static_cast<Scalar<Float>>(x));
    }
    /// The steps first, first + 1, ..., last, for a range-based loop.
    Steps steps(int first, int last) const { return quadrel::steps<Float>(first, last); }
    /// The lanes that still search; texts leave their loop when there are none.
    Bool active() const { return active_; }

    /// Undisplaced texture coordinates, and their shift while the ray falls from s = 0 to 1.
    const vec2<Float>& uv() const { return ray_.uv; }
    const vec2<Float>& K() const { return ray_.K; }
    /// Texture coordinates of the ray at depth s.
    vec2<Float> at(Float s) const { return ray_.at(s); }

    /// The height in [0, 1] that the map has under the ray at depth s, with the gradients of the
    /// undisplaced coordinates. A step of the search: counted, and shown by a probe.
    Float height(Float s) {
        const vec2<Float> where = at(s);
        const Float h = heights_(active_, where);
        io_.march_step(active_, s, where, Float(1) - s, h);
        count_in<Float>(found_.steps, active_);
        found_.h = select(active_, h, found_.h);
        met_nan_ = met_nan_ | (active_ & is_nan(h));
        return h;
    }

    /// Ends the search, at depth s, of those searching lanes for which `condition` holds.
    void hit(Bool condition, Float s) {
        const Bool now = active_ & condition;
        found_.s = select(now, s, found_.s);
        hit_ = hit_ | now;
        active_ = active_ & !now;
    }

    /// Stores the outputs of the trace room. Lanes without a hit are at the bottom plane.
    void store() {
        found_.status = search_status<Float>(hit_, met_nan_);
        found_.fetches = found_.steps;
        store_search(io_, ray_, found_);
    }

  private:
    Io& io_;
    SearchRay<Float> ray_;
    MarchHeights<Io> heights_;
    Bool active_, hit_ = Bool(false), met_nan_ = Bool(false);
    SearchResult<Float> found_;
};

}  // namespace quadrel
