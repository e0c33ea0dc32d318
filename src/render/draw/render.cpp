#include "quadrel/render.hpp"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <mutex>

#include "bake/allowed_threads.hpp"
#include "quadrel/check.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/channels.hpp"
#include "quadrel/stats.hpp"
#include "render/plan/prepared.hpp"
#include "render/registry/added_stages.hpp"
#include "render/stats/stats_record.hpp"

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

void check_options(const RenderOptions& options) {
    if (options.tile < 2 || options.tile > 1024 || options.tile % 2 != 0)
        throw UsageError(
            fmt::format("tile size {}: expected an even number from 2 to 1024", options.tile));
    if (options.threads < 0) throw UsageError("the number of threads cannot be negative");
}

std::vector<ChannelSource> channel_sources(const Scene& scene, const RenderOptions& options) {
    std::vector<ChannelSource> sources;
    for (const std::string& name : expand_channels(options.channels)) {
        sources.push_back(channel_source(name));
        if (sources.back().light > 0 &&
            sources.back().light >= static_cast<int>(scene.lights.size()))
            throw UsageError(
                fmt::format("channel \"{}\": the scene has {} lights", name, scene.lights.size()));
    }
    return sources;
}

/// Of a film: 8 GB, and what a reader of EXR files takes.
constexpr std::int64_t most_values = std::int64_t(1) << 31;

void check_film_size(const Scene& scene, const Window& window, std::size_t channels) {
    const std::int64_t values =
        std::int64_t(window.width()) * window.height() * static_cast<std::int64_t>(channels);
    if (values <= most_values) return;
    throw InputError(
        scene.file.string(), "size",
        fmt::format("{}x{} pixels of {} channels", window.width(), window.height(), channels),
        "at most 2^31 values in all, or a window of it");
}

/// The bits of a channel where nothing is drawn.
std::uint32_t background_bits(const Scene& scene, const ChannelSource& channel) {
    if (channel.kind != ChannelSource::Kind::value || channel.value != Value::color)
        return uncovered_bits(channel.name);
    return canonical_bits(std::bit_cast<std::uint32_t>(scene.background[channel.component]));
}

/// Bits of each plane where nothing is drawn.
std::vector<std::uint32_t> undrawn_bits(const Scene& scene,
                                        const std::vector<ChannelSource>& channels) {
    std::vector<std::uint32_t> bits;
    for (const ChannelSource& channel : channels) bits.push_back(background_bits(scene, channel));
    return bits;
}

bool has_planes_of(const Film& film, const Window& window, std::size_t count) {
    return film.planes.size() == count &&
           std::all_of(film.planes.begin(), film.planes.end(),
                       [&](const Plane& plane) { return plane.bits.size() == window.area(); });
}

/// Makes the planes, in the memory that the film has where it is large enough. Where it has as many
/// planes of that size already they keep what they hold, for tiles to clear; else they become
/// `undrawn`, on the arena's threads. Whether they did.
bool make_planes(Film& film, const Scene& scene, const Window& window,
                 const std::vector<ChannelSource>& channels,
                 const std::vector<std::uint32_t>& undrawn) {
    check_film_size(scene, window, channels.size());
    const bool clear = !has_planes_of(film, window, channels.size());
    film.frame = {0, 0, scene.width, scene.height};
    film.window = window;
    film.planes.resize(channels.size());
    tbb::parallel_for(std::size_t(0), channels.size(), [&](std::size_t c) {
        Plane& plane = film.planes[c];
        plane.name = channels[c].name;
        plane.type = channels[c].type;
        if (clear) plane.bits.assign(window.area(), undrawn[c]);
    });
    return clear;
}

/// The window in window coordinates, grown to whole quads.
PixelRect quad_rect(const Viewport& viewport, const Window& window) {
    PixelRect rect = flip_rect(viewport, {window.x0, window.y0, window.x1, window.y1});
    rect.x0 &= ~1;
    rect.y0 &= ~1;
    rect.x1 = std::min((rect.x1 + 1) & ~1, viewport.width);
    rect.y1 = std::min((rect.y1 + 1) & ~1, viewport.height);
    return rect;
}

