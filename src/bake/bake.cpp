#include "quadrel/bake/bake.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bake/kinds.hpp"
#include "bake/wrap_names.hpp"
#include "quadrel/error.hpp"
#include "text/hash.hpp"
#include "text/suggest.hpp"
#include "text/threads.hpp"

namespace quadrel {

namespace {

const BakeParameter& find_parameter(const BakeKindInfo& kind, const std::string& name) {
    std::vector<std::string> names;
    for (const BakeParameter& parameter : kind.parameters) {
        if (name == parameter.name) return parameter;
        names.emplace_back(parameter.name);
    }
    throw UsageError(fmt::format("{}: found a parameter that {} maps have not, expected {}", name,
                                 kind.name, one_of(name, names)));
}

}  // namespace

std::map<std::string, double> complete_parameters(const BakeKindInfo& kind,
                                                  const BakeOptions& options) {
    std::map<std::string, double> all;
    for (const BakeParameter& parameter : kind.parameters) {
        all[parameter.name] = parameter.standard;
    }
    for (const auto& [name, value] : options.parameters) {
        const BakeParameter& p = find_parameter(kind, name);
        if (!(value >= p.low && value <= p.high) || (p.whole && value != std::floor(value))) {
            throw UsageError(fmt::format("{}: found {}, expected a {} from {} to {} for {} maps",
                                         name, value, p.whole ? "whole number" : "number", p.low,
                                         p.high, kind.name));
        }
        all[name] = value;
    }
    return all;
}

namespace {

void require_finite(const HeightPlane& plane, const BakeKindInfo& kind) {
    for (std::size_t k = 0; k < plane.heights.size(); ++k) {
        if (std::isfinite(plane.heights[k])) continue;
        const int i = static_cast<int>(k % plane.grid.u.count) + plane.grid.u.first;
        const int j = static_cast<int>(k / plane.grid.u.count) + plane.grid.v.first;
        throw InputError("", "", fmt::format("height {} at texel {}, {}", plane.heights[k], i, j),
                         fmt::format("finite heights for a {} map", kind.name));
    }
}

/// Before the plane is stored: mirrored axes take twice the texels.
void require_size(const Texture& height, const SamplerState& sampler) {
    const TextureView& view = height.view();
    const Grid grid = texel_grid(view.width[0], view.height[0], sampler);
    if (std::int64_t(grid.u.count) * grid.v.count <= max_texture_floats) return;
    throw InputError("", "", fmt::format("{} x {} texels", view.width[0], view.height[0]),
                     "at most 2^29 texels, mirror images included");
}

}  // namespace

std::string source_id(const Texture& source, BakeKind kind) {
    if (!bakes_layers(kind)) return height_id(source);
    const TextureView& view = source.view();
    const std::size_t floats =
        static_cast<std::size_t>(view.channels) * view.width[0] * view.height[0];
    Sha256 hash;
    hash.update(fmt::format("layers {} {} {}\n", view.channels, view.width[0], view.height[0]));
    hash.update({reinterpret_cast<const char*>(source.level_texels(0, 0)), floats * sizeof(float)});
    return hash.hex();
}

std::string height_id(const Texture& height) {
    const TextureView& view = height.view();
    const float* texels = height.level_texels(0, 0);
    const std::size_t count = static_cast<std::size_t>(view.width[0]) * view.height[0];
    Sha256 hash;
    hash.update(fmt::format("heights {} {}\n", view.width[0], view.height[0]));
    std::vector<float> row(static_cast<std::size_t>(view.width[0]));
    for (std::size_t first = 0; first < count; first += row.size()) {
        for (std::size_t i = 0; i < row.size(); ++i) row[i] = texels[(first + i) * view.channels];
        hash.update({reinterpret_cast<const char*>(row.data()), row.size() * sizeof(float)});
    }
    return hash.hex();
}

std::string baked_id_of(const std::string& heights, BakeKind kind, const SamplerState& sampler,
                        const BakeOptions& options) {
    const BakeKindRow& row = bake_row(kind);
    std::string text = fmt::format("{} {} {} {} {}", heights, row.info.name, row.info.version,
                                   wrap_name(sampler.wrap_u), wrap_name(sampler.wrap_v));
    if (has_border(sampler)) text += fmt::format(" border={:a}", sampler.border[0]);
    if (has_border(sampler) && row.heights == Heights::layers)
        for (int c = 1; c < 4; ++c) text += fmt::format(",{:a}", sampler.border[c]);
    for (const auto& [name, value] : complete_parameters(row.info, options)) {
        text += fmt::format(" {}={:a}", name, value);
    }
    return sha256_hex(text);
}

std::string baked_id(const Texture& height, BakeKind kind, const SamplerState& sampler,
                     const BakeOptions& options) {
    return baked_id_of(source_id(height, kind), kind, sampler, options);
}

std::shared_ptr<const Texture> bake_as(const std::string& id, const Texture& height, BakeKind kind,
                                       const SamplerState& sampler, const BakeOptions& options) {
    const BakeKindRow& row = bake_row(kind);
    const auto parameters = complete_parameters(row.info, options);
    require_size(height, sampler);
    const HeightPlane plane(height, sampler);
    if (row.heights == Heights::finite) require_finite(plane, row.info);
    Progress progress(options.progress, options.seconds_limit);
    const BakeJob job{height, plane, sampler, parameters, id, progress};
    std::shared_ptr<Texture> map;
    const AllowedThreads allowed(options.threads);
    arena_of(options.threads).execute([&] { map = row.generate(job); });
    progress.finish();
    return map;
}

std::shared_ptr<const Texture> bake(const Texture& height, BakeKind kind,
                                    const SamplerState& sampler, const BakeOptions& options) {
    return bake_as(baked_id(height, kind, sampler, options), height, kind, sampler, options);
}

}  // namespace quadrel
