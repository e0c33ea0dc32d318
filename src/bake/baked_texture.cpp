#include "quadrel/baked_texture.hpp"

#include <fmt/format.h>

#include <map>
#include <mutex>

#include "bake/disk_cache.hpp"
#include "bake/wrap_names.hpp"
#include "quadrel/error.hpp"
#include "quadrel/relief/cells.hpp"

namespace quadrel {

namespace {

std::string bake_command(BakeKind kind, const SamplerState& sampler,
                         const BakedTextureOptions& options) {
    std::string command = fmt::format("quadrel bake {} --kind {} --wrap-u {} --wrap-v {}",
                                      options.input, bake_kind_info(kind).name,
                                      wrap_name(sampler.wrap_u), wrap_name(sampler.wrap_v));
    if (has_border(sampler)) command += fmt::format(" --border {}", sampler.border[0]);
    for (const auto& [name, value] : options.parameters)
        command += fmt::format(" --param {}={}", name, value);
    return command;
}

void require_quick(const Texture& height, BakeKind kind, const SamplerState& sampler,
                   const BakedTextureOptions& options) {
    const int width = height.view().width[0], rows = height.view().height[0];
    const double seconds = bake_seconds_estimate(kind, width, rows);
    if (seconds <= options.seconds_limit) return;
    throw InputError(
        "", options.key,
        fmt::format("a height field of {} x {} texels, whose {} map may take {:.0f} s", width, rows,
                    bake_kind_info(kind).name, seconds),
        fmt::format("a map baked before, by `{}`", bake_command(kind, sampler, options)));
}

std::shared_ptr<const Texture> load_or_bake(const std::string& id, const Texture& height,
                                            BakeKind kind, const SamplerState& sampler,
                                            const BakedTextureOptions& options) {
    const auto cache = options.disk ? DiskCache::of_user() : std::nullopt;
    if (cache) {
        if (auto found = cache->load(id)) return found;
    }
    require_quick(height, kind, sampler, options);
    auto map = bake(height, kind, sampler, options);
    if (cache) cache->store(*map);
    return map;
}

}  // namespace

std::shared_ptr<const Texture> baked_texture(const Texture& height, BakeKind kind,
                                             const SamplerState& sampler,
                                             const BakedTextureOptions& options) {
    static std::mutex mutex;
    static std::map<std::string, std::weak_ptr<const Texture>> maps;
    const std::string id = baked_id(height, kind, sampler, options);
    const std::lock_guard lock(mutex);
    if (auto found = maps[id].lock()) return found;
    auto map = load_or_bake(id, height, kind, sampler, options);
    maps[id] = map;
    return map;
}

}  // namespace quadrel
