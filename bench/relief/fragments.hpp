// Rays without geometry: the values that searches load, made directly, and a stage run on them in
// double by its id.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "kernels/table.hpp"
#include "quadrel/bake/baked_texture.hpp"
#include "quadrel/relief/registry.hpp"

namespace quadrel::bench {

/// A search and its parameters, as "id name=value name=value", of its baked maps
/// "bake.name=value".
struct Row {
    std::string text, id;
    std::map<std::string, double> parameters, baking;

    /// Throws UsageError for what is not of that form, or no search.
    explicit Row(const std::string& text);
    const StageInfo& stage() const { return *find_stage(id); }
};

/// Fragments on a plane seen at one angle, of a relief `depth` tiles deep, J the identity; polygon
/// at the top.
class Fragments {
  public:
    Fragments(int count, double depth);

    void set_ray(int lane, double u, double v, double Ku, double Kv, double cosine);
    /// Bends the base: `curvature` in 1 / tile, the same along every direction.
    void curve_base(double curvature);
    /// The height map, from which the maps that a row reads are baked. Must outlive the runs.
    void bind(const Texture& height, const SamplerState& sampler);
    void run(const Row& row);

    double real(Value v, int lane, int component = 0) const {
        return reals_[slot(v, component)][static_cast<std::size_t>(lane)];
    }
    int integer(Value v, int lane) const {
        return integers_[slot(v)][static_cast<std::size_t>(lane)];
    }
    int count() const { return count_; }
    /// Of the maps that the last run read, besides the heights.
    double baked_mebibytes() const { return baked_mebibytes_; }

  private:
    static std::size_t slot(Value v, int component = 0) {
        return static_cast<std::size_t>(slot_of(v) + component);
    }
    void bake_for(const Row& row);

    int count_;
    std::vector<std::uint32_t> active_;
    std::vector<std::vector<double>> reals_;
    std::vector<std::vector<std::int32_t>> integers_;
    MaterialUniforms material_{};
    FrameUniforms frame_{};
    const Texture* height_ = nullptr;
    std::map<std::string, std::shared_ptr<const Texture>> baked_;
    double baked_mebibytes_ = 0;
    std::array<SampledTexture, texture_slot_count> textures_{};
};

}  // namespace quadrel::bench
