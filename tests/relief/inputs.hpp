// Random fragments, maps and uniforms for stages: planes at any tilt, UV maps sheared and mirrored,
// sampled at the pixel centres of quads.
#pragma once

#include "quadrel/num/vec.hpp"
#include "quadrel/texture/texture.hpp"
#include "relief/harness.hpp"

namespace quadrel::test {

using dvec2 = vec2<double>;
using dvec3 = vec3<double>;

/// A texture and how it is sampled.
struct Map {
    std::shared_ptr<const Texture> texture;
    SampledTexture sampled{};
};

/// A map of float texels value(x, y, channel), level 0 alone unless the sampler has a mip filter.
inline Map make_map(int width, int height, int channels,
                    const std::function<float(int, int, int)>& value, const SamplerState& sampler) {
    Image image;
    image.width = width;
    image.height = height;
    image.channels = channels;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c) image.values.push_back(value(x, y, c));
    TextureOptions options;
    options.mip_rule = sampler.mip == MipFilter::none ? MipRule::none : MipRule::box;
    Map map{make_texture(image, options)};
    map.sampled = {map.texture->view(), sampler};
    return map;
}

/// Bilinear, level 0, repeating.
inline SamplerState plain_sampler(Wrap wrap = Wrap::repeat) {
    SamplerState s;
    s.wrap_u = s.wrap_v = wrap;
    s.mip = MipFilter::none;
    return s;
}
inline Map height_map(int width, int height, const std::function<float(int, int)>& h,
                      Wrap wrap = Wrap::repeat) {
    return make_map(
        width, height, 1, [&](int x, int y, int) { return h(x, y); }, plain_sampler(wrap));
}
inline Map flat_map(float h, int size = 4) {
    return height_map(size, size, [h](int, int) { return h; });
}
inline Map noise_map(Random& random, int width, int height, Wrap wrap = Wrap::repeat) {
    return height_map(
        width, height, [&](int, int) { return static_cast<float>(random.uniform(0, 1)); }, wrap);
}

inline SamplerState random_sampler(Random& random) {
    SamplerState s;
    s.wrap_u = static_cast<Wrap>(random.below(5));
    s.wrap_v = static_cast<Wrap>(random.below(5));
    s.mag = static_cast<Filter>(random.chance(0.8));
    s.min = static_cast<Filter>(random.chance(0.8));
    s.mip = static_cast<MipFilter>(random.below(3));
    return s;
}
/// 16 to 64 texels a side, independent texels in [0, 1], any sampler.
inline Map random_map(Random& random, int channels) {
    const int width = 16 + random.below(49), height = 16 + random.below(49);
    const SamplerState sampler = random_sampler(random);
    return make_map(
        width, height, channels,
        [&](int, int, int) { return static_cast<float>(random.uniform(0, 1)); }, sampler);
}
inline Map random_cube(Random& random) {
    std::array<Image, 6> faces;
    for (Image& face : faces) {
        face.width = face.height = 8;
        face.channels = 3;
        for (int i = 0; i < 8 * 8 * 3; ++i) {
            face.values.push_back(static_cast<float>(random.uniform(0, 1)));
        }
    }
    Map map{make_cube_texture(faces)};
    map.sampled = {map.texture->view(), random_sampler(random)};
    return map;
}

