// Searches by cones and distances on ranges: what their maps give anywhere in a range of places,
// and walks whose every step is taken for all positions that it may begin at (range_walk.hpp).
#pragma once

#include <vector>

#include "quadrel/relief/trace/cone/stages.hpp"
#include "quadrel/relief/trace/search/range_first_hit.hpp"
#include "quadrel/relief/trace/search/range_walk.hpp"
#include "quadrel/texture/range/sampler.hpp"

namespace quadrel {

namespace range_detail {

/// Texels whose second channel is interpolated by its root.
class RootTexels {
  public:
    explicit RootTexels(const LevelTexels& of) : of_(of) {}

    TexelValue at(double i, double j) const {
        TexelValue value = of_.at(i, j);
        value.channel[1] = std::sqrt(std::max(value.channel[1], 0.0));
        return value;
    }

  private:
    const LevelTexels& of_;
};

/// What a layer of a baked map gives over ranges of coordinates, filtered linearly.
inline TexelRange layer_range(const SampledTexture& map, int layer, bool by_roots, const Ranged& u,
                              const Ranged& v) {
    const LevelTexels texels(map, 0, layer);
    const auto in_roots = [&](TexelRange range) {
        RealInterval& root = range.channel[1];
        if (by_roots) root = {std::sqrt(std::max(root.lo, 0.0)), std::sqrt(std::max(root.hi, 0.0))};
        return range;
    };
    if (!u.is_bounded() || !v.is_bounded()) return in_roots(whole_map(map));
    const RealInterval x = texel_coordinates(u.range(), texels.width(), map.sampler);
    const RealInterval y = texel_coordinates(v.range(), texels.height(), map.sampler);
    if (std::max(x.magnitude(), y.magnitude()) > coordinate_limit / 2)
        return in_roots(whole_map(map));
    TexelRange range = TexelRange::nothing();
    const bool done = by_roots ? include_linear(range, RootTexels(texels), x, y)
                               : include_linear(range, texels, x, y);
    return done ? range : in_roots(whole_map(map));
}

/// The same of any of several layers.
inline TexelRange layers_range(const SampledTexture& map, RangeInt::Lane layers, bool by_roots,
                               const Ranged& u, const Ranged& v) {
    const int first = std::clamp(layers.lo, 0, map.view.faces - 1);
    const int last = std::clamp(layers.hi, 0, map.view.faces - 1);
    TexelRange range = TexelRange::nothing();
    for (int layer = first; layer <= last; ++layer)
        range.include(layer_range(map, layer, by_roots, u, v));
    return filtered(range);
}

}  // namespace range_detail

template <TextureSlot slot, int channels, class Io, Interpolated what>
requires std::same_as<typename Io::Number, Ranges>
class BakedLookUp<slot, channels, Io, what> {
  public:
    using F = Ranges;

    explicit BakedLookUp(const Io& io) : map_(*io.template texture<slot>()) {}

    Texel<channels, F> operator()(const RangeMask& active, const vec2<F>& uv) const {
        return (*this)(active, uv, RangeInt(0));
    }
    Texel<channels, F> operator()(const RangeMask& active, const vec2<F>& uv,
                                  const RangeInt& layer) const {
        using namespace range_detail;
        constexpr bool by_roots = what == Interpolated::roots;
        Texel<channels, F> texel;
        for (F& channel : texel.channel) channel = F(Ranged::anything());
        for (int i = 0; i < 4; ++i) {
            if (active.lane[i].known().state == RangeTruth::no) continue;
            const TexelRange range =
                layers_range(map_, layer.lane[i], by_roots, uv.x.lane[i], uv.y.lane[i]);
            for (int c = 0; c < channels; ++c) texel.channel[c].lane[i] = Ranged(range.channel[c]);
        }
        if constexpr (by_roots) texel.channel[1] = squared(texel.channel[1]);
        return texel;
    }
    vec2<F> size() const { return {F(double(map_.view.width[0])), F(double(map_.view.height[0]))}; }

