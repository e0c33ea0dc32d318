// Cube map look-ups of ranges: every face that the direction may be on.
#pragma once

#include "quadrel/texture/cube.hpp"
#include "quadrel/texture/range/sampler.hpp"

namespace quadrel {

namespace range_detail {

/// One level of a face, with the texels beyond its edges (cube.hpp).
class CubeTexels {
  public:
    CubeTexels(const SampledTexture& texture, int level, std::int32_t face)
        : view_(texture.view), level_(level), face_(face), size_(texture.view.width[level]) {}

    TexelValue at(double i, double j) const {
        const auto x = static_cast<std::int32_t>(i), y = static_cast<std::int32_t>(j);
        const std::int32_t inner_x = std::clamp(x, 0, size_ - 1);
        const std::int32_t inner_y = std::clamp(y, 0, size_ - 1);
        if (x == inner_x || y == inner_y) return stored(x, y);
        const TexelValue others[3] = {stored(inner_x, y), stored(x, inner_y),
                                      stored(inner_x, inner_y)};
        TexelValue mean;
        for (int c = 0; c < 4; ++c)
            mean.channel[c] =
                (others[0].channel[c] + others[1].channel[c] + others[2].channel[c]) / 3;
        return mean;
    }

  private:
    TexelValue stored(std::int32_t x, std::int32_t y) const {
        const CubeTexel<double> at = x < 0 || x >= size_ || y < 0 || y >= size_
                                         ? cross_edge(CubeTexel<double>{face_, x, y}, size_)
                                         : CubeTexel<double>{face_, x, y};
        const std::int64_t row = std::int64_t{at.face} * view_.height[level_] + at.y;
        const float* const texel = view_.texels + view_.offset[level_] +
                                   view_.channels * (row * view_.width[level_] + at.x);
        TexelValue value{{0, 0, 0, 1}};
        for (int c = 0; c < view_.channels; ++c) value.channel[c] = texel[c];
        return value;
    }

