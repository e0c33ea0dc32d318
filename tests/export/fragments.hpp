// Random fragments and maps for the exported functions, and the same stage run on them as it is.
#pragma once

#include <algorithm>
#include <cstring>
#include <limits>
#include <vector>

#include "export/exported.hpp"
#include "export/shell_inputs.hpp"
#include "export/stages/plain_maps.hpp"
#include "kernels/table.hpp"
#include "quadrel/quad/stage.hpp"
#include "random.hpp"

namespace quadrel::export_tests {

/// An array for each slot, of values and of what shells have beside them.
class SlotArrays {
  public:
    SlotArrays() : values_(static_cast<std::size_t>(all_slots) * batch_lanes) {
        for (int slot = 0; slot < all_slots; ++slot) pointers_[slot] = at(slot);
    }
    SlotArrays(const SlotArrays&) = delete;
    SlotArrays& operator=(const SlotArrays&) = delete;

    float* at(int slot) { return values_.data() + static_cast<std::size_t>(slot) * batch_lanes; }
    const float* at(int slot) const {
        return values_.data() + static_cast<std::size_t>(slot) * batch_lanes;
    }
    std::int32_t integer(int slot, int lane) const {
        std::int32_t value;
        std::memcpy(&value, at(slot) + lane, sizeof value);
        return value;
    }
    void set(int slot, int lane, std::int32_t value) {
        std::memcpy(at(slot) + lane, &value, sizeof value);
    }
    void* const* pointers() const { return pointers_; }

  private:
    std::vector<float> values_;
    void* pointers_[all_slots];
};

/// Maps that fit the scene of the exported functions, of random texels; some are no numbers.
class RandomMaps {
  public:
    RandomMaps(test::Random& random, bool nans) {
        for (int slot = 0; slot < texture_slot_count; ++slot) {
            SampledTexture& map = maps_[slot];
            map = {recorded::plain_view(static_cast<TextureSlot>(slot), exported_side), {}};
            std::vector<float>& texels = texels_[slot];
            // Layers and tables go on behind the last level, where texels come again.
            constexpr std::size_t most = 400000, different = 20011;
            texels.resize(slot < static_cast<int>(first_baked_slot) ? texels_of(map.view) : most);
            map.view.texels = texels.data();
            if (source_of(static_cast<TextureSlot>(slot)) == TextureSlot::layers) continue;
            const std::size_t made = std::min(texels.size(), different);
            for (std::size_t i = 0; i < made; ++i)
                texels[i] = static_cast<float>(random.uniform(0, 1));
            for (std::size_t i = made; i < texels.size(); i += made)
                std::copy_n(texels.begin(), std::min(made, texels.size() - i),
                            texels.begin() + static_cast<std::ptrdiff_t>(i));
        }
        shape_heights(random, nans);
        raise_pyramid();
        stack_layers(nans);
        bound_layers();
        scatter_distances(random);
    }

    const SampledTexture& map(int slot) const { return maps_[slot]; }

  private:
    static std::size_t texels_of(const TextureView& view) {
        const int last = view.levels - 1;
        return static_cast<std::size_t>(view.offset[last]) +
               static_cast<std::size_t>(view.channels * view.faces * view.width[last] *
                                        view.height[last]);
    }
    /// Columns at half the height, where rays meet the surface exactly at a sample; low ones, which
    /// rays pass; of nothing, which they come to last; and any.
    void shape_heights(test::Random& random, bool nans) {
        const TextureView& view = maps_[static_cast<int>(TextureSlot::height)].view;
        std::vector<float>& texels = texels_[static_cast<int>(TextureSlot::height)];
        for (int level = 0; level < view.levels; ++level) {
            const int side = view.width[level];
            for (int i = 0; i < side * side; ++i) {
                float& texel = texels[static_cast<std::size_t>(view.offset[level] + i)];
                const int part = i % side * 4 / side;
                texel = part == 0 ? 0.5f : part == 2 ? 0.0f : part == 1 ? 0.3f * texel : texel;
                if (nans && random.chance(0.01)) texel = std::numeric_limits<float>::quiet_NaN();
            }
        }
    }
    /// Sorted depths on level 0, some of them equal; coarser levels are those of a corner.
    void stack_layers(bool nans) {
        test::Random random(7);
        std::vector<float>& texels = texels_[static_cast<int>(TextureSlot::layers)];
        for (std::size_t i = 0; i + 3 < texels.size(); i += 4) {
            float* const depths = texels.data() + i;
            for (int c = 0; c < 4; ++c) depths[c] = static_cast<float>(random.uniform(0.1, 1));
            std::sort(depths, depths + 4);
            if (random.chance(0.4)) depths[1] = depths[0];
            if (random.chance(0.4)) depths[3] = depths[2];
            if (nans && random.chance(0.01)) depths[1] = std::numeric_limits<float>::quiet_NaN();
        }
    }
    /// Bounds that hold: of each cell's corners, then of nodes.
    void bound_layers() {
        const TextureView& layers = maps_[static_cast<int>(TextureSlot::layers)].view;
        const TextureView& bounds = maps_[static_cast<int>(TextureSlot::layer_bounds)].view;
        std::vector<float>& texels = texels_[static_cast<int>(TextureSlot::layer_bounds)];
        for (int level = 0; level < bounds.levels; ++level) {
            const TextureView& below = level == 0 ? layers : bounds;
            const int side = bounds.width[level], from_level = std::max(level - 1, 0);
            const int from_side = below.width[from_level], stride = level == 0 ? 1 : 2;
            const float* const from = below.texels + below.offset[from_level];
            for (int i = 0; i < 4 * side * side; ++i) {
                const int x = i / 4 % side, y = i / 4 / side, c = i % 4;
                float& to = texels[static_cast<std::size_t>(bounds.offset[level] + i)];
                to = c % 2 == 0 ? 2.0f : -1.0f;
                for (int tap = 0; tap < 4; ++tap) {
                    const int column = (x * stride + tap % 2) % from_side;
                    const int row = (y * stride + tap / 2) % from_side;
                    const float depth = from[(row * from_side + column) * 4 + c];
                    if (c % 2 == 0 ? !(depth >= to) : !(depth <= to)) to = depth;
                }
            }
        }
    }
    /// Distances that end within a box or beyond it, and -1, where a ray passes.
    void scatter_distances(test::Random& random) {
        for (const TextureSlot slot : {TextureSlot::gdm, TextureSlot::vdm}) {
            const TextureView& view = maps_[static_cast<int>(slot)].view;
            std::vector<float>& texels = texels_[static_cast<int>(slot)];
            const int count = view.offset[1];
            for (int i = 0; i < count; ++i) {
                float& distance = texels[static_cast<std::size_t>(i)];
                distance *= random.chance(0.5) ? 0.3f : 1.0f;
                if (slot == TextureSlot::vdm && random.chance(0.2)) distance = -1;
                if (random.chance(0.0005)) distance = std::numeric_limits<float>::quiet_NaN();
            }
        }
    }
    /// Bounds that hold, so that searches come to the surface: level 0 over the cells, then up.
    void raise_pyramid() {
        const TextureView& heights = maps_[static_cast<int>(TextureSlot::height)].view;
        const TextureView& bounds = maps_[static_cast<int>(TextureSlot::max_mip)].view;
        std::vector<float>& texels = texels_[static_cast<int>(TextureSlot::max_mip)];
        const int n = heights.width[0];
        for (int level = 0; level < bounds.levels; ++level) {
            const int side = bounds.width[level], below = level == 0 ? n : bounds.width[level - 1];
            const float* const from =
                level == 0 ? heights.texels : texels.data() + bounds.offset[level - 1];
            const int stride = level == 0 ? 1 : 2;
            for (int i = 0; i < side * side; ++i) {
                float& to = texels[static_cast<std::size_t>(bounds.offset[level] + i)];
                to = 0;
                for (int tap = 0; tap < 4; ++tap) {
                    const int x = (i % side * stride + tap % 2) % below;
                    const int y = (i / side * stride + tap / 2) % below;
                    const float h = from[y * below + x];
                    if (!(h <= to)) to = h;
                }
            }
        }
    }

