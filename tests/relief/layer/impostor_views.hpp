// Two spheres in the depth layers of an impostor, and views of them from all sides.
#pragma once

#include "relief/layer/layer_maps.hpp"

namespace quadrel::test::impostor {

/// Two spheres along z in a volume of 2 x 2 x 3 units around the origin, and what is nearest along
/// a ray.
struct Ball {
    dvec3 centre;
    double radius;
};
constexpr double tile = 2, thickness = 3;
inline const std::vector<Ball>& balls() {
    static const std::vector<Ball> all{{dvec3(0.1, -0.05, 0.8), 0.6}, {dvec3(0, 0.1, -0.85), 0.5}};
    return all;
}

constexpr double never = 1e9;
/// The least t at which origin + t direction (unit) is in a ball, grown by `more`.
inline double meets(const dvec3& origin, const dvec3& direction, double more = 0) {
    double nearest = never;
    for (const Ball& ball : balls()) {
        const dvec3 to = ball.centre - origin;
        const double along = dot(to, direction), radius = ball.radius + more;
        const double half = radius * radius - (dot(to, to) - along * along);
        if (half >= 0) nearest = std::min(nearest, along - std::sqrt(half));
    }
    return nearest;
}

/// Front and back of a ball under a texel, as depths; in its middle where it is not.
inline std::array<float, 2> ball_depths(const Ball& ball, double x, double y) {
    const double aside =
        (x - ball.centre.x) * (x - ball.centre.x) + (y - ball.centre.y) * (y - ball.centre.y);
    const double half = std::sqrt(std::max(ball.radius * ball.radius - aside, 0.0));
    const auto depth = [&](double z) { return static_cast<float>(0.5 - z / thickness); };
    return {depth(ball.centre.z + half), depth(ball.centre.z - half)};
}

constexpr int side = 128;
/// Four depths of every texel; `pairs` are balls, or none (-1): closed at the bottom.
inline Map depths_map(const std::array<int, 2>& pairs) {
    SamplerState sampler = plain_sampler();
    sampler.wrap_u = sampler.wrap_v = Wrap::clamp_to_edge;
    return make_map(
        side, side, 4,
        [&](int i, int j, int c) {
            const int ball = pairs[static_cast<std::size_t>(c / 2)];
            if (ball < 0) return 1.0f;
            const auto at = [](int k) { return ((k + 0.5) / side - 0.5) * tile; };
            return ball_depths(balls()[static_cast<std::size_t>(ball)], at(i),
                               at(j))[static_cast<std::size_t>(c % 2)];
        },
        sampler);
}

struct Maps {
    Map both = depths_map({0, 1}), first = depths_map({0, -1}), second = depths_map({1, -1}),
        nothing = depths_map({-1, -1});
};
inline const Maps& maps() {
    static const Maps all;
    return all;
}

/// A view of the volume: an object turned at will, far from the eye or near, and a card through its
/// origin.
struct View {
    dvec3 x, y, z;    ///< the object's axes in eye space, unit
    dvec3 origin;     ///< the object's
    double scale;     ///< eye-space units of one of the object's
    dvec3 right, up;  ///< of the card

    explicit View(Random& random) {
        z = random_direction(random);
        x = normalize(cross(z, random_direction(random)));
        y = cross(z, x);
        scale = random.uniform(0.3, 3);
        const dvec3 towards = normalize(random_direction(random) * 0.3 + dvec3(0, 0, -1));
        origin = towards * (scale * random.uniform(3, 9));
        right = normalize(cross(towards, dvec3(0.1, 1, 0)));
        up = cross(right, towards);
    }
    /// A point or vector of eye space in the object's.
    dvec3 in_object(const dvec3& v) const { return dvec3(dot(x, v), dot(y, v), dot(z, v)) / scale; }
};

template <PlainFloat T>
void fill_lane(Batch<T>& batch, int lane, const View& view, Random& random) {
    const double a = random.uniform(-1.7, 1.7), b = random.uniform(-1.7, 1.7);
    batch.set(Value::P, lane, view.origin + (view.right * a + view.up * b) * view.scale);
    batch.set(Value::uv, lane, dvec2(a / tile + 0.5, b / tile + 0.5));
    for (int c = 0; c < 3; ++c) {
        batch.real(Value::face_J, lane, c) = static_cast<T>(view.right[c] / (tile * view.scale));
        batch.real(Value::face_J, lane, 3 + c) = static_cast<T>(view.up[c] / (tile * view.scale));
    }
    // Of a normal matrix.
    batch.set(Value::object_x, lane, view.x / view.scale);
    batch.set(Value::object_y, lane, view.y / view.scale);
    batch.set(Value::object_z, lane, view.z / view.scale);
    batch.real(Value::relief_depth, lane) = static_cast<T>(thickness * view.scale);
}

/// The bilinear depth of a layer at uv; of maps that are clamped.
inline double depth_at(const Map& map, const dvec2& uv, int layer) {
    const auto place = [](double x) { return std::clamp(x * side - 0.5, 0.0, side - 1.0 - 1e-9); };
    const double x = place(uv.x), y = place(uv.y);
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const double f = x - i, g = y - j;
    const auto texel = [&](int di, int dj) {
        return double(map.sampled.view.texels[((j + dj) * side + i + di) * 4 + layer]);
    };
    return (texel(0, 0) * (1 - f) + texel(1, 0) * f) * (1 - g) +
           (texel(0, 1) * (1 - f) + texel(1, 1) * f) * g;
}

}  // namespace quadrel::test::impostor