  private:
    /// Of roots that are not below 0, with what the roots of taps are off by.
    static F squared(const F& roots) {
        const F off = sqrt(roots * roots);
        const F square = off * off;
        F result = square;
        for (int i = 0; i < 4; ++i) {
            if (!square.lane[i].is_bounded()) continue;
            const RealInterval x = square.lane[i].range();
            result.lane[i] = Ranged(std::max(x.lo, 0.0), std::max(x.hi, 0.0));
        }
        return result;
    }

    const SampledTexture& map_;
};

template <TextureSlot slot, class Io>
requires std::same_as<typename Io::Number, Ranges>
class DistanceVolume<slot, Io> {
  public:
    using F = Ranges;

    explicit DistanceVolume(const Io& io) : map_(*io.template texture<slot>()) {}

    F layers() const { return F(double(map_.view.faces)); }
    vec2<F> size() const { return {F(double(map_.view.width[0])), F(double(map_.view.height[0]))}; }
    F operator()(const RangeMask& active, const vec2<F>& uv, const F& z) const {
        using namespace range_detail;
        const F at = clamp(z * layers() - F(0.5), F(0), layers() - F(1));
        F result(Ranged::anything());
        for (int i = 0; i < 4; ++i) {
            if (active.lane[i].known().state == RangeTruth::no || !at.lane[i].is_bounded())
                continue;
            const RealInterval k = at.lane[i].range();
            const double last = map_.view.faces - 1;
            TexelRange range = TexelRange::nothing();
            for (double below = std::floor(std::max(k.lo, 0.0)); below <= std::min(k.hi, last);
                 ++below) {
                const auto layer = [&](double l) {
                    return layer_range(map_, static_cast<int>(std::min(l, last)), false,
                                       uv.x.lane[i], uv.y.lane[i]);
                };
                range.include(blended(layer(below), layer(below + 1), weights_in(k, below)));
            }
            result.lane[i] = Ranged(filtered(range).channel[0]);
        }
        return result;
    }

