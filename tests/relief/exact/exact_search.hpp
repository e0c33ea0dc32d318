// The exact searches under test: their maps, batches of rays in float and in double, and what the
// oracle says a result may be.
#pragma once

#include "quadrel/bake/bake.hpp"
#include "relief/exact/oracle.hpp"
#include "relief/stage_inputs.hpp"
#include "relief/stress_maps.hpp"

namespace quadrel::test {

/// A height map with what the exact searches read of it.
struct ExactMaps {
    Map height;
    std::array<Map, texture_slot_count> baked;

    explicit ExactMaps(Map map, std::initializer_list<TextureSlot> slots = {TextureSlot::max_mip,
                                                                            TextureSlot::texel_max,
                                                                            TextureSlot::cone_cell,
                                                                            TextureSlot::rmq,
                                                                            TextureSlot::ddm})
        : height(std::move(map)) {
        for (const TextureSlot slot : slots) {
            Map& to = baked[static_cast<std::size_t>(slot)];
            // Of tables as many directions as show their borders, in blocks of one cell and more.
            BakeOptions options;
            if (slot == TextureSlot::ddm)
                options.parameters = {{"columns", 24}, {"slices", 5}, {"directions", 6}};
            to.texture = bake(*height.texture, bake_kind_from_name(slot_name(slot)),
                              height.sampled.sampler, options);
            to.sampled = {to.texture->view(), height.sampled.sampler};
        }
    }
    template <PlainFloat T>
    void bind(Batch<T>& batch) const {
        batch.bind(TextureSlot::height, height.sampled);
        for (int slot = 0; slot < texture_slot_count; ++slot) {
            const Map& map = baked[static_cast<std::size_t>(slot)];
            if (map.texture) batch.bind(static_cast<TextureSlot>(slot), map.sampled);
        }
    }
};

/// A stress map of 1 to 48 texels a side under wrap modes of its own an axis; with probability
/// 1/8 the border has a height of its own.
inline Map random_stress_map(Random& random, const StressMap& kind, int longest = 48) {
    SamplerState sampler = plain_sampler();
    sampler.wrap_u = static_cast<Wrap>(random.below(5));
    sampler.wrap_v = static_cast<Wrap>(random.below(5));
    if (random.chance(0.125)) sampler.border[0] = 0.75f;
    const auto side = [&] {
        return random.chance(0.1) ? 1 + random.below(3) : 4 + random.below(longest - 3);
    };
    const int width = side(), height = side();
    return make_stress_map(kind, width, height, sampler, random);
}
inline ExactMaps random_exact_maps(Random& random, const StressMap& kind, int longest = 48) {
    return ExactMaps(random_stress_map(random, kind, longest));
}

/// The batch in T.
template <PlainFloat T>
Batch<T> in_number(Batch<float>& rays) {
    if constexpr (std::same_as<T, float>) {
        return rays;
    } else {
        return in_double(rays);
    }
}

/// The searches that promise the same hits, bit for bit.
inline constexpr std::array exact_rows{"texel-exact", "max-mip", "cone-cell", "rmq-leap", "ddm"};

/// What they agree in: all but the counts.
inline constexpr auto agreed_values = values(Value::hit_uv, Value::hit_s, Value::hit_h,
                                             Value::hit_depth, Value::hit_status, Value::hit_flags);

template <PlainFloat T>
oracle::Ray oracle_ray(Batch<T>& batch, int lane) {
    return {batch.real(Value::uv, lane, 0), batch.real(Value::uv, lane, 1),
            batch.real(Value::K, lane, 0), batch.real(Value::K, lane, 1),
            1 - static_cast<T>(batch.material.seat)};
}

/// How far off a height along the ray may be in T: of the arithmetic, and of the position, which is
/// off by roundings in proportion to its parts, times the field's steepest slope a cell.
template <PlainFloat T>
oracle::Real height_error(const oracle::Field& field, const oracle::Ray& ray, oracle::Real slope) {
    constexpr oracle::Real roundoff = std::numeric_limits<T>::epsilon() / 2;
    const oracle::GridRay grid(field, ray, 0.5L);
    const oracle::Real parts = 4 * (field.width + field.height) +
                               6 * (std::fabs(grid.dx) + std::fabs(grid.dy)) +
                               4 * (std::fabs(grid.x) + std::fabs(grid.y));
    return roundoff * (64 + slope * parts);
}

/// Whether a search's s is one that the field has when all heights are moved by no more than the
/// error: raising them brings every hit forward, lowering them back.
template <PlainFloat T>
testing::AssertionResult is_not_wrong(const oracle::Field& field, const oracle::Ray& ray, T s,
                                      oracle::Real slope = 1) {
    const oracle::Real error = height_error<T>(field, ray, slope);
    const oracle::Real rounding = 4 * std::numeric_limits<T>::epsilon();
    const oracle::Hit first = oracle::meet_bilinear(field, ray, error);
    if (s < first.s - rounding)
        return testing::AssertionFailure() << "early: " << s << " before " << double(first.s);
    const oracle::Hit last = oracle::meet_bilinear(field, ray, -error);
    if (s > last.s + rounding)
        return testing::AssertionFailure() << "late: " << s << " after " << double(last.s);
    return testing::AssertionSuccess();
}

/// The same for the field of blocks, whose walls make s jump where the ray moves sideways: the s of
/// rays displaced by the error of positions bracket it.
template <PlainFloat T>
testing::AssertionResult is_not_wrong_of_blocks(const oracle::Field& field, const oracle::Ray& ray,
                                                T s) {
    const oracle::Real error = height_error<T>(field, ray, 1);
    oracle::Real first = 1, last = 0;
    for (int k = 0; k < 9; ++k) {
        oracle::Ray moved = ray;
        moved.u += (k % 3 - 1) * error / field.width;
        moved.v += (k / 3 - 1) * error / field.height;
        first = std::min(first, oracle::meet_blocks(field, moved, error).s);
        last = std::max(last, oracle::meet_blocks(field, moved, -error).s);
    }
    const oracle::Real rounding = 4 * std::numeric_limits<T>::epsilon();
    if (s >= first - rounding && s <= last + rounding) return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << s << " not between " << double(first) << " and " << double(last);
}

/// A row on a batch of its own copy.
template <PlainFloat T>
Batch<T> searched(const Batch<T>& rays, const std::string& row) {
    Batch<T> result = rays;
    result.run(row);
    return result;
}

}  // namespace quadrel::test
