// Runs stages of the registry by id over arrays that a test owns: a batch as the renderer makes it,
// without geometry, planning or files. Serves every stage, those of later algorithms included.
//
//     Batch<float> batch;                          // or double: the number type's scalar
//     batch.bind(TextureSlot::height, map);        // SampledTexture; must outlive the batch's runs
//     batch.real(Value::uv, lane, 0) = 0.25f;      // inputs, lane by lane
//     batch.run("linear", {{"steps", 64}});
//     batch.integer(Value::hit_status, lane)       // outputs
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "kernels/table.hpp"
#include "quadrel/check.hpp"
#include "quadrel/relief/registry.hpp"
#include "random.hpp"

namespace quadrel::test {

/// Neutral uniforms: eye at the origin, fine derivatives, one white light at (10, 10, 10) in eye
/// space, and a white material without depth.
inline FrameUniforms default_frame() {
    FrameUniforms frame{};
    for (int i = 0; i < 3; ++i) frame.eye_to_world[4 * i] = 1;
    frame.derivatives = DerivativeMode::fine;
    frame.light_count = 1;
    for (LightUniforms& light : frame.lights) {
        light = {{10, 10, 10}, 0, {0.1f, 0.1f, 0.1f}, {1, 1, 1}, {1, 1, 1}, 1, {1, 0, 0}};
    }
    return frame;
}
inline MaterialUniforms default_material() {
    MaterialUniforms material{};
    material.seat = 1;
    for (int i = 0; i < 3; ++i)
        material.ambient[i] = material.diffuse[i] = material.specular[i] = 1;
    material.shininess = 50;
    return material;
}

using Parameters = std::map<std::string, double>;

/// Up to 256 lanes of every value of value.hpp. T is float or double.
template <PlainFloat T>
class Batch {
  public:
    explicit Batch(int lane_count = batch_lanes) : lanes(lane_count), active(lane_count, 1) {
        block_.resize(std::size_t(slot_count) * lines_a_slot());
        wanted_.fill(true);
        for (auto& edge : edges) edge.resize(lane_count);
        primitive.resize(lane_count);
        poison_all();
    }

    int lanes;
    std::vector<std::uint32_t> active;
    FrameUniforms frame = default_frame();
    MaterialUniforms material = default_material();
    std::array<FetchCounters, texture_slot_count> counters{};  ///< by slot
    std::uint64_t fetches() const {
        std::uint64_t sum = 0;
        for (const FetchCounters& slot : counters) sum += slot.fetches;
        return sum;
    }
    std::array<std::vector<double>, 3> edges;  ///< what `interpolate` reads, with:
    std::vector<std::int32_t> primitive;
    std::vector<PrimitiveData> primitives;
    std::vector<PrimitiveFrame> frames;       ///< parallel to `primitives`, or empty
    std::vector<PrimitiveVertices> vertices;  ///< likewise
    StageLog* log = nullptr;                  ///< what a probe would see; float alone
    bool own_depth = false;  ///< false: relief_depth is material.depth at every run

    void bind(TextureSlot slot, const SampledTexture& map) {
        textures_[static_cast<int>(slot)] = &map;
    }
    const SampledTexture* bound(TextureSlot slot) const {
        return textures_[static_cast<int>(slot)];
    }
    void unbind(TextureSlot slot) { textures_[static_cast<int>(slot)] = nullptr; }

    T& real(Value v, int lane, int component = 0, int light = 0) {
        QUADREL_CHECK(info(v).kind == ValueKind::real, info(v).name);
        return static_cast<T*>(array(slot_of(v) + light * info(v).components + component))[lane];
    }
    std::int32_t& integer(Value v, int lane, int light = 0) {
        QUADREL_CHECK(info(v).kind == ValueKind::integer, info(v).name);
        return static_cast<std::int32_t*>(array(slot_of(v) + light))[lane];
    }
    vec2<T> vector2(Value v, int lane) { return {real(v, lane, 0), real(v, lane, 1)}; }
    vec3<T> vector3(Value v, int lane, int first = 0) {
        return {real(v, lane, first), real(v, lane, first + 1), real(v, lane, first + 2)};
    }
    template <int size, class S>
    void set(Value v, int lane, const vec<size, S>& x) {
        for (int c = 0; c < size; ++c) real(v, lane, c) = static_cast<T>(x[c]);
    }
    /// The bits of one component, all NaNs as one.
    std::uint64_t bits(Value v, int lane, int component = 0, int light = 0) {
        if (info(v).kind == ValueKind::integer) {
            return static_cast<std::uint32_t>(integer(v, lane, light));
        }
        const T x = real(v, lane, component, light);
        if (x != x) return ~std::uint64_t(0);
        typename FloatFormat<T>::Bits b;
        std::memcpy(&b, &x, sizeof x);
        return b;
    }

    /// Makes every array of `v` hold a pattern that no stage stores: a NaN of its own, or the least
    /// integer.
    void poison(Value v) {
        for (int i = 0; i < arrays_of(v); ++i) {
            for (int lane = 0; lane < lanes; ++lane) poison_lane(v, slot_of(v) + i, lane);
        }
    }
    void poison_all() {
        for (int v = 0; v < static_cast<int>(Value::count); ++v) poison(static_cast<Value>(v));
    }
    bool poisoned(Value v, int lane, int component = 0, int light = 0) {
        if (info(v).kind == ValueKind::integer) return integer(v, lane, light) == poison_integer;
        const T x = real(v, lane, component, light), p = poison_real();
        return std::memcmp(&x, &p, sizeof x) == 0;
    }
    /// Nobody asks for `v` any more (or again): stages find no array for it.
    void want(Value v, bool wanted) {
        for (int i = 0; i < arrays_of(v); ++i) wanted_[slot_of(v) + i] = wanted;
    }

