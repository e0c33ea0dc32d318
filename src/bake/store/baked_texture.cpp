#include "quadrel/bake/baked_texture.hpp"

#include <fmt/format.h>
#include <tbb/info.h>

#include <cmath>
#include <map>
#include <mutex>

#include "bake/kinds.hpp"
#include "bake/store/disk_cache.hpp"
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

[[noreturn]] void refuse(const Texture& height, BakeKind kind, const SamplerState& sampler,
                         const BakedTextureOptions& options, const std::string& time) {
    const TextureView& view = height.view();
    throw InputError(
        "", options.key,
        fmt::format("a height field of {} x {} texels, whose {} map {}", view.width[0],
                    view.height[0], bake_kind_info(kind).name, time),
        fmt::format("a map baked before, by `{}`", bake_command(kind, sampler, options)));
}

/// Only where nothing is gained by trying.
void refuse_hopeless(const Texture& height, BakeKind kind, const SamplerState& sampler,
                     const BakedTextureOptions& options) {
    const TextureView& view = height.view();
    const double easy = bake_seconds_estimate(kind, view.width[0], view.height[0]) /
                        tbb::info::default_concurrency();
    constexpr double hopeless = 6;  // two minutes instead of 20 s
    if (easy > hopeless * options.seconds_limit)
        refuse(height, kind, sampler, options,
               fmt::format("takes {:.0f} minutes at least", std::ceil(easy / 60)));
}

std::shared_ptr<const Texture> bake_in_time(const std::string& id, const Texture& height,
                                            BakeKind kind, const SamplerState& sampler,
                                            const BakedTextureOptions& options) {
    refuse_hopeless(height, kind, sampler, options);
    try {
        return bake_as(id, height, kind, sampler, options);
    } catch (const BakeStopped& stopped) {
        refuse(height, kind, sampler, options,
               fmt::format("takes more than {:g} s ({:.0f} % were done)", options.seconds_limit,
                           100 * stopped.done));
    }
}

/// The cache, or why there is none.
struct Cache {
    std::optional<DiskCache> disk;
    std::string problem;  ///< empty if it is not wanted
};

Cache open_cache(const BakedTextureOptions& options) {
    if (!options.disk || options.in_memory) return {};
    const std::optional<DiskCache> cache = DiskCache::of_user();
    if (cache) return {cache, ""};
    return {std::nullopt,
            DiskCache::is_switched_off() ? "" : "neither XDG_CACHE_HOME nor HOME names a folder"};
}

void require_kept(const Cache& cache, const std::string& problem) {
    const std::string place = cache.disk ? cache.disk->folder().string() : "the cache";
    throw OutputError(place, problem.empty() ? "it is switched off" : problem);
}

std::shared_ptr<const Texture> load_or_bake(const std::string& id, const Texture& height,
                                            BakeKind kind, const SamplerState& sampler,
                                            const BakedTextureOptions& options) {
    Cache cache = open_cache(options);
    if (cache.disk) {
        if (auto found = cache.disk->load(id)) return found;
        // Before long work; afterwards it may be full.
        if (auto problem = cache.disk->reason_not_to_write(id)) cache.problem = *problem;
    }
    const bool usable = cache.disk && cache.problem.empty();
    if (options.must_keep && !usable) require_kept(cache, cache.problem);
    auto map = bake_in_time(id, height, kind, sampler, options);
    if (usable) cache.problem = cache.disk->store(*map).value_or("");
    if (cache.problem.empty()) return map;
    if (options.must_keep) require_kept(cache, cache.problem);
    if (options.not_kept) options.not_kept(cache.problem);
    return map;
}

}  // namespace

std::shared_ptr<const Texture> baked_texture(const Texture& height, BakeKind kind,
                                             const SamplerState& sampler,
                                             const BakedTextureOptions& options) {
    static std::mutex mutex;
    static std::map<std::string, std::weak_ptr<const Texture>> maps;
    const std::string id = baked_id_of(options.in_memory ? height.id() : source_id(height, kind),
                                       kind, sampler, options);
    const std::lock_guard lock(mutex);
    if (auto found = maps[id].lock()) return found;
    auto map = load_or_bake(id, height, kind, sampler, options);
    maps[id] = map;
    return map;
}

}  // namespace quadrel
