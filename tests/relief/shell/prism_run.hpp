// Rows that search shells, run on random rays.
#pragma once

#include "quadrel/bake/bake.hpp"
#include "quadrel/relief/shell/prism_leaf.hpp"
#include "relief/shell/prism_oracle.hpp"

namespace quadrel::test {

/// Heights of few texels, all of them different; or of three, in walls.
inline Map random_prism_heights(Random& random) {
    const auto wrap = static_cast<Wrap>(random.below(5));
    const bool walls = random.chance(0.3);
    return height_map(
        7 + random.below(40), 7 + random.below(40),
        [&](int, int) {
            return walls ? static_cast<float>(random.below(3)) / 2
                         : static_cast<float>(random.uniform(0, 1));
        },
        wrap);
}

/// Rays, what they search, and what was found.
template <PlainFloat T>
struct PrismRun {
    Map heights;
    std::shared_ptr<const Texture> maxima;
    SampledTexture sampled_maxima{};
    Batch<T> batch;

    /// Without a hit or a miss yet.
    explicit PrismRun(std::uint64_t seed) {
        Random random(seed * 7919 + 11);
        heights = random_prism_heights(random);
        maxima = bake(*heights.texture, BakeKind::max_mip, heights.sampled.sampler);
        sampled_maxima = {maxima->view(), heights.sampled.sampler};
        Batch<float> rays;
        fill_prism_rays(rays, random);
        for (int lane = 0; lane < rays.lanes; ++lane)
            for (const Value v : {Value::dUVdx, Value::dUVdy}) rays.set(v, lane, dvec2(0, 0));
        batch = in_number<T>(rays);
        batch.material = rays.material;
        batch.bind(TextureSlot::height, heights.sampled);
        batch.bind(TextureSlot::max_mip, sampled_maxima);
    }
    PrismRun(const PrismRun&) = delete;

    /// Runs the frame and a row on rows with an error, and puts these back.
    void search(const std::string& row, const Parameters& parameters,
                PrismFlaw flaw = PrismFlaw::none) {
        const std::vector<PrimitiveVertices> sound = batch.vertices;
        plant(flaw, batch.vertices);
        batch.run("frame-shell");
        batch.run(row, parameters);
        batch.vertices = sound;
    }
    void search_exactly(PrismSurface surface, PrismFlaw flaw = PrismFlaw::none) {
        auto searched = static_cast<int>(surface);
        if (flaw == PrismFlaw::other_surface) searched = searched == 0 ? 1 : 0;
        search("prism-exact", {{"surface", searched}}, flaw);
    }

    /// How far along the ray, in world units; infinite for a miss.
    oracle::Real found(int lane) {
        const bool hit = batch.integer(Value::hit_status, lane) == static_cast<int>(Status::hit);
        return hit ? static_cast<oracle::Real>(batch.real(Value::hit_depth, lane))
                   : std::numeric_limits<oracle::Real>::infinity();
    }
};

}  // namespace quadrel::test