    SampledTexture maps_[texture_slot_count];
    std::vector<float> texels_[texture_slot_count];
};

/// Inputs as stages meet them, and worse ones.
inline void fill_inputs(SlotArrays& arrays, test::Random& random) {
    for (int v = 0; v < static_cast<int>(Value::count); ++v) {
        const auto value = static_cast<Value>(v);
        const bool is_integer = info(value).kind == ValueKind::integer;
        for (int slot = slot_of(value); slot < slot_of(value) + arrays_of(value); ++slot)
            for (int lane = 0; lane < batch_lanes; ++lane) {
                if (is_integer)
                    arrays.set(slot, lane, random.below(64));
                else
                    arrays.at(slot)[lane] = static_cast<float>(random.uniform(-1, 1));
            }
    }
    const auto any = [&](Value value, int component) -> float* {
        return arrays.at(slot_of(value) + component);
    };
    for (int lane = 0; lane < batch_lanes; ++lane) {
        any(Value::P, 2)[lane] -= 2;
        any(Value::relief_depth, 0)[lane] = static_cast<float>(random.uniform(0.01, 1));
        const float footprint = random.chance(0.1) ? 1.0f : 0.03f;
        for (const Value gradient : {Value::dUVdx, Value::dUVdy})
            for (int c = 0; c < 2; ++c) any(gradient, c)[lane] *= footprint;
        any(Value::r, 0)[lane] = static_cast<float>(random.uniform(0, 1));
        const double shift = random.chance(0.1) ? 5 : 0.4;
        for (int c = 0; c < 2; ++c) any(Value::K, c)[lane] *= static_cast<float>(shift);
        if (lane % 17 == 0) any(Value::K, 0)[lane] = 0;
        if (lane % 29 == 0)
            for (int c = 0; c < 3; ++c) any(Value::dPdy, c)[lane] = any(Value::dPdx, c)[lane];
        for (const Value status : {Value::frame_status, Value::hit_status})
            arrays.set(slot_of(status), lane, lane % 13 == 0 ? random.below(8) : 1);
        if (lane % 19 == 5) any(Value::uv, 0)[lane] = std::numeric_limits<float>::quiet_NaN();
        if (lane % 23 == 9) any(Value::K, 1)[lane] = std::numeric_limits<float>::infinity();
    }
}

inline FrameUniforms random_frame(test::Random& random) {
    FrameUniforms frame = recorded::plain_frame(exported_lights);
    const auto fill = [&](float* to, int count) {
        for (int i = 0; i < count; ++i) to[i] = static_cast<float>(random.uniform(-1, 1));
    };
    fill(frame.eye_to_world, 9);
    fill(frame.projection, 16);
    frame.depth_scale = 0.5f;
    frame.depth_offset = 0.25f;
    for (int i = 0; i < frame.light_count; ++i)
        for (float* to : {frame.lights[i].position, frame.lights[i].ambient,
                          frame.lights[i].diffuse, frame.lights[i].specular})
            fill(to, 3);
    return frame;
}

}  // namespace quadrel::export_tests