  private:
    const SampledTexture& map_;
};

/// Longer than any ray: where a ray may run along a border.
template <Number F>
requires std::same_as<F, Ranges> F fall_to_cell_border(const vec2<F>& uv, const vec2<F>& K,
                                                       const vec2<F>& size) {
    constexpr double for_ever = 1e6;
    const auto axis = [&](const Ranged& u, const Ranged& rate, const Ranged& texels) -> Ranged {
        const Ranged place = u * texels - Ranged(0.5), speed = rate * texels;
        if (!place.is_bounded() || !speed.is_bounded()) return Ranged(0.0, for_ever);
        const RealInterval x = place.range(), v = speed.range();
        double least = for_ever, most = 0;
        const auto include = [&](double from, double to) {
            least = std::min(least, from);
            most = std::max(most, std::min(to, for_ever));
        };
        if (v.hi > 0)
            include((std::floor(x.lo) == std::floor(x.hi) ? std::floor(x.hi) + 1 - x.hi : 0) / v.hi,
                    v.lo > 0 ? 1 / v.lo : for_ever);
        if (v.lo < 0)
            include((std::ceil(x.lo) == std::ceil(x.hi) ? x.lo - std::ceil(x.lo) + 1 : 0) / -v.lo,
                    v.hi < 0 ? 1 / -v.hi : for_ever);
        if (v.has_zero()) most = for_ever;
        // The next border may be that of the same cell at most.
        if (v.lo > 0 && std::floor(x.lo) == std::floor(x.hi))
            most = std::min(most, (std::floor(x.lo) + 1 - x.lo) / v.lo);
        if (v.hi < 0 && std::ceil(x.lo) == std::ceil(x.hi))
            most = std::min(most, (x.hi - std::ceil(x.hi) + 1) / -v.hi);
        return range_detail::rounded({std::min(least, most), most},
                                     range_detail::budget().unit > 0 ? 8 : 0);
    };
    F fall;
    for (int lane = 0; lane < 4; ++lane)
        fall.lane[lane] = min(axis(uv.x.lane[lane], K.x.lane[lane], size.x.lane[lane]),
                              axis(uv.y.lane[lane], K.y.lane[lane], size.y.lane[lane]));
    return max(fall, F(0)) + F(1e-5);
}

namespace range_detail {

/// A number in one lane, and in the others the same.
inline Ranges everywhere(const RealInterval& x) { return Ranges(Ranged(x)); }
inline RangeMask only(int lane) {
    RangeMask mask(false);
    mask.lane[lane] = true;
    return mask;
}

/// A step by the cone under a piece of a lane's ray.
template <class Look, class Fall>
WalkStep cone_step(const SearchRay<Ranges>& ray, const Look& cone, const Fall& fall,
                   const RealInterval& tolerance, const RealInterval& piece, int lane) {
    const Aside aside;
    WalkStep step;
    const Ranges s = everywhere(piece);
    const vec2<Ranges> uv = ray.at(s);
    const Cone<Ranges> here = cone(only(lane), s, uv);
    Ranges gap = (Ranges(1) - s) - here.height;
    step.known = gap.lane[lane].is_bounded();
    if (!step.known) return step;
    const RealInterval of_gap = gap.lane[lane].range();
    step.height = here.height.lane[lane].range();
    step.ends = of_gap.lo <= tolerance.hi;
    step.goes_on = of_gap.hi > tolerance.lo;
    if (!step.goes_on) return step;
    gap.lane[lane] = Ranged(std::max(of_gap.lo, tolerance.lo), of_gap.hi);
    const Ranged to = min((s + fall(here, gap, uv)).lane[lane], Ranged(1.0, 1.0));
    step.known = to.is_bounded();
    if (step.known) step.to = {std::max(to.range().lo, piece.lo), std::min(to.range().hi, 1.0)};
    return step;
}

/// What halving the last step may come to in a lane: the end of a piece in which the field may be
/// reached, next to one in which it may not be.
template <class Look>
WalkPart bisected(const SearchRay<Ranges>& ray, const Look& cone, int times, const WalkPart& walk,
                  int lane) {
    constexpr int most_pieces = 256;
    const Aside aside;
    const double first = walk.from.lo, width = walk.s.hi - first;
    const double left = std::ldexp(width, -times) + 0x1p-40;
    const int pieces =
        static_cast<int>(std::clamp(width / (0.25 * left), 1.0, double(most_pieces)));
    WalkPart result{{walk.s.hi, walk.s.lo}, walk.from, walk.height};
    // The point above that is nearest, so far: the last step began at one.
    double above = walk.from.hi;
    for (int k = 0; k < pieces; ++k) {
        const RealInterval piece(first + width * k / pieces,
                                 k + 1 == pieces ? walk.s.hi : first + width * (k + 1) / pieces);
        const Ranges s = everywhere(piece);
        const Ranges height = cone(only(lane), s, ray.at(s)).height;
        const Ranged gap = ((Ranges(1) - s) - height).lane[lane];
        if (!gap.is_bounded()) return {{first, walk.s.hi}, walk.from, hull(walk.height, {0, 1})};
        if (gap.range().hi > 0) above = std::max(above, piece.hi);
        const bool reached = gap.range().lo <= 0 || piece.hi >= walk.s.lo;
        if (!reached || piece.lo > above + left) continue;
        const bool below = gap.range().hi <= 0 && piece.hi < walk.s.lo;
        const double last = below ? std::min(piece.hi, above + left) : piece.hi;
        result.s = {std::min(result.s.lo, piece.lo), std::max(result.s.hi, last)};
        result.height = hull(result.height, height.lane[lane].range());
    }
    if (result.s.lo > result.s.hi) result.s = walk.s;
    return result;
}

}  // namespace range_detail

/// Lane by lane, one of the ways that the walk may end.
template <Number F, class Look, class Fall>
requires std::same_as<F, Ranges> ConeWalk<F> walk_cones(const SearchRay<F>& ray, const Look& cone,
                                                        const Fall& fall, int most, F tolerance) {
    using namespace range_detail;
    static thread_local KnownWalks known;
    ConeWalk<F> walk(ray.active);
    RealInterval least_gap = tolerance.lane[0].range();
    // rounding_gap is a float's where arithmetic is.
    if (budget().unit > 0) least_gap.hi = std::max(least_gap.hi, double{rounding_gap<Quad<float>>});
    for (int lane = 0; lane < 4; ++lane) {
        walk.found.lane[lane] = false;
        if (ray.active.lane[lane].known().state == RangeTruth::no) continue;
        const WalkEnds& ends = known.of(ray, lane, [&] {
            return walk_parts(most, finest_piece(ray, lane), [&](const RealInterval& piece) {
                return cone_step(ray, cone, fall, least_gap, piece, lane);
            });
        });
        const WalkOutcome outcome = outcome_of(ends, lane);
        walk.s.lane[lane] = Ranged(outcome.s);
        walk.previous.lane[lane] = Ranged(outcome.from);
        walk.result.h.lane[lane] = outcome.known ? Ranged(outcome.height) : Ranged::anything();
        walk.result.status.lane[lane] =
            outcome.known ? statuses(outcome.first, outcome.last) : any_status();
        walk.found.lane[lane] = !outcome.known || outcome.first != outcome.last
                                    ? RangeTruth(RangeTruth::perhaps)
                                    : RangeTruth(outcome.first == Status::hit);
    }
    walk.active = RangeMask(false);
    walk.result.s = walk.s;
    walk.result.steps = walk.result.fetches = any_count();
    return walk;
}

template <Number F, class Look>
requires std::same_as<F, Ranges>
void bisect_last_step(const SearchRay<F>& ray, const Look& cone, int times, ConeWalk<F>& walk) {
    using namespace range_detail;
    for (int lane = 0; lane < 4; ++lane) {
        const RangeTruth found = walk.found.lane[lane].known();
        if (found.state == RangeTruth::no || times == 0) continue;
        const Ranged& height = walk.result.h.lane[lane];
        const WalkPart last{walk.s.lane[lane].range(), walk.previous.lane[lane].range(),
                            height.is_bounded() ? height.range() : RealInterval(0, 1)};
        WalkPart part = bisected(ray, cone, times, last, lane);
        if (found.state != RangeTruth::yes) part = {hull(part.s, last.s), part.from, part.height};
        walk.result.s.lane[lane] = Ranged(part.s);
        if (height.is_bounded()) walk.result.h.lane[lane] = Ranged(part.height);
    }
}

/// sphere-3d on ranges.
struct Sphere3dOnRanges : Sphere3d {
    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using namespace range_detail;
        const SearchRay<Ranges> ray = search_ray(io);
        const DistanceVolume<TextureSlot::distance_exact, Io> volume(io);
        const Ranges voxels = length(vec3<Ranges>(ray.K * volume.size(), volume.layers()));
        const Ranges reach = volume.layers() / voxels;
        static thread_local KnownWalks known;
        SearchResult<Ranges> result;
        for (int lane = 0; lane < 4; ++lane) {
            if (ray.active.lane[lane].known().state == RangeTruth::no) continue;
            const WalkEnds& ends = known.of(ray, lane, [&] {
                return walk_parts(
                    params.steps, finest_piece(ray, lane), [&](const RealInterval& piece) {
                        return step(ray, volume, reach, params.tolerance, piece, lane);
                    });
            });
            const WalkOutcome outcome = outcome_of(ends, lane);
            result.s.lane[lane] = Ranged(outcome.s);
            result.status.lane[lane] =
                outcome.known ? statuses(outcome.first, outcome.last) : any_status();
        }
        result.h = Ranges(1) - result.s;
        result.steps = result.fetches = any_count();
        result.flags = any_flags();
        store_search(io, ray, result);
    }