class Progress {
  public:
    Progress(const std::function<void(double)>& report, std::size_t total)
        : report_(report), total_(total) {}

    void advance() {
        if (!report_) return;
        const std::lock_guard lock(mutex_);
        report_(static_cast<double>(++done_) / static_cast<double>(total_));
    }

  private:
    const std::function<void(double)>& report_;
    std::size_t total_, done_ = 0;
    std::mutex mutex_;
};

class Stopwatch {
  public:
    /// Time since the last lap, or the beginning.
    PhaseTime lap() {
        const PhaseTime now = so_far();
        const PhaseTime lap{now.wall_ms - last_.wall_ms, now.cpu_ms - last_.cpu_ms};
        last_ = now;
        return lap;
    }

  private:
    static PhaseTime so_far() {
        const std::chrono::duration<double, std::milli> wall =
            std::chrono::steady_clock::now().time_since_epoch();
        timespec cpu{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
        return {wall.count(),
                1e3 * static_cast<double>(cpu.tv_sec) + 1e-6 * static_cast<double>(cpu.tv_nsec)};
    }

    PhaseTime last_ = so_far();
};

tbb::task_arena task_arena(const RenderOptions& options) {
    return tbb::task_arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
}

void load_textures_of(PreparedRender& prepared, const RenderOptions& options) {
    task_arena(options).execute([&] {
        load_plan_textures(*prepared.scene, prepared.used, prepared.plan,
                           {options.baking, options.not_kept});
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
    Progress progress(options.progress, tiles.size());
    task_arena(options).execute([&] {
        tbb::enumerable_thread_specific<TileRenderer> renderers(make);
        tbb::parallel_for(std::size_t(0), tiles.size(), [&](std::size_t i) {
            renderers.local().render(tiles[i]);
            progress.advance();
        });
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

}  // namespace

PreparedRender plan_render(const Scene& scene, const RenderOptions& options,
                           const KernelTable& kernels) {
    check_options(options);
    PreparedRender prepared{
        &scene, checked_window(scene, options), channel_sources(scene, options), {}, {}, {}};
    prepared.plan = make_render_plan(scene, prepared.channels, kernels, options.skip);
    prepared.plan.isa = options.isa;
    prepared.geometry = assemble_geometry(scene, prepared.plan.hardware, parts_read(prepared.plan));
    prepared.used = std::vector<bool>(scene.materials.size(), true);
    if (options.skip) {
        const Viewport viewport{scene.width, scene.height, scene.conventions};
        prepared.used =
            used_materials(scene, prepared.geometry, quad_rect(viewport, prepared.window));
    }
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
    const std::vector<std::uint32_t> undrawn = undrawn_bits(scene, prepared.channels);
    const bool cleared = task_arena(options).execute(
        [&] { return make_planes(film, scene, prepared.window, prepared.channels, undrawn); });
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
    RenderOptions silent = options;
    silent.progress = nullptr;
    render_tiles(
        prepared, silent,
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

void render_into(Film& film, const Scene& scene, const RenderOptions& options) {
    const KernelTable& kernels = select_kernels(options);
    const AllowedThreads allowed(std::max(options.threads, 0));
    Phases phases;
    Stopwatch watch;
    PreparedRender prepared = plan_render(scene, options, kernels);
    phases.plan = watch.lap();
    load_textures_of(prepared, options);
    phases.load = watch.lap();
    DrawRecord record;
    draw_into(film, prepared, options, &record,
              options.stats != nullptr ? Recording::counts : Recording::nothing);
    phases.draw = watch.lap();
    if (options.summary != nullptr) *options.summary = summarize(prepared, record, phases);
    if (options.stats != nullptr) *options.stats = count_all(prepared, options, record, phases);
}

Film render(const Scene& scene, const RenderOptions& options) {
    Film film;
    render_into(film, scene, options);
    return film;
}

}  // namespace quadrel
