#include "film/preview_sink.hpp"

#include <algorithm>
#include <utility>

#include "film/preview_group.hpp"
#include "quadrel/film/preview.hpp"

namespace quadrel {
namespace {

/// The planes that are shown, without values.
Film shown_of(const Film& layout) {
    Film shown{layout.frame, layout.window, {}};
    for (const Plane* const plane : preview_group(layout).planes)
        shown.planes.push_back({plane->name, plane->type, {}});
    return shown;
}

/// Each pixel's colour is its own: a band is all that it needs.
class RowsSink : public BandSink {
  public:
    RowsSink(const std::filesystem::path& file, const Film& layout)
        : file_(file),
          window_(layout.window),
          picture_(layout.window.width(), layout.window.height(), 0) {}

    BandStep take(std::shared_ptr<const Film> band) override {
        return {[this, held = std::move(band)]() mutable {
                    const std::shared_ptr<const Film> film = std::move(held);
                    const Picture rows = preview(*film);
                    const auto row = 3 * static_cast<std::size_t>(window_.width());
                    const auto first = static_cast<std::size_t>(film->window.y0 - window_.y0);
                    std::copy(rows.rgb.begin(), rows.rgb.end(), &picture_.rgb[first * row]);
                },
                {}};
    }

    void end() override { write_png(file_, picture_); }

  private:
    std::filesystem::path file_;
    Window window_;
    Picture picture_;
};

/// What is shown is spread over the values of the whole image.
class PlanesSink : public BandSink {
  public:
    PlanesSink(const std::filesystem::path& file, const Film& layout)
        : file_(file), shown_(shown_of(layout)) {
        for (Plane& plane : shown_.planes) plane.bits.resize(shown_.window.area());
    }

    BandStep take(std::shared_ptr<const Film> band) override {
        return {[this, held = std::move(band)]() mutable {
                    const std::shared_ptr<const Film> film = std::move(held);
                    const std::size_t first = shown_.index(film->window.x0, film->window.y0);
                    for (Plane& plane : shown_.planes) {
                        const Plane& from = *film->find(plane.name);
                        std::copy(from.bits.begin(), from.bits.end(), &plane.bits[first]);
                    }
                },
                {}};
    }

    void end() override { write_png(file_, preview(shown_)); }

  private:
    std::filesystem::path file_;
    Film shown_;
};

}  // namespace

std::unique_ptr<BandSink> png_file_sink(const std::filesystem::path& file, const Film& layout) {
    if (previews_rows(layout)) return std::make_unique<RowsSink>(file, layout);
    return std::make_unique<PlanesSink>(file, layout);
}

}  // namespace quadrel