  private:
    template <class Volume>
    static range_detail::WalkStep step(const SearchRay<Ranges>& ray, const Volume& volume,
                                       const Ranges& reach, double tolerance,
                                       const RealInterval& piece, int lane) {
        using namespace range_detail;
        const Aside aside;
        WalkStep step;
        const Ranges s = everywhere(piece);
        const Ranged distance = volume(only(lane), ray.at(s), Ranges(1) - s).lane[lane];
        step.known = distance.is_bounded() && reach.lane[lane].is_bounded();
        if (!step.known) return step;
        const RealInterval along = (max(distance, Ranged(0.0, 0.0)) * reach.lane[lane]).range();
        step.ends = along.lo <= tolerance;
        step.goes_on = along.hi > tolerance;
        if (!step.goes_on) return step;
        const Ranged length(std::max(along.lo, tolerance), along.hi);
        const RealInterval to = (Ranged(piece) + length).range();
        step.at_bottom = to.hi >= 1;
        step.goes_on = to.lo < 1;
        step.to = {std::max(to.lo, piece.lo), std::min(to.hi, 1.0)};
        return step;
    }
};

namespace range_detail {

/// A field whose first hit may be leapt over: where cones lead to from places before it, all rays
/// may still be on their way.
template <class Look>
class LeaptOver {
  public:
    LeaptOver(const FieldHits& field, const SearchRay<Ranges>& ray, const Look& cone, int lane)
        : field_(field) {
        const int pieces = static_cast<int>(
            std::clamp(4 * field.places().speed(), double(least_pieces), double(most_pieces)));
        reach_.reserve(static_cast<std::size_t>(pieces));
        const Ranges kappa = length(ray.K);
        double farthest = 0;
        for (int k = 0; k < pieces; ++k) {
            const RealInterval piece(double(k) / pieces, double(k + 1) / pieces);
            farthest = std::max(farthest, reach_of(ray, cone, kappa, piece, lane));
            reach_.push_back(farthest);
        }
    }

