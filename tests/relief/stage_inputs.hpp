// Inputs for any stage of the registry: random quads, maps and lights, and every value that the
// stages before it would have handed on.
#pragma once

#include <algorithm>

#include "quadrel/bake/bake.hpp"
#include "relief/triangle.hpp"

namespace quadrel::test {

/// Which slots hold maps. Baking takes longer than all else.
enum class SlotsBound { all, not_baked };

/// A batch in which every value holds what a chain of corrected stages gives, and every slot a map
/// if so wanted.
/// Filters are bilinear, so that no value jumps; the plan and the seed decide everything.
class MadeInputs {
  public:
    Batch<float> batch;

    explicit MadeInputs(int seed, SlotsBound bound = SlotsBound::all)
        : random(static_cast<std::uint64_t>(seed)) {
        random_material(random, batch.material);
        batch.material.depth = static_cast<float>(random.uniform(0.01, 0.3));
        batch.frame.light_count = 2;
        for (LightUniforms& light : batch.frame.lights) random_light(random, light);
        for (int slot = 0; slot < texture_slot_count; ++slot)
            if (bound == SlotsBound::all || static_cast<TextureSlot>(slot) < first_baked_slot)
                bind(static_cast<TextureSlot>(slot));
        // What `interpolate` reads, before the values that it would store.
        fill_quads_of(batch, random_triangle(random, 0.2), random);
        batch.run("interpolate");
        fill_quads(batch, random);
        run_chain();
    }
    MadeInputs(const MadeInputs&) = delete;
    MadeInputs& operator=(const MadeInputs&) = delete;

  private:
    Random random;
    std::array<Map, texture_slot_count> maps;

    void bind(TextureSlot slot) {
        Map& map = maps[static_cast<std::size_t>(slot)];
        if (is_layers(slot)) {
            map = random_layers();
        } else if (slot >= TextureSlot::layer_normals_x && slot <= TextureSlot::color_4) {
            // Of a sequence of their own: the others' inputs stay what they were.
            Random normals(static_cast<std::uint64_t>(slot) + 78);
            map = random_map(normals, 4);
        } else if (slot == TextureSlot::prewarp) {
            map = random_prewarp();
        } else if (slot >= first_baked_slot) {
            map.texture = baked(slot);
            map.sampled.view = map.texture->view();
        } else {
            map = slot == TextureSlot::environment
                      ? random_cube(random)
                      : random_map(random, slot == TextureSlot::height ? 1 : 4);
        }
        map.sampled.sampler = plain_sampler();
        batch.bind(slot, map.sampled);
    }
    std::shared_ptr<const Texture> baked(TextureSlot slot) const {
        const Map& source = maps[static_cast<std::size_t>(source_of(slot))];
        return bake(*source.texture, bake_kind_from_name(slot_name(slot)), plain_sampler());
    }
    /// Sorted depths.
    static Map random_layers() {
        Random depths(77);
        std::array<float, 4> texel{};
        return make_map(
            23, 29, 4,
            [&](int, int, int c) {
                if (c == 0) {
                    for (float& depth : texel) depth = static_cast<float>(depths.uniform(0, 1));
                    std::sort(texel.begin(), texel.end());
                }
                return texel[static_cast<std::size_t>(c)];
            },
            plain_sampler());
    }
    /// What a warped image may hold: places, and here and there nothing. Over the square from
    /// (-1, -1) to (2, 2).
    static Map random_prewarp() {
        Random texel(78);
        Map map;
        TextureView view{};
        view.channels = 4;
        view.faces = 1;
        view.levels = 1;
        view.width[0] = 24;
        view.height[0] = 33;
        const auto texture =
            std::make_shared<Texture>(view, TexelFormat::float32, "random prewarp");
        float* const texels = texture->level_texels(0, 0);
        for (int i = 0; i < 24 * 32; ++i) {
            for (int c = 0; c < 3; ++c) texels[4 * i + c] = static_cast<float>(texel.uniform(0, 1));
            texels[4 * i + 3] = texel.chance(0.8) ? 1.0f : 0.0f;
        }
        const float area[] = {-1, -1, 1.0f / 3, 1.0f / 3};
        std::copy_n(area, 4, texels + 4 * 24 * 32);
        map.texture = texture;
        map.sampled.view = texture->view();
        return map;
    }
    void run_chain() {
        for (const char* id :
             {"differentiate", "lod", "frame-gram", "oracle", "linear", "displace", "h2n-thesis"}) {
            batch.run(id);
        }
        for (int light = 0; light < max_lights; ++light) {
            batch.run("shadow-march-thesis", {}, light);
        }
        batch.run("occlusion-none");
        batch.run("shade-thesis");
    }
};

/// The batch of a seed to run stages over; made once, since that takes longer than most stages.
struct StageInputs {
    Batch<float> batch;

    explicit StageInputs(int seed, SlotsBound bound = SlotsBound::all)
        : batch(made(seed, bound).batch) {}

  private:
    static const MadeInputs& made(int seed, SlotsBound bound) {
        static std::map<std::pair<int, SlotsBound>, MadeInputs> all;
        return all.try_emplace({seed, bound}, seed, bound).first->second;
    }
};

/// The same batch in double: equal values, uniforms and maps.
inline Batch<double> in_double(Batch<float>& from) {
    Batch<double> to(from.lanes);
    to.active = from.active;
    to.frame = from.frame;
    to.material = from.material;
    to.primitive = from.primitive;
    to.primitives = from.primitives;
    to.frames = from.frames;
    to.vertices = from.vertices;
    to.edges = from.edges;
    for (int slot = 0; slot < texture_slot_count; ++slot) {
        const auto* map = from.bound(static_cast<TextureSlot>(slot));
        if (map) to.bind(static_cast<TextureSlot>(slot), *map);
    }
    for (int i = 0; i < static_cast<int>(Value::count); ++i) {
        const auto v = static_cast<Value>(i);
        for (int lane = 0; lane < from.lanes; ++lane) {
            for (int light = 0; light < (info(v).per_light ? max_lights : 1); ++light) {
                if (info(v).kind == ValueKind::integer) {
                    to.integer(v, lane, light) = from.integer(v, lane, light);
                    continue;
                }
                for (int c = 0; c < info(v).components; ++c) {
                    to.real(v, lane, c, light) = from.real(v, lane, c, light);
                }
            }
        }
    }
    return to;
}

}  // namespace quadrel::test
