#include "render/bands/draw_bands.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <utility>

#include "render/bands/bands.hpp"
#include "render/bands/film_pool.hpp"
#include "render/draw/planes.hpp"
#include "render/draw/tile_progress.hpp"
#include "text/threads.hpp"

namespace quadrel {
namespace {

/// One thread's renderer, and where it draws.
struct BandRenderer {
    BandRenderer(const PreparedRender& prepared, const FilmTarget& where, Recording recording)
        : target(where),
          renderer(*prepared.scene, prepared.plan, prepared.geometry, target, recording) {}

    FilmTarget target;
    TileRenderer renderer;
};

class BandDrawing {
  public:
    BandDrawing(const PreparedRender& prepared, const RenderOptions& options, Recording recording)
        : prepared_(prepared),
          tile_(options.tile),
          bands_(make_bands(prepared, options.tile)),
          undrawn_(undrawn_bits(*prepared.scene, prepared.channels)),
          progress_(options.progress, count_tiles()),
          renderers_([this, recording] {
              return BandRenderer(prepared_, target(nullptr, nullptr), recording);
          }) {}
    BandDrawing(const BandDrawing&) = delete;
    BandDrawing& operator=(const BandDrawing&) = delete;

    std::size_t bands() const { return bands_.size(); }

    std::shared_ptr<const Film> draw(std::size_t index) {
        const Band& band = bands_[index];
        std::shared_ptr<Film> film = films_.take();
        const bool cleared =
            make_planes(*film, *prepared_.scene, band.window, prepared_.channels, undrawn_);
        const FilmTarget here = target(film.get(), cleared ? nullptr : &undrawn_);
        const std::vector<Tile> tiles =
            bin_triangles(prepared_.geometry, band.triangles, band.area, tile_);
        tbb::parallel_for(
            std::size_t(0), tiles.size(),
            [&](std::size_t i) {
                BandRenderer& local = renderers_.local();
                local.target = here;
                local.renderer.render(tiles[i]);
                progress_.advance();
            },
            tbb::simple_partitioner());
        return film;
    }

    void add_records(DrawRecord& record) const {
        for (const BandRenderer& local : renderers_) merge(record, local.renderer.record());
    }

    /// How many bands are worked on at a time: two a thread, as long as their films fit in 64 MB,
    /// but never fewer than three: one is drawn, one encoded, one waits for the rest of a chunk.
    std::size_t most_bands() const {
        constexpr std::size_t most_bytes = std::size_t(64) << 20, least = 3;
        std::size_t rows = 1;
        for (const Band& band : bands_)
            rows = std::max(rows, static_cast<std::size_t>(band.window.height()));
        const std::size_t bytes = rows * static_cast<std::size_t>(prepared_.window.width()) *
                                  prepared_.channels.size() * sizeof(std::uint32_t);
        const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
        return std::clamp(most_bytes / bytes, least, std::max(least, 2 * threads));
    }

  private:
    FilmTarget target(Film* film, const std::vector<std::uint32_t>* undrawn) const {
        const Scene& scene = *prepared_.scene;
        return {film,
                &prepared_.channels,
                {scene.width, scene.height, scene.conventions},
                scene.background,
                undrawn};
    }

    std::size_t count_tiles() const {
        const auto across = [this](int from, int to) {
            return static_cast<std::size_t>((to - 1) / tile_ - from / tile_ + 1);
        };
        std::size_t count = 0;
        for (const Band& band : bands_)
            count += across(band.area.x0, band.area.x1) * across(band.area.y0, band.area.y1);
        return count;
    }

    const PreparedRender& prepared_;
    const int tile_;
    const std::vector<Band> bands_;
    const std::vector<std::uint32_t> undrawn_;
    FilmPool films_;
    TileProgress progress_;
    tbb::enumerable_thread_specific<BandRenderer> renderers_;
};

void run_pipeline(BandDrawing& drawing, BandSink& sink) {
    using Drawn = std::shared_ptr<const Film>;
    using Step = std::shared_ptr<BandStep>;
    using Mode = tbb::filter_mode;
    std::size_t next = 0;
    const auto index = [&](tbb::flow_control& control) {
        if (next == drawing.bands()) control.stop();
        return next++;
    };
    const auto draw = [&](std::size_t band) { return drawing.draw(band); };
    const auto take = [&](Drawn band) {
        return std::make_shared<BandStep>(sink.take(std::move(band)));
    };
    const auto work = [](Step step) {
        if (step->work) step->work();
        return step;
    };
    const auto finish = [](const Step& step) {
        if (step->finish) step->finish();
    };
    tbb::parallel_pipeline(drawing.most_bands(),
                           tbb::make_filter<void, std::size_t>(Mode::serial_in_order, index) &
                               tbb::make_filter<std::size_t, Drawn>(Mode::parallel, draw) &
                               tbb::make_filter<Drawn, Step>(Mode::serial_in_order, take) &
                               tbb::make_filter<Step, Step>(Mode::parallel, work) &
                               tbb::make_filter<Step, void>(Mode::serial_in_order, finish));
}

}  // namespace

void draw_bands(const PreparedRender& prepared, const RenderOptions& options, BandSink& sink,
                DrawRecord& record, Recording recording) {
    BandDrawing drawing(prepared, options, recording);
    arena_of(options.threads).execute([&] { run_pipeline(drawing, sink); });
    drawing.add_records(record);
}

void render_bands(const Scene& scene, const RenderOptions& options, const BandSinkMaker& make,
                  GeometryCache* geometry) {
    const auto draw = [&](const PreparedRender& prepared, DrawRecord& record, Recording recording) {
        Film layout;
        name_planes(layout, scene, prepared.window, prepared.channels);
        const std::unique_ptr<BandSink> sink = make(layout);
        draw_bands(prepared, options, *sink, record, recording);
        sink->end();
    };
    render_by(scene, options, draw, geometry);
}

}  // namespace quadrel
