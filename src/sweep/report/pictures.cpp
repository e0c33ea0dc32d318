#include "sweep/report/pictures.hpp"

#include <algorithm>
#include <cmath>

#include "io/image/png_encode.hpp"
#include "page/template.hpp"
#include "quadrel/num/math.hpp"

namespace quadrel::sweep {
namespace {

struct Rectangle {
    int x0, y0, x1, y1;
};

/// The pixels of a frame that a thumbnail's pixel stands for.
class Shrinking {
  public:
    Shrinking(int width, int height, int side)
        : width_(width),
          height_(height),
          scale_(std::max(1.0, double(std::max(width, height)) / side)) {}
    int width() const { return std::max(1, static_cast<int>(width_ / scale_)); }
    int height() const { return std::max(1, static_cast<int>(height_ / scale_)); }
    Rectangle of(int x, int y) const {
        const auto first = [](int i, int from, int to) {
            return static_cast<int>(std::int64_t(i) * from / to);
        };
        return {first(x, width_, width()), first(y, height_, height()),
                first(x + 1, width_, width()), first(y + 1, height_, height())};
    }

  private:
    int width_, height_;
    double scale_;
};

float mean(const Film& film, const Plane& plane, const Rectangle& r) {
    double sum = 0;
    for (int y = r.y0; y < r.y1; ++y)
        for (int x = r.x0; x < r.x1; ++x)
            sum += plane.as_float(film.index(film.window.x0 + x, film.window.y0 + y));
    return static_cast<float>(sum / ((r.x1 - r.x0) * (r.y1 - r.y0)));
}

struct Colour {
    double r, g, b;
};

Colour between(const Colour& a, const Colour& b, double t) {
    return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}

/// From 0.01 texel, 0, to 100 texels, 1.
double heat_of(double texels) {
    if (!(texels > 0.01)) return 0;
    return std::min(1.0, (log2(texels) / 3.321928094887362 + 2) / 4);
}

Colour ramp(const Colour& middle, const Colour& end, double heat) {
    const Colour black{0, 0, 0};
    return heat < 0.5 ? between(black, middle, 2 * heat) : between(middle, end, 2 * heat - 1);
}

bool is_lost(ErrorKind kind) { return kind == ErrorKind::missed || kind == ErrorKind::invented; }

Colour colour_of(ErrorKind kind, double texels) {
    if (kind == ErrorKind::not_judged) return {110, 110, 110};
    if (!std::isfinite(texels)) return {255, 255, 255};
    if (is_lost(kind)) return {230, 40, 200};
    const double heat = heat_of(texels);
    if (kind == ErrorKind::same) return {0, 0, 0};
    if (kind == ErrorKind::early) return ramp({20, 80, 200}, {120, 240, 255}, heat);
    if (kind == ErrorKind::other_surface) return ramp({20, 120, 50}, {130, 255, 150}, heat);
    return ramp({190, 70, 10}, {255, 240, 120}, heat);
}

/// How much a pixel is worth showing.
double weight(ErrorKind kind, double texels) {
    if (kind == ErrorKind::not_judged) return -1;
    if (!std::isfinite(texels)) return 1e30;
    return (is_lost(kind) ? 1e20 : 0) + texels;
}

}  // namespace

Picture thumbnail(const Film& film, int side) {
    const Shrinking to(film.window.width(), film.window.height(), side);
    Picture picture(to.width(), to.height(), 0);
    const Plane &r = *film.find("R"), &g = *film.find("G"), &b = *film.find("B");
    for (int y = 0; y < to.height(); ++y)
        for (int x = 0; x < to.width(); ++x) {
            const Rectangle pixels = to.of(x, y);
            picture.set(x, y, srgb_code(mean(film, r, pixels)), srgb_code(mean(film, g, pixels)),
                        srgb_code(mean(film, b, pixels)));
        }
    return picture;
}

Picture error_thumbnail(const RunError& error, int width, int height, int side) {
    const Shrinking to(width, height, side);
    Picture picture(to.width(), to.height(), 0);
    for (int y = 0; y < to.height(); ++y)
        for (int x = 0; x < to.width(); ++x) {
            const Rectangle pixels = to.of(x, y);
            std::size_t worst = static_cast<std::size_t>(pixels.y0 * width + pixels.x0);
            for (int j = pixels.y0; j < pixels.y1; ++j)
                for (int i = pixels.x0; i < pixels.x1; ++i) {
                    const auto at = static_cast<std::size_t>(j * width + i);
                    if (weight(error.kinds[at], error.texels[at]) >
                        weight(error.kinds[worst], error.texels[worst]))
                        worst = at;
                }
            const Colour c = colour_of(error.kinds[worst], error.texels[worst]);
            picture.set(x, y, static_cast<std::uint8_t>(c.r), static_cast<std::uint8_t>(c.g),
                        static_cast<std::uint8_t>(c.b));
        }
    return picture;
}

std::string data_uri(const Picture& picture) {
    return "data:image/png;base64," + page::base64(encode_png("thumbnail", picture));
}

}  // namespace quadrel::sweep
