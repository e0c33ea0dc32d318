#include "render/draw/tile_film.hpp"

#include <bit>
#include <limits>

#include "quadrel/film/channels.hpp"

namespace quadrel {
namespace {

using Kind = ChannelSource::Kind;

std::uint32_t float_bits(float x) { return canonical_bits(std::bit_cast<std::uint32_t>(x)); }

std::uint32_t covered_lanes(const QuadCoverage& quad) {
    std::uint32_t mask = 0;
    for (int lane = 0; lane < 4; ++lane) mask |= (quad.samples[lane] ? 1u : 0u) << lane;
    return mask;
}

}  // namespace

std::ptrdiff_t FilmTarget::index(int x, int y) const {
    const int row = flip_row(viewport, y);
    const Window& w = film->window;
    if (x < w.x0 || x >= w.x1 || row < w.y0 || row >= w.y1) return -1;
    return static_cast<std::ptrdiff_t>(row - w.y0) * w.width() + (x - w.x0);
}

void TileFilm::begin(const PixelRect& rect) {
    rect_ = rect;
    if (sample_count_ == 1) return;  // the film's planes start as background
    ColorSample background{target_.background.r, target_.background.g, target_.background.b, 0,
                           std::numeric_limits<float>::infinity()};
    samples_.assign(std::size_t(rect.width()) * rect.height() * sample_count_, background);
}

void TileFilm::collect_fragments(const Batch& batch, const QuadCoverage* quads,
                                 const TileBuffer& tile) {
    fragments_.clear();
    for (int q = 0; q < batch.quads(); ++q) {
        const QuadCoverage& quad = quads[q];
        for (int lane = 0; lane < 4; ++lane) {
            if (!quad.samples[lane]) continue;
            const int x = lane_x(quad, lane), y = lane_y(quad, lane);
            const std::ptrdiff_t pixel = target_.index(x, y);
            if (pixel < 0) continue;
            int lowest = 0;
            while (tile.triangle(x, y, lowest) == no_triangle) ++lowest;
            const bool owns = (quad.samples[lane] >> lowest & 1) != 0;
            pixels_ += owns;
            fragments_.push_back({pixel, std::size_t(y - rect_.y0) * rect_.width() + (x - rect_.x0),
                                  4 * q + lane, std::countr_zero(quad.samples[lane]),
                                  quad.samples[lane], owns, &quad});
        }
    }
}

void TileFilm::add_samples(const Batch& batch) {
    constexpr int color = slot_of(Value::color), hit = slot_of(Value::hit_P);
    for (const Fragment& fragment : fragments_) {
        const int lane = fragment.lane;
        ColorSample sample;
        if (batch.has(color)) {
            sample.r = batch.real(color, lane);
            sample.g = batch.real(color + 1, lane);
            sample.b = batch.real(color + 2, lane);
        }
        sample.a = 1;
        if (batch.has(hit)) sample.z = -batch.real(hit + 2, lane);
        for (int s = 0; s < sample_count_; ++s)
            if (fragment.samples >> s & 1)
                samples_[fragment.tile_pixel * sample_count_ + s] = sample;
    }
}

std::uint32_t TileFilm::fragment_bits(const ChannelSource& source, const Batch& batch,
                                      const Fragment& fragment, const Geometry& geometry,
                                      const TileBuffer& tile) const {
    const QuadCoverage& quad = *fragment.quad;
    const int lane = fragment.lane % 4;
    switch (source.kind) {
        case Kind::value:
            return batch.bits(source)(fragment.lane);
        case Kind::coverage:
            return float_bits(1.0f);
        case Kind::z:
            return float_bits(-batch.real(slot_of(Value::hit_P) + 2, fragment.lane));
        case Kind::depth:
            return float_bits(
                tile.depth(lane_x(quad, lane), lane_y(quad, lane), fragment.lowest_sample));
        case Kind::object:
            return geometry.triangles[quad.triangle].object;
        case Kind::primitive:
            return geometry.triangles[quad.triangle].primitive;
        case Kind::lane:
            return static_cast<std::uint32_t>(lane);
        case Kind::quad_coverage:
            return covered_lanes(quad);
    }
    return 0;
}

void TileFilm::add_plane(const ChannelSource& source, std::vector<std::uint32_t>& plane,
                         const Batch& batch, const Geometry& geometry,
                         const TileBuffer& tile) const {
    if (source.kind == Kind::value) {  // the common case, without the switch
        const LaneBits bits = batch.bits(source);
        for (const Fragment& fragment : fragments_)
            if (fragment.owns_pixel) plane[fragment.pixel] = bits(fragment.lane);
        return;
    }
    for (const Fragment& fragment : fragments_)
        if (fragment.owns_pixel)
            plane[fragment.pixel] = fragment_bits(source, batch, fragment, geometry, tile);
}

void TileFilm::add(const Batch& batch, const QuadCoverage* quads, const Geometry& geometry,
                   const TileBuffer& tile) {
    collect_fragments(batch, quads, tile);
    if (sample_count_ > 1) add_samples(batch);
    for (std::size_t c = 0; c < target_.channels->size(); ++c) {
        const ChannelSource& source = (*target_.channels)[c];
        if (sample_count_ > 1 && source.resolved()) continue;
        add_plane(source, target_.film->planes[c].bits, batch, geometry, tile);
    }
}

std::uint32_t TileFilm::resolved_bits(const ChannelSource& source, const ColorSample& pixel) const {
    if (source.kind == Kind::coverage) return float_bits(pixel.a);
    if (source.kind == Kind::z) return float_bits(pixel.z);
    const float rgb[3] = {pixel.r, pixel.g, pixel.b};
    return float_bits(rgb[source.component]);
}

void TileFilm::end() {
    if (sample_count_ == 1) return;
    for (int y = rect_.y0; y < rect_.y1; ++y) {
        for (int x = rect_.x0; x < rect_.x1; ++x) {
            const std::ptrdiff_t pixel = target_.index(x, y);
            if (pixel < 0) continue;
            const std::size_t first =
                (std::size_t(y - rect_.y0) * rect_.width() + (x - rect_.x0)) * sample_count_;
            const ColorSample resolved = resolve(std::span<const ColorSample>(
                samples_.data() + first, static_cast<std::size_t>(sample_count_)));
            for (std::size_t c = 0; c < target_.channels->size(); ++c) {
                const ChannelSource& source = (*target_.channels)[c];
                if (source.resolved())
                    target_.film->planes[c].bits[pixel] = resolved_bits(source, resolved);
            }
        }
    }
}

}  // namespace quadrel