    /// Runs the stage on Quad<T>, with defaults for parameters that are not named.
    void run(const std::string& id, const Parameters& parameters = {}, int light = 0) {
        const StageInfo* stage = find_stage(id);
        QUADREL_CHECK(stage != nullptr, id);
        std::vector<std::max_align_t> params(stage->params_size / sizeof(std::max_align_t) + 1);
        stage->set_defaults(params.data());
        for (const auto& [name, value] : parameters)
            set_parameter(*stage, params.data(), name, value);
        run(stage_function(id), params.data(), light);
    }
    /// Runs any stage function, such as run_stage<Stage, Quad<T>>.
    void run(StageFunction function, const void* params, int light = 0) {
        if (!own_depth && wanted_[slot_of(Value::relief_depth)]) {
            for (int lane = 0; lane < lanes; ++lane)
                real(Value::relief_depth, lane) = static_cast<T>(material.depth);
        }
        std::array<void*, slot_count> arrays;
        for (int slot = 0; slot < slot_count; ++slot) {
            arrays[slot] = wanted_[slot] ? array(slot) : nullptr;
        }
        StageCall call{};
        call.values = arrays.data();
        call.active = active.data();
        call.lanes = lanes;
        call.parameters = params;
        call.material = &material;
        call.frame = &frame;
        std::copy(textures_.begin(), textures_.end(), call.textures);
        call.light = light;
        call.counters = counters.data();
        call.log = log;
        for (int i = 0; i < 3; ++i) call.edges[i] = edges[i].data();
        call.primitive = primitive.data();
        call.primitives = primitives.data();
        call.frames = frames.empty() ? nullptr : frames.data();
        call.vertices = vertices.empty() ? nullptr : vertices.data();
        function(&call);
    }

    static const KernelTable& kernels() {
        return std::same_as<T, float> ? scalar_float_kernels() : scalar_double_kernels();
    }
    static StageFunction stage_function(const std::string& id) {
        const StageFunction run = find_kernel(kernels(), id);
        QUADREL_CHECK(run != nullptr, id);
        return run;
    }

  private:
    struct alignas(64) Line {
        std::byte bytes[64];
    };
    static constexpr std::int32_t poison_integer = std::numeric_limits<std::int32_t>::min() + 77;

    static T poison_real() {
        using Bits = typename FloatFormat<T>::Bits;
        const T nan = std::numeric_limits<T>::quiet_NaN();
        return std::bit_cast<T>(static_cast<Bits>(std::bit_cast<Bits>(nan) | Bits(0x5ca1e)));
    }
    void poison_lane(Value v, int slot, int lane) {
        if (info(v).kind == ValueKind::integer) {
            static_cast<std::int32_t*>(array(slot))[lane] = poison_integer;
        } else {
            static_cast<T*>(array(slot))[lane] = poison_real();
        }
    }
    static void set_parameter(const StageInfo& stage, void* params, const std::string& name,
                              double value) {
        for (const ParameterText& p : stage.parameters)
            if (name == p.name) return p.set(params, value);
        QUADREL_CHECK(!"a parameter of that name", name);
    }
    std::size_t lines_a_slot() const { return (std::size_t(lanes) * sizeof(T) + 63) / 64; }
    void* array(int slot) { return &block_[std::size_t(slot) * lines_a_slot()]; }

    std::vector<Line> block_;
    std::array<bool, slot_count> wanted_;
    std::array<const SampledTexture*, texture_slot_count> textures_{};
};

/// A stage under test: the registry's, or one with an error planted before or behind it, or another
/// implementation in its place.
template <PlainFloat T>
struct StageUnderTest {
    std::string id;
    std::function<void(Batch<T>&)> before{}, after{};
    std::function<void(Batch<T>&, const Parameters&)> instead{};

    void run(Batch<T>& batch, const Parameters& parameters = {}, int light = 0) const {
        if (before) before(batch);
        if (instead) {
            instead(batch, parameters);
        } else {
            batch.run(id, parameters, light);
        }
        if (after) after(batch);
    }
};

/// The values of `list` agree bit for bit in both batches, all NaNs as one.
template <PlainFloat T>
testing::AssertionResult same_bits(Batch<T>& a, Batch<T>& b, std::span<const Value> list) {
    for (const Value v : list) {
        for (int lane = 0; lane < a.lanes; ++lane) {
            for (int c = 0; c < info(v).components; ++c) {
                if (a.bits(v, lane, c) == b.bits(v, lane, c)) continue;
                return testing::AssertionFailure()
                       << info(v).name << "[" << c << "], lane " << lane;
            }
        }
    }
    return testing::AssertionSuccess();
}

inline void each_lane(Batch<float>& batch, const std::function<void(int)>& change) {
    for (int lane = 0; lane < batch.lanes; ++lane) change(lane);
}

}  // namespace quadrel::test