    const TextureView& view_;
    int level_;
    std::int32_t face_, size_;
};

/// A direction's components on a face: along s, along t, and outwards.
struct FaceVector {
    RealInterval s, t, out;
};
inline FaceVector on_face(std::int32_t face, const RealInterval (&v)[3]) {
    const RealInterval &x = v[0], &y = v[1], &z = v[2];
    switch (face) {
        case 0:
            return {-z, -y, x};
        case 1:
            return {z, -y, -x};
        case 2:
            return {x, z, y};
        case 3:
            return {x, -z, -y};
        case 4:
            return {x, -y, z};
        default:
            return {-x, -y, -z};
    }
}

/// What is left of a range within +-most.
inline RealInterval within(const RealInterval& x, double most) {
    return {std::clamp(x.lo, -most, most), std::clamp(x.hi, -most, most)};
}

/// Where a direction may be on a face; false if it may not.
inline bool meets_face(FaceVector& at) {
    const double least = std::max(size_of(at.s).lo, size_of(at.t).lo) * (1 - 0x1p-20);
    if (!(at.out.hi > 0) || at.out.hi < least) return false;
    at.out.lo = std::max(at.out.lo, least);
    at.s = within(at.s, at.out.hi);
    at.t = within(at.t, at.out.hi);
    return true;
}

/// Derivative of a face coordinate, 0.5 (|r| ds - s d|r|) / r^2.
inline RealInterval face_slope(const RealInterval& s, const RealInterval& out,
                               const RealInterval& ds, const RealInterval& dout) {
    return (RealInterval(0.5) * (out * ds - s * dout)) / square(out);
}

struct CubeLane {
    RealInterval direction[3], dx[3], dy[3];
    bool known = true, has_gradients = true;
};
inline CubeLane cube_lane(const vec3<Ranges>& direction, const vec3<Ranges>& dx,
                          const vec3<Ranges>& dy, int lane) {
    CubeLane result;
    for (int c = 0; c < 3; ++c) {
        result.known &= direction[c].lane[lane].is_bounded();
        result.has_gradients &= dx[c].lane[lane].is_bounded() && dy[c].lane[lane].is_bounded();
        result.direction[c] = direction[c].lane[lane].range();
        result.dx[c] = dx[c].lane[lane].range();
        result.dy[c] = dy[c].lane[lane].range();
    }
    return result;
}

/// Lambda on a face, before clamps.
inline Ranged cube_lambda(const SampledTexture& texture, const CubeLane& lane, std::int32_t face,
                          const FaceVector& at) {
    if (!lane.has_gradients) return Ranged::anything();
    const FaceVector dx = on_face(face, lane.dx), dy = on_face(face, lane.dy);
    const RealInterval size(texture.view.width[0]);
    const RealInterval x[2] = {face_slope(at.s, at.out, dx.s, dx.out) * size,
                               face_slope(at.t, at.out, dx.t, dx.out) * size};
    const RealInterval y[2] = {face_slope(at.s, at.out, dy.s, dy.out) * size,
                               face_slope(at.t, at.out, dy.t, dy.out) * size};
    const LodForm form = texture.sampler.lod_form;
    const RealInterval level = level_of_rho(form, permitted_rho(form, x, y));
    const double bias = texture.sampler.lod_bias, off = budget().lod + 0x1p-6;
    return Ranged(widened({level.lo + bias, level.hi + bias}, off));
}

/// A face coordinate as a texel coordinate: within the face.
inline RealInterval face_texels(const RealInterval& s, const RealInterval& out, std::int32_t size) {
    const RealInterval part = within(s / out, 1);
    const RealInterval x =
        texel_coordinates(RealInterval(0.5) * part + RealInterval(0.5), size, {});
    const RealInterval wide = widened(x, size * (budget().unit > 0 ? 0x1p-21 : 0x1p-45));
    return {std::clamp(wide.lo, 0.0, double(size)), std::clamp(wide.hi, 0.0, double(size))};
}

inline TexelRange face_range(const SampledTexture& texture, int lane, const Ranged& lambda,
                             std::int32_t face, const FaceVector& at) {
    return look_up(texture, lane, lambda, [&](int level, Filter filter) {
        const CubeTexels texels(texture, level, face);
        const std::int32_t size = texture.view.width[level];
        const RealInterval x = face_texels(at.s, at.out, size), y = face_texels(at.t, at.out, size);
        const RealInterval inner_x(std::min(x.lo, size - 1.0), std::min(x.hi, size - 1.0));
        const RealInterval inner_y(std::min(y.lo, size - 1.0), std::min(y.hi, size - 1.0));
        TexelRange range = TexelRange::nothing();
        const bool done = filter == Filter::linear
                              ? include_linear(range, texels, x, y)
                              : include_nearest(range, texels, inner_x, inner_y);
        return done ? range : whole_map(texture);
    });
}

template <class Lambda>
TexelRange cube_range(const SampledTexture& texture, int number, const CubeLane& lane,
                      const Lambda& lambda) {
    if (!lane.known) return filtered(texture, whole_map(texture));
    TexelRange range = TexelRange::nothing();
    int faces = 0;
    for (std::int32_t face = 0; face < 6; ++face) {
        FaceVector at = on_face(face, lane.direction);
        if (!meets_face(at)) continue;
        if (at.out.lo <= 0) return filtered(texture, whole_map(texture));
        if (++faces > 1) range_context().undecided[number] |= Undecided::cube_face;
        range.include(face_range(texture, number, lambda(face, at), face, at));
    }
    return range;
}

}  // namespace range_detail

inline vec4<Ranges> texture_cube_grad(const SampledTexture& texture,
                                      const SampleContext<Ranges>& context,
                                      const vec3<Ranges>& direction, const vec3<Ranges>& dx,
                                      const vec3<Ranges>& dy, LodRecord<Ranges>* = nullptr) {
    using namespace range_detail;
    TexelRange lanes[4];
    for (int i = 0; i < 4; ++i) {
        const CubeLane lane = cube_lane(direction, dx, dy, i);
        lanes[i] = asks(context, i) ? cube_range(texture, i, lane,
                                                 [&](std::int32_t face, const FaceVector& at) {
                                                     return cube_lambda(texture, lane, face, at);
                                                 })
                                    : unasked();
    }
    return packet_of(lanes);
}
inline vec4<Ranges> texture_cube_lod(const SampledTexture& texture,
                                     const SampleContext<Ranges>& context,
                                     const vec3<Ranges>& direction, const Ranges& level) {
    using namespace range_detail;
    const LodRecord<Ranges> lod = lod_from_level(texture, level);
    TexelRange lanes[4];
    for (int i = 0; i < 4; ++i)
        lanes[i] =
            asks(context, i)
                ? cube_range(texture, i, cube_lane(direction, direction, direction, i),
                             [&](std::int32_t, const FaceVector&) { return lod.lambda.lane[i]; })
                : unasked();
    return packet_of(lanes);
}

}  // namespace quadrel
