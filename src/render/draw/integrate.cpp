// Tiles whose pixels are integrals: drawn sample by sample, block by block.
#include <algorithm>
#include <bit>

#include "quadrel/film/channels.hpp"
#include "render/draw/tile_renderer.hpp"

namespace quadrel {
namespace {

/// Side of a block in pixels, even: bounds the memory of its sums, which is 512 bytes per pixel.
constexpr int block_side = 32;

std::uint32_t bits_of(double x) {
    return canonical_bits(std::bit_cast<std::uint32_t>(static_cast<float>(x)));
}

/// What an integral has of a channel.
std::uint32_t integral_bits(const ChannelSource& source, const PixelIntegral& pixel) {
    const auto component = static_cast<std::size_t>(source.component);
    switch (source.kind) {
        case ChannelSource::Kind::coverage:
            return bits_of(pixel.mean[3]);
        case ChannelSource::Kind::integral_error:
            return bits_of(pixel.error[component]);
        case ChannelSource::Kind::integral_samples:
            return static_cast<std::uint32_t>(pixel.samples);
        default:  // colour: no other channel may be asked for
            return bits_of(pixel.mean[component]);
    }
}

/// Whether a pixel that has got all samples has missed the stated error.
bool misses(const IntegralOptions& options, const PixelIntegral& pixel) {
    return options.error > 0 && std::any_of(pixel.error.begin(), pixel.error.end(),
                                            [&](double e) { return !(e <= options.error); });
}

}  // namespace

void TileRenderer::integrate(const Tile& tile) {
    for (int y = tile.rect.y0; y < tile.rect.y1; y += block_side)
        for (int x = tile.rect.x0; x < tile.rect.x1; x += block_side) {
            Tile block{intersect(tile.rect, {x, y, x + block_side, y + block_side}), {}};
            for (const std::uint32_t t : tile.triangles)
                if (!intersect(block.rect, geometry_.triangles[t].screen.bounds).empty())
                    block.triangles.push_back(t);
            integrate_block(block);
        }
}

void TileRenderer::integrate_block(const Tile& block) {
    integral_->begin(block.rect);
    if (block.triangles.empty()) integral_->take_background();
    while (!block.triangles.empty() && integral_->next()) {
        find_visible(block);
        shade();
        integral_->end_sample();
    }
    write_integral();
}

void TileRenderer::write_integral() {
    const PixelRect& rect = integral_->rect();
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x) {
            const std::ptrdiff_t at = target_.index(x, y);
            if (at < 0) continue;
            const PixelIntegral pixel = integral_->pixel(x, y);
            for (std::size_t c = 0; c < target_.channels->size(); ++c)
                target_.film->planes[c].bits[static_cast<std::size_t>(at)] =
                    integral_bits((*target_.channels)[c], pixel);
            const auto samples = static_cast<std::uint64_t>(pixel.samples);
            record_.pixels += pixel.mean[3] > 0;
            merge(record_.integral,
                  {samples, samples, samples, misses(*plan_.integral, pixel) ? 1u : 0u});
        }
}

}  // namespace quadrel
