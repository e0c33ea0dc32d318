#include "quadrel/render.hpp"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "quadrel/error.hpp"
#include "quadrel/film/channels.hpp"
#include "quadrel/stats.hpp"
#include "render/draw/planes.hpp"
#include "render/draw/tile_progress.hpp"
#include "render/inject/injected_values.hpp"
#include "render/integral/integral_scene.hpp"
#include "render/plan/prepared.hpp"
#include "render/prepare/geometry_cache.hpp"
#include "render/registry/added_stages.hpp"
#include "render/stats/stats_record.hpp"
#include "render/stats/stopwatch.hpp"
#include "text/threads.hpp"

namespace quadrel {
namespace {

Window checked_window(const Scene& scene, const RenderOptions& options) {
    const Window frame{0, 0, scene.width, scene.height};
    if (!options.window) return frame;
    const Window w = *options.window;
    if (w.width() <= 0 || w.height() <= 0 || !contains(frame, w))
        throw UsageError(fmt::format("window {},{},{},{} is not a part of the frame 0,0,{},{}",
                                     w.x0, w.y0, w.x1, w.y1, scene.width, scene.height));
    return w;
}

void check_integral(const IntegralOptions& integral, const RenderOptions& options) {
    constexpr int least = IntegralOptions::least_samples, most = IntegralOptions::most_samples;
    constexpr int step = IntegralOptions::replicates;
    if (integral.samples < least || integral.samples > most || integral.samples % step != 0)
        throw UsageError(
            fmt::format("{} samples per pixel: expected a multiple of {} from {} to {}",
                        integral.samples, step, least, most));
    if (!(integral.error >= 0) || !std::isfinite(integral.error))
        throw UsageError("the error of an integral: expected a finite number that is not negative");
    if (options.touched)
        throw UsageError("an integral over pixels does not tell which texels it touches");
    if (!options.limits.empty())
        throw UsageError("--limits: an integral over pixels has no ranges of what a GPU may give");
}

void check_options(const RenderOptions& options) {
    if (options.tile < 2 || options.tile > 1024 || options.tile % 2 != 0)
        throw UsageError(
            fmt::format("tile size {}: expected an even number from 2 to 1024", options.tile));
    if (options.threads < 0) throw UsageError("the number of threads cannot be negative");
    if (options.integral) check_integral(*options.integral, options);
}

/// Integrals have channels of their own, and no others.
void check_channel(const std::string& name, bool integral) {
    const std::vector<std::string>& known = integral_channels();
    if (integral && std::find(known.begin(), known.end(), name) == known.end())
        throw UsageError(fmt::format("channel \"{}\": an integral over pixels has {}", name,
                                     fmt::join(known, ", ")));
    if (!integral && is_integral_channel(name))
        throw UsageError(fmt::format(
            "channel \"{}\": only an integral over pixels has it (render --integrate)", name));
}

/// Those that are asked for, and what `limits` adds.
std::vector<std::string> channels_with_ranges(const RenderOptions& options) {
    std::vector<std::string> names = expand_channels(options.channels);
    if (options.limits.empty()) return names;
    const std::vector<std::string> asked = names;
    for (const std::string& name : asked)
        for (const char* part : gpu_range_prefixes)
            if (has_range(name) && std::ranges::count(names, part + name) == 0)
                names.push_back(part + name);
    return names;
}

std::vector<ChannelSource> channel_sources(const Scene& scene, const RenderOptions& options) {
    std::vector<ChannelSource> sources;
    const bool integral = options.integral.has_value();
    for (const std::string& name : integral&& options.channels.empty()
                                       ? integral_channels()
                                       : channels_with_ranges(options)) {
        check_channel(name, integral);
        sources.push_back(channel_source(name));
        if (sources.back().light > 0 &&
            sources.back().light >= static_cast<int>(scene.lights.size()))
            throw UsageError(
                fmt::format("channel \"{}\": the scene has {} lights", name, scene.lights.size()));
    }
    return sources;
}

void load_textures_of(PreparedRender& prepared, const RenderOptions& options) {
    arena_of(options.threads).execute([&] {
        load_plan_textures(*prepared.scene, prepared.used, prepared.plan,
                           {options.baking, options.not_kept, options.baking_limit},
                           static_cast<std::int64_t>(prepared.window.area()));
    });
}

/// Renders all tiles, each thread with a renderer that `make` makes, and gathers the records.
template <class Make>
void render_tiles(const PreparedRender& prepared, const RenderOptions& options, const Make& make,
                  DrawRecord* record) {
    const Scene& scene = *prepared.scene;
    const Viewport viewport{scene.width, scene.height, scene.conventions};
    const std::vector<Tile> tiles =
        bin_triangles(prepared.geometry, quad_rect(viewport, prepared.window), options.tile);
    TileProgress progress(options.progress, tiles.size());
    arena_of(options.threads).execute([&] {
        tbb::enumerable_thread_specific<TileRenderer> renderers(make);
        tbb::parallel_for(
            std::size_t(0), tiles.size(),
            [&](std::size_t i) {
                renderers.local().render(tiles[i]);
                progress.advance();
            },
            tbb::simple_partitioner());
        if (record == nullptr) return;
        for (const TileRenderer& renderer : renderers) merge(*record, renderer.record());
    });
}

struct Phases {
    PhaseTime plan, load, draw;
};

RenderSummary summarize(const PreparedRender& prepared, const DrawRecord& record,
                        const Phases& phases) {
    return {static_cast<std::uint64_t>(prepared.window.area()),
            record.pixels,
            prepared.geometry.counts,
            left_out(prepared),
            phases.plan,
            phases.load,
            phases.draw};
}

void count_touched(const PreparedRender& prepared, const RenderOptions& options,
                   RenderStats& stats) {
    DrawRecord marking;
    Stopwatch watch;
    const TouchedTexels touched = mark_touched(prepared, options, marking);
    stats.mark = watch.lap();
    record_marks(prepared, marking, touched, stats);
}

RenderStats count_all(const PreparedRender& prepared, const RenderOptions& options,
                      const DrawRecord& record, const Phases& phases) {
    RenderStats stats;
    stats.plan = phases.plan;
    stats.load = phases.load;
    stats.draw = phases.draw;
    record_plan(prepared, options, stats);
    record_drawing(record, stats);
    if (options.touched) count_touched(prepared, options, stats);
    return stats;
}

/// Null where nothing is injected.
std::shared_ptr<const InjectedValues> injected_values(const PreparedRender& prepared,
                                                      const RenderOptions& options) {
    if (options.injected.empty()) return nullptr;
    if (options.integral)
        throw UsageError("--inject: an integral over pixels has no stages' values");
    for (const ChannelSource& channel : prepared.channels)
        if (is_drawn_apart(channel.name) && channel.range_set != RangeSet::gpu)
            throw UsageError(fmt::format(
                "--inject: channel \"{}\" is computed from the scene's own values alone",
                channel.name));
    return std::make_shared<const InjectedValues>(options.injected, *prepared.scene,
                                                  prepared.window);
}

/// plan_render of the scene as it is drawn.
PreparedRender plan_drawn(const Scene& scene, const RenderOptions& options,
                          const KernelTable& kernels, GeometryCache* geometry) {
    PreparedRender prepared{
        &scene, checked_window(scene, options), channel_sources(scene, options), {}, {}, {}, {}};
    prepared.plan = make_render_plan(scene, prepared.channels, kernels, options.skip,
                                     options.limits, injected_values(prepared, options));
    if (prepared.plan.injected) prepared.plan.injected->check_used(prepared.plan.materials);
    prepared.plan.isa = options.isa;
    if (options.judged != nullptr) {
        if (options.judged->window != prepared.window)
            throw UsageError("the image that is judged has another window than the render");
        prepared.plan.judged = std::make_shared<JudgedImage>(*options.judged);
    }
    prepared.plan.truths = options.truths;
    prepared.plan.integral = options.integral;
    const GeometryParts parts = parts_read(prepared.plan);
    prepared.geometry = geometry != nullptr
                            ? geometry->take(scene, prepared.plan.hardware, parts)
                            : assemble_geometry(scene, prepared.plan.hardware, parts);
    prepared.used = std::vector<bool>(scene.materials.size(), true);
    if (options.skip) {
        const Viewport viewport{scene.width, scene.height, scene.conventions};
        prepared.used =
            used_materials(scene, prepared.geometry, quad_rect(viewport, prepared.window));
    }
    return prepared;
}

}  // namespace

PreparedRender plan_render(const Scene& scene, const RenderOptions& options,
                           const KernelTable& kernels, GeometryCache* geometry) {
    check_options(options);
    if (!options.integral) return plan_drawn(scene, options, kernels, geometry);
    const auto changed = std::make_shared<const Scene>(integral_scene(scene));
    PreparedRender prepared = plan_drawn(*changed, options, kernels, geometry);
    prepared.changed = changed;
    return prepared;
}

PreparedRender prepare_render(const Scene& scene, const RenderOptions& options,
                              const KernelTable& kernels) {
    PreparedRender prepared = plan_render(scene, options, kernels);
    load_textures_of(prepared, options);
    return prepared;
}

void draw_into(Film& film, const PreparedRender& prepared, const RenderOptions& options,
               DrawRecord* record, Recording recording) {
    const Scene& scene = *prepared.scene;
    check_film_size(scene, prepared.window, prepared.channels.size());
    const std::vector<std::uint32_t> undrawn = undrawn_bits(scene, prepared.channels);
    const bool cleared = arena_of(options.threads).execute([&] {
        return make_planes(film, scene, prepared.window, prepared.channels, undrawn);
    });
    const Viewport viewport{scene.width, scene.height, scene.conventions};
    const FilmTarget target{&film, &prepared.channels, viewport, scene.background,
                            cleared ? nullptr : &undrawn};
    if (record == nullptr) recording = Recording::nothing;
    render_tiles(
        prepared, options,
        [&] { return TileRenderer(scene, prepared.plan, prepared.geometry, target, recording); },
        record);
}

Film draw(const PreparedRender& prepared, const RenderOptions& options, DrawRecord* record,
          Recording recording) {
    Film film;
    draw_into(film, prepared, options, record, recording);
    return film;
}

TouchedTexels mark_touched(const PreparedRender& prepared, const RenderOptions& options,
                           DrawRecord& record) {
    const Scene& scene = *prepared.scene;
    Film film;
    const Viewport viewport{scene.width, scene.height, scene.conventions};
    const FilmTarget target{&film, &prepared.channels, viewport, scene.background};
    const RenderPlan counting = plan_with_steps(prepared.plan);
    TouchedTexels touched(prepared.plan);
    RenderOptions marking = options;
    // All is drawn by now; but who is told may end it.
    if (options.progress) marking.progress = [&](double) { options.progress(1); };
    render_tiles(
        prepared, marking,
        [&] {
            return TileRenderer(scene, counting, prepared.geometry, target, Recording::marks,
                                &touched);
        },
        &record);
    return touched;
}

std::vector<QuadCoverage> visible_quads(const PreparedRender& prepared) {
    const Scene& scene = *prepared.scene;
    Film film;
    const Viewport viewport{scene.width, scene.height, scene.conventions};
    const FilmTarget target{&film, &prepared.channels, viewport, scene.background};
    TileRenderer renderer(scene, prepared.plan, prepared.geometry, target);
    std::vector<QuadCoverage> quads;
    for (const Tile& tile : bin_triangles(prepared.geometry, quad_rect(viewport, prepared.window),
                                          RenderOptions().tile)) {
        const auto& of_tile = renderer.find_visible(tile);
        quads.insert(quads.end(), of_tile.begin(), of_tile.end());
    }
    return quads;
}

std::string explain(const Scene& scene, const RenderOptions& options) {
    const PreparedRender prepared = plan_render(scene, options, select_kernels(options));
    return explain(prepared);
}

void render_by(const Scene& scene, const RenderOptions& options, const Drawing& drawing,
               GeometryCache* geometry) {
    const KernelTable& kernels = select_kernels(options);
    const AllowedThreads allowed(options.threads);
    Phases phases;
    Stopwatch watch;
    PreparedRender prepared = plan_render(scene, options, kernels, geometry);
    phases.plan = watch.lap();
    load_textures_of(prepared, options);
    phases.load = watch.lap();
    DrawRecord record;
    drawing(prepared, record, options.stats != nullptr ? Recording::counts : Recording::nothing);
    phases.draw = watch.lap();
    if (options.summary != nullptr) *options.summary = summarize(prepared, record, phases);
    if (options.stats != nullptr) *options.stats = count_all(prepared, options, record, phases);
    if (geometry != nullptr) geometry->give_back(std::move(prepared.geometry));
}

void load_ahead(const Scene& scene, const RenderOptions& options, GeometryCache& geometry) {
    const KernelTable& kernels = select_kernels(options);
    const AllowedThreads allowed(options.threads);
    PreparedRender prepared = plan_render(scene, options, kernels, &geometry);
    load_textures_of(prepared, options);
    geometry.give_back(std::move(prepared.geometry));
}

Drawing drawing_into(Film& film, const RenderOptions& options) {
    return [&](const PreparedRender& prepared, DrawRecord& record, Recording recording) {
        draw_into(film, prepared, options, &record, recording);
    };
}

void render_into(Film& film, const Scene& scene, const RenderOptions& options) {
    render_by(scene, options, drawing_into(film, options));
}

Film render(const Scene& scene, const RenderOptions& options) {
    Film film;
    render_into(film, scene, options);
    return film;
}

}  // namespace quadrel
