#include "render/draw/tile_film.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "quadrel/film/channels.hpp"

namespace quadrel {
namespace {

using Kind = ChannelSource::Kind;

std::uint32_t float_bits(float x) { return canonical_bits(std::bit_cast<std::uint32_t>(x)); }

float float_not_above(double x) {
    const auto f = static_cast<float>(x);
    return f > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}

std::uint32_t covered_lanes(const QuadCoverage& quad) {
    std::uint32_t mask = 0;
    for (int lane = 0; lane < 4; ++lane) mask |= (quad.samples[lane] ? 1u : 0u) << lane;
    return mask;
}

bool has_all(std::uint16_t mask, int samples) { return mask == (1u << samples) - 1; }

/// Whether all samples of all four pixels are the fragment's.
bool is_whole(const QuadCoverage& quad, int samples) {
    const std::uint64_t all = (1u << samples) - 1;
    return std::bit_cast<std::uint64_t>(quad.samples) == all * 0x0001'0001'0001'0001u;
}

/// The end of a range or of a gap that a channel shows. (Of the opposite the other one.)
double shown_end(const ChannelSource& source, const FragmentRange& range) {
    const bool other = source.negated;
    const double sign = other ? -1 : 1;
    switch (source.kind) {
        case ChannelSource::Kind::range_low:
            return sign * (other ? range.high : range.low);
        case ChannelSource::Kind::range_high:
            return sign * (other ? range.low : range.high);
        case ChannelSource::Kind::gap_low:
            return sign * (other ? range.gap_high : range.gap_low);
        default:
            return sign * (other ? range.gap_low : range.gap_high);
    }
}

}  // namespace

std::ptrdiff_t FilmTarget::index(int x, int y) const {
    const int row = flip_row(viewport, y);
    const Window& w = film->window;
    if (x < w.x0 || x >= w.x1 || row < w.y0 || row >= w.y1) return -1;
    return static_cast<std::ptrdiff_t>(row - w.y0) * w.width() + (x - w.x0);
}

void TileFilm::begin(const PixelRect& rect, bool covered) {
    rect_ = rect;
    const Window& w = target_.film->window;
    held_ = intersect(rect, flip_rect(target_.viewport, {w.x0, w.y0, w.x1, w.y1}));
    if (target_.undrawn != nullptr && !covered) clear_tile();
    if (sample_count_ == 1) return;
    const std::size_t pixels = std::size_t(rect.width()) * rect.height();
    states_.assign(pixels, State::untouched);
    unwritten_ = pixels;
    samples_.resize(pixels * sample_count_);
}

std::size_t TileFilm::tile_pixel(int x, int y) const {
    return std::size_t(y - rect_.y0) * rect_.width() + (x - rect_.x0);
}

/// The samples of a pixel that a fragment has a part of; background until one is written.
ColorSample* TileFilm::samples_of(std::size_t pixel) {
    ColorSample* const samples = samples_.data() + pixel * sample_count_;
    if (states_[pixel] == State::untouched) std::fill_n(samples, sample_count_, background_);
    states_[pixel] = State::sampled;
    return samples;
}

void TileFilm::clear_tile() const {
    if (held_.empty()) return;
    for (std::size_t c = 0; c < target_.film->planes.size(); ++c)
        for (int y = held_.y0; y < held_.y1; ++y)
            std::fill_n(target_.film->planes[c].bits.data() + target_.index(held_.x0, y),
                        held_.width(), (*target_.undrawn)[c]);
}

void TileFilm::collect(const QuadCoverage* quads, int count, const TileBuffer& tile) {
    runs_.clear();
    fragments_.clear();
    for (int q = 0; q < count;) {
        const int run = rows_ ? run_length(quads + q, count - q) : 0;
        if (run > 0)
            collect_run(quads, q, run);
        else
            collect_fragments(quads[q], q, tile);
        q += std::max(run, 1);
    }
}

/// How many quads from the first on are a run.
int TileFilm::run_length(const QuadCoverage* quads, int count) const {
    const int x = quads->x, y = quads->y;
    if (y < held_.y0 || y + 2 > held_.y1 || x < held_.x0) return 0;
    int n = 0;
    while (n < count && quads[n].y == y && quads[n].x == x + 2 * n && x + 2 * n + 2 <= held_.x1 &&
           is_whole(quads[n], sample_count_))
        ++n;
    return n;
}

void TileFilm::collect_run(const QuadCoverage* quads, int first, int count) {
    const QuadCoverage& quad = quads[first];
    runs_.push_back(
        {first, count, target_.index(quad.x, quad.y), target_.index(quad.x, quad.y + 1)});
    pixels_ += 4 * static_cast<std::uint64_t>(count);
    for (int y = quad.y; sample_count_ > 1 && y < quad.y + 2; ++y)
        std::fill_n(states_.data() + tile_pixel(quad.x, y), 2 * count, State::written);
    unwritten_ -= 4 * static_cast<std::size_t>(count);
}

void TileFilm::collect_fragments(const QuadCoverage& quad, int q, const TileBuffer& tile) {
    for (int lane = 0; lane < 4; ++lane) {
        if (!quad.samples[lane]) continue;
        const int x = lane_x(quad, lane), y = lane_y(quad, lane);
        const std::ptrdiff_t pixel = target_.index(x, y);
        if (pixel < 0) continue;
        int lowest = 0;
        if (!has_all(quad.samples[lane], sample_count_))  // a tile that was drawn
            while (tile.triangle(x, y, lowest) == no_triangle) ++lowest;
        const bool owns = (quad.samples[lane] >> lowest & 1) != 0;
        pixels_ += owns;
        fragments_.push_back({pixel, tile_pixel(x, y), 4 * q + lane, quad.samples[lane], owns});
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
        ColorSample* const samples = samples_of(fragment.tile_pixel);
        for (int s = 0; s < sample_count_; ++s)
            if (fragment.samples >> s & 1) samples[s] = sample;
    }
}

/// An array of the batch as a plane: the common case.
void TileFilm::add_values(const LaneBits& bits, std::uint32_t* plane) const {
    for (const Run& run : runs_)
        bits.rows(4 * run.first, run.quads, plane + run.even, plane + run.odd);
    for (const Fragment& fragment : fragments_)
        if (fragment.owns_pixel) plane[fragment.pixel] = bits(fragment.lane);
}

void TileFilm::add_constant(std::uint32_t bits, std::uint32_t* plane) const {
    for (const Run& run : runs_)
        for (const std::ptrdiff_t row : {run.even, run.odd})
            std::fill_n(plane + row, 2 * run.quads, bits);
    for (const Fragment& fragment : fragments_)
        if (fragment.owns_pixel) plane[fragment.pixel] = bits;
}

/// bits(quad, lane of the quad, lowest sample that the fragment owns).
template <class Bits>
void TileFilm::add_fragments(const QuadCoverage* quads, std::uint32_t* plane,
                             const Bits& bits) const {
    for (const Run& run : runs_)
        for (int q = 0; q < run.quads; ++q)
            for (int lane = 0; lane < 4; ++lane)
                plane[(lane < 2 ? run.even : run.odd) + 2 * q + lane % 2] =
                    bits(quads[run.first + q], lane, 0);
    for (const Fragment& fragment : fragments_)
        if (fragment.owns_pixel)
            plane[fragment.pixel] = bits(quads[fragment.lane / 4], fragment.lane % 4,
                                         std::countr_zero(fragment.samples));
}

void TileFilm::add_plane(const ChannelSource& source, std::uint32_t* plane, const Batch& batch,
                         const QuadCoverage* quads, const Geometry& geometry,
                         const TileBuffer& tile, const Judges& judges) const {
    const auto in_batch = [&](const QuadCoverage& quad, int lane) {
        return 4 * static_cast<int>(&quad - quads) + lane;
    };
    const auto add = [&](const auto& bits) { add_fragments(quads, plane, bits); };
    switch (source.kind) {
        case Kind::value:
        case Kind::z:
            return add_values(source.value == Value::color && source.kind == Kind::value
                                  ? batch.bits(source).resolved(sample_count_)
                                  : batch.bits(source),
                              plane);
        case Kind::coverage:
            return add_constant(float_bits(1.0f), plane);
        case Kind::depth:
            return add([&](auto& quad, int lane, int sample) {
                return float_bits(tile.depth(lane_x(quad, lane), lane_y(quad, lane), sample));
            });
        case Kind::object:
            return add(
                [&](auto& quad, int, int) { return geometry.triangles[quad.triangle].object; });
        case Kind::primitive:
            return add(
                [&](auto& quad, int, int) { return geometry.triangles[quad.triangle].primitive; });
        case Kind::lane:
            return add([](auto&, int lane, int) { return static_cast<std::uint32_t>(lane); });
        case Kind::quad_coverage:
            return add([](auto& quad, int, int) { return covered_lanes(quad); });
        case Kind::exact:
        case Kind::exact_error:
            return add([&](auto& quad, int lane, int) {
                return float_bits(
                    static_cast<float>(judges.exact->value(source, batch, in_batch(quad, lane))));
            });
        case Kind::error:
            return add([&](auto& quad, int lane, int) {
                const int y = flip_row(target_.viewport, lane_y(quad, lane));
                return judges.errors->bits(source, batch, in_batch(quad, lane), lane_x(quad, lane),
                                           y);
            });
        case Kind::range_low:
        case Kind::range_high:
        case Kind::gap_low:
        case Kind::gap_high:
        case Kind::range_paths:
        case Kind::undecided:
        case Kind::pixel_certified:
        case Kind::pixel_reason:
            return add_range(source, plane, quads,
                             source.range_set == RangeSet::gpu ? *judges.limits : *judges.bounds);
        case Kind::integral_error:
        case Kind::integral_samples:
            return;  // of integrals, which do not come fragment by fragment
    }
}

/// Ends of ranges are rounded outwards, those of a gap inwards.
void TileFilm::add_range(const ChannelSource& source, std::uint32_t* plane,
                         const QuadCoverage* quads, const RangeBatch& ranges) const {
    add_fragments(quads, plane, [&](auto& quad, int lane, int) {
        const int in_batch = 4 * static_cast<int>(&quad - quads) + lane;
        if (source.kind == Kind::undecided) return ranges.undecided(in_batch);
        if (certifies_pixels(source)) {
            const Uncertified reason = ranges.uncertified(in_batch);
            if (source.kind == Kind::pixel_reason) return static_cast<std::uint32_t>(reason);
            return reason == Uncertified::proven ? 1u : 0u;
        }
        const FragmentRange& range = ranges.range(source, in_batch);
        if (source.kind == Kind::range_paths) return range.paths;
        const double end = shown_end(source, range);
        const bool down = source.kind == Kind::range_low || source.kind == Kind::gap_high;
        return float_bits(down ? float_not_above(end) : -float_not_above(-end));
    });
}

void TileFilm::add(const Batch& batch, const QuadCoverage* quads, const Geometry& geometry,
                   const TileBuffer& tile, const Judges& judges) {
    collect(quads, batch.quads(), tile);
    if (sample_count_ > 1) add_samples(batch);
    for (std::size_t c = 0; c < target_.channels->size(); ++c) {
        const ChannelSource& source = (*target_.channels)[c];
        // Of pixels that are resolved in the end, too: it writes over them.
        add_plane(source, target_.film->planes[c].bits.data(), batch, quads, geometry, tile,
                  judges);
    }
}

std::uint32_t TileFilm::resolved_bits(const ChannelSource& source, const ColorSample& pixel) const {
    if (source.kind == Kind::coverage) return float_bits(pixel.a);
    if (source.kind == Kind::z) return float_bits(pixel.z);
    const float rgb[3] = {pixel.r, pixel.g, pixel.b};
    return float_bits(rgb[source.component]);
}

void TileFilm::end() {
    if (sample_count_ == 1 || unwritten_ == 0) return;
    const std::vector<ColorSample> nothing(static_cast<std::size_t>(sample_count_), background_);
    const ColorSample background = resolve(nothing);
    for (int y = held_.y0; y < held_.y1; ++y)
        for (int x = held_.x0; x < held_.x1; ++x) {
            const std::size_t pixel = tile_pixel(x, y);
            if (states_[pixel] == State::written) continue;
            const bool sampled = states_[pixel] == State::sampled;
            put_resolved(target_.index(x, y),
                         sampled ? resolve({samples_of(pixel), nothing.size()}) : background);
        }
}

void TileFilm::put_resolved(std::ptrdiff_t pixel, const ColorSample& resolved) const {
    for (std::size_t c = 0; c < target_.channels->size(); ++c) {
        const ChannelSource& source = (*target_.channels)[c];
        if (source.resolved())
            target_.film->planes[c].bits[static_cast<std::size_t>(pixel)] =
                resolved_bits(source, resolved);
    }
}

}  // namespace quadrel