inline dvec3 random_direction(Random& random) {
    for (;;) {
        const dvec3 v(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        const double squared = dot(v, v);
        if (squared > 0.01 && squared < 1) return v / std::sqrt(squared);
    }
}

/// A plane in eye space with an affine UV map: uv = uv0 + (u, v) at origin + u dPdu + v dPdv.
struct Plane {
    dvec3 origin, normal, dPdu, dPdv;
    dvec2 uv0;

    dvec2 uv(const dvec3& P) const {
        const dvec3 n = cross(dPdu, dPdv);
        const dvec3 gu = cross(dPdv, n) / dot(n, n), gv = cross(n, dPdu) / dot(n, n);
        return uv0 + dvec2(dot(gu, P - origin), dot(gv, P - origin));
    }
};

/// Coordinates (along, across) in a plane, as a vector; `along` is any direction in it.
inline dvec3 in_plane(const dvec3& normal, const dvec3& along, double x, double y) {
    return along * x + cross(normal, along) * y;
}

/// In front of the eye, its normal on the viewer's side, at most about 87 degrees from the view
/// ray; u and v 30 to 150 degrees apart, mirrored half of the time.
inline Plane random_plane(Random& random) {
    Plane plane;
    const double z = random.uniform(1, 5);
    plane.origin = {random.uniform(-0.6, 0.6) * z, random.uniform(-0.6, 0.6) * z, -z};
    const dvec3 V = normalize(-plane.origin);
    do {
        plane.normal = random_direction(random);
        if (dot(plane.normal, V) < 0) plane.normal = -plane.normal;
    } while (dot(plane.normal, V) < 0.05);
    const dvec3 along = normalize(cross(plane.normal, random_direction(random)));
    const double u_scale = random.uniform(0.3, 4), v_scale = random.uniform(0.3, 4);
    const double shear = random.uniform(-1.7, 1.7);
    plane.dPdu = along * u_scale;
    plane.dPdv = in_plane(plane.normal, along, shear, random.chance(0.5) ? 1 : -1) *
                 (v_scale / std::sqrt(1 + shear * shear));
    plane.uv0 = {random.uniform(-3, 3), random.uniform(-3, 3)};
    return plane;
}

/// Where the ray through the window point of `near`, moved by `pixels` of the given size, meets the
/// plane.
inline dvec3 on_plane(const Plane& plane, const dvec2& pixels, double pixel_size) {
    const dvec3 ray = plane.origin / -plane.origin.z + dvec3(pixels * pixel_size, 0.0);
    return ray * (dot(plane.normal, plane.origin) / dot(plane.normal, ray));
}

/// Fills P, uv, Ng and vertex_normal of a quad's four lanes from a plane; the vertex normals lean
/// away from the plane's by up to `lean` a component, and are not normalised. Window y points up
/// or down.
template <PlainFloat T>
void fill_quad(Batch<T>& batch, int quad, const Plane& plane, Random& random, double lean = 0.3,
               double pixel_size = 1.0 / 400) {
    const dvec3 smooth = plane.normal + random_direction(random) * lean;
    const dvec3 bend = random_direction(random) * (lean * 0.05);
    const double scale = random.uniform(0.5, 2), down = random.chance(0.5) ? 1 : -1;
    for (int i = 0; i < 4; ++i) {
        const int lane = 4 * quad + i;
        const dvec2 pixels(i % 2, i / 2 * down);
        const dvec3 P = on_plane(plane, pixels, pixel_size);
        // The same rounded inputs for every number type.
        batch.set(Value::P, lane, vec3<float>(P));
        batch.set(Value::uv, lane, vec2<float>(plane.uv(P)));
        batch.set(Value::Ng, lane, vec3<float>(plane.normal));
        batch.set(Value::vertex_normal, lane,
                  vec3<float>((smooth + bend * (pixels.x + pixels.y)) * scale));
    }
}

/// Random quads, each on a plane of its own.
template <PlainFloat T>
void fill_quads(Batch<T>& batch, Random& random, double lean = 0.3) {
    for (int quad = 0; quad < batch.lanes / 4; ++quad) {
        fill_quad(batch, quad, random_plane(random), random, lean);
    }
}

inline void random_colour(Random& random, float (&colour)[3]) {
    for (float& c : colour) c = static_cast<float>(random.uniform(0, 1));
}

/// A point light somewhere around the planes of random_plane, and random colours.
inline void random_light(Random& random, LightUniforms& light) {
    light.directional = 0;
    for (float& x : light.position) x = static_cast<float>(random.uniform(-6, 6));
    random_colour(random, light.ambient);
    random_colour(random, light.diffuse);
    random_colour(random, light.specular);
    light.intensity = static_cast<float>(random.uniform(0, 2));
    for (float& x : light.attenuation) x = static_cast<float>(random.uniform(0.1, 1));
}
inline void random_material(Random& random, MaterialUniforms& material) {
    material.depth = random.chance(0.1) ? 0.0f : static_cast<float>(random.uniform(0, 1.5));
    material.seat = random.chance(0.5) ? 1.0f : static_cast<float>(random.uniform(0, 1));
    random_colour(random, material.ambient);
    random_colour(random, material.diffuse);
    random_colour(random, material.specular);
    random_colour(random, material.emission);
    material.shininess = static_cast<float>(random.uniform(0, 100));
}

/// The maps of a random material; a map that it lacks is not bound.
struct RandomMaterial {
    std::array<Map, texture_slot_count> maps;

    RandomMaterial(Random& random, Batch<float>& batch) {
        random_material(random, batch.material);
        random_light(random, batch.frame.lights[0]);
        bind(batch, TextureSlot::height, random_map(random, 1));
        if (random.chance(0.9)) bind(batch, TextureSlot::color, random_map(random, 4));
        if (random.chance(0.7)) bind(batch, TextureSlot::gloss, random_map(random, 4));
        if (random.chance(0.5)) bind(batch, TextureSlot::emissive, random_map(random, 4));
        if (random.chance(0.7)) bind(batch, TextureSlot::environment, random_cube(random));
    }

  private:
    void bind(Batch<float>& batch, TextureSlot slot, Map map) {
        maps[static_cast<std::size_t>(slot)] = std::move(map);
        batch.bind(slot, maps[static_cast<std::size_t>(slot)].sampled);
    }
};

}  // namespace quadrel::test