    const RayPlaces& places() const { return field_.places(); }
    Meets meets(double from, double to) const { return field_.meets(from, to); }
    RealInterval height_in(const RealInterval& s) const { return field_.height_in(s); }
    bool holds_all(double at) const { return field_.holds_all(at) && reach_before(at) <= at; }

  private:
    static constexpr int least_pieces = 64, most_pieces = 1024;

    /// How far a cone under a piece of the ray may lead.
    static double reach_of(const SearchRay<Ranges>& ray, const Look& cone, const Ranges& kappa,
                           const RealInterval& piece, int lane) {
        const Aside aside;
        const Ranges s = everywhere(piece);
        const auto here = cone(only(lane), ray.at(s));
        const Ranges gap = (Ranges(1) - s) - here.channel[0];
        if (!gap.lane[lane].is_bounded()) return 1;
        if (gap.lane[lane].range().hi <= 0) return 0;  // the patch is met instead
        const Ranged to = (s + cone_step_length(gap, here.channel[1], kappa)).lane[lane];
        return to.is_bounded() ? to.range().hi : 1;
    }
    double reach_before(double at) const {
        if (at <= 0) return 0;
        const double pieces = static_cast<double>(reach_.size());
        const double last = std::min(std::ceil(at * pieces), pieces) - 1;
        return reach_[static_cast<std::size_t>(last)];
    }

    const FieldHits& field_;
    std::vector<double> reach_;
};

}  // namespace range_detail

/// cone-robust-exact on ranges: hits are on patches, none before the first; how late one may be is
/// how far cones before it lead.
struct ConeRobustExactOnRanges : ConeRobustExact {
    template <class Io>
    void operator()(Io& io, const Params&) const {
        using namespace range_detail;
        const SearchRay<Ranges> ray = search_ray(io);
        const BakedLookUp<TextureSlot::cone_robust, 2, Io> cone(io);
        const SampledTexture& map = *io.template texture<TextureSlot::height>();
        SearchResult<Ranges> result;
        for (int lane = 0; lane < 4; ++lane) {
            if (ray.active.lane[lane].known().state == RangeTruth::no) continue;
            take_any_hit(lane, result);
            const auto rays = ray_range(ray, lane);
            if (!rays) continue;
            const FieldHits field(map, oracle::Surface::bilinear, *rays);
            if (!field.places().are_short()) continue;
            const LeaptOver solid(field, ray, cone, lane);
            take_first_hits(solid, Status::floor, lane, result);
        }
        result.flags = any_flags();
        result.steps = result.fetches = any_count();
        store_search(io, ray, result);
    }
};

}  // namespace quadrel
