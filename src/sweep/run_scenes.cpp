#include "sweep/run_scenes.hpp"

#include <algorithm>
#include <limits>

#include "quadrel/error.hpp"
#include "quadrel/relief/registry.hpp"
#include "quadrel/scene/load.hpp"
#include "render/errors/error_plan.hpp"

namespace quadrel::sweep {
namespace {

bool needs_normals(const std::string& trace) {
    const auto read = find_stage(trace)->textures;
    return std::find(read.begin(), read.end(), TextureSlot::normal) != read.end();
}

/// Whether normals can be made of its heights: where a tile is a unit of length the relief's depth
/// is in tiles.
bool lacks_normals(const Material& material) {
    return !material.textures.contains("normal") && material.textures.contains("height");
}

const TextureReference& height_map(const Scene& scene) {
    const auto& textures = scene.materials.front().textures;
    const auto height = textures.find("height");
    if (height == textures.end())
        throw UsageError("the first material has no height map to judge by");
    return height->second;
}

}  // namespace

RenderOptions RunScenes::render_options(const Run& run) const {
    RenderOptions options;
    options.number = run.number;
    options.isa = run.isa;
    options.threads = run.threads;
    options.baking_limit = std::numeric_limits<double>::infinity();  // nobody waits for one picture
    if (pause_) {
        options.progress = [this](double) { pause_(); };
        options.baking = [this](const std::string&, double) { pause_(); };
    }
    return options;
}

RunScene RunScenes::scene_of(const Run& run) {
    const std::string& heights = heights_of(run);
    RunScene made{{}, overrides_of(plan_, run, heights, {})};
    made.scene = load(run, made.overrides);
    const Material& material = made.scene.materials.front();
    if (!needs_normals(plan_.algorithms[run.algorithm].trace) || !lacks_normals(material) ||
        !plan_.views[run.view].angle)
        return made;
    made.overrides = overrides_of(plan_, run, heights, normals_of(material));
    made.scene = load(run, made.overrides);
    return made;
}

JudgedRun RunScenes::judge(const RunScene& run_scene, const Run& run,
                           const std::vector<std::string>& more) {
    JudgedRun judged;
    judged.map = size_of_map(height_map(run_scene.scene).file);
    RenderOptions options = render_options(run);
    options.channels = run_error_channels();
    options.channels.emplace_back("hit.fetches");
    options.channels.insert(options.channels.end(), more.begin(), more.end());
    options.truths = truths_of(run_scene, run);
    judged.film = render(run_scene.scene, options);
    judged.error = run_error(judged.film, plan_.wrong_texels);
    return judged;
}

/// The run's map as a value of its scene; empty where the scene's own is none.
const std::string& RunScenes::heights_of(const Run& run) {
    const auto [known, is_new] = heights_.try_emplace({run.scene, run.map});
    if (!is_new) return known->second;
    const PlannedMap& map = plan_.maps[run.map];
    if (map.source == PlannedMap::Source::file)
        return known->second = height_override(map, map.file);
    if (map.source == PlannedMap::Source::made)
        return known->second =
                   height_override(map, std::filesystem::absolute(write_made_map(maps_, map)));
    const PlannedScene& planned = plan_.scenes[run.scene];
    const Scene own = load_scene(planned.file_or_name, planned.overrides);
    const auto& textures = own.materials.front().textures;
    if (const auto found = textures.find("height"); found != textures.end())
        known->second = height_override(found->second);
    return known->second;
}

/// The normal map of its heights; made once.
const std::filesystem::path& RunScenes::normals_of(const Material& material) {
    const std::filesystem::path& heights = material.textures.at("height").file;
    const auto [known, is_new] = normals_.try_emplace({heights, material.depth});
    if (is_new)
        known->second = std::filesystem::absolute(write_normal_map(maps_, heights, material.depth));
    return known->second;
}

/// What the judge has found for runs of one map and view; null where there is no judge, or where
/// frames are so large that it is found again in less memory.
KnownTruths* RunScenes::truths_of(const RunScene& run_scene, const Run& run) {
    constexpr std::int64_t most_pixels = 1 << 20;  // some 150 bytes each
    const auto pixels = std::int64_t(plan_.width) * plan_.height;
    const auto judge = error_judge(run_scene.scene, run_scene.scene.materials.front());
    if (!judge || plan_.samples != 1 || pixels > most_pixels / 4) return nullptr;
    if ((static_cast<std::int64_t>(truths_.size()) + 1) * pixels > most_pixels) truths_.clear();
    auto& truths = truths_[{run.scene, run.map, run.view, run.number, judge->trace}];
    if (!truths) truths = std::make_unique<KnownTruths>(plan_.width, plan_.height);
    return truths.get();
}

/// Scenes over one map share what they load; of one map after the other no more is kept.
Scene RunScenes::load(const Run& run, const std::vector<std::string>& overrides) {
    Scene scene = load_scene(plan_.scenes[run.scene].file_or_name, overrides);
    const std::pair now(run.scene, run.map);
    if (cache_ == nullptr || cached_ != now) {
        cache_ = scene.texture_cache;
        cached_ = now;
        truths_.clear();
    }
    scene.texture_cache = cache_;
    return scene;
}

}  // namespace quadrel::sweep
