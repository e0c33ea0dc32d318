#include "render/draw/planes.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>

#include "quadrel/error.hpp"
#include "quadrel/film/channels.hpp"

namespace quadrel {
namespace {

/// The bits of a channel where nothing is drawn.
std::uint32_t background_bits(const Scene& scene, const ChannelSource& channel) {
    using enum ChannelSource::Kind;
    // Of what nothing covers there is no doubt: its range is its value.
    if (channel.kind == range_paths) return 1;
    const bool is_range = channel.kind == range_low || channel.kind == range_high ||
                          channel.kind == gap_low || channel.kind == gap_high;
    if ((channel.kind != value && !is_range) || channel.value != Value::color)
        return uncovered_bits(is_range ? range_channel(channel.name)->channel : channel.name);
    return canonical_bits(std::bit_cast<std::uint32_t>(scene.background[channel.component]));
}

bool has_planes_of(const Film& film, const Window& window, std::size_t count) {
    return film.planes.size() == count &&
           std::all_of(film.planes.begin(), film.planes.end(),
                       [&](const Plane& plane) { return plane.bits.size() == window.area(); });
}

}  // namespace

void check_film_size(const Scene& scene, const Window& window, std::size_t channels) {
    constexpr std::int64_t most_values = std::int64_t(1) << 31;
    const std::int64_t values =
        std::int64_t(window.width()) * window.height() * static_cast<std::int64_t>(channels);
    if (values <= most_values) return;
    throw InputError(
        scene.file.string(), "size",
        fmt::format("{}x{} pixels of {} channels", window.width(), window.height(), channels),
        "at most 2^31 values in all, or a window of it");
}

std::vector<std::uint32_t> undrawn_bits(const Scene& scene,
                                        const std::vector<ChannelSource>& channels) {
    std::vector<std::uint32_t> bits;
    for (const ChannelSource& channel : channels) bits.push_back(background_bits(scene, channel));
    return bits;
}

void name_planes(Film& film, const Scene& scene, const Window& window,
                 const std::vector<ChannelSource>& channels) {
    film.frame = {0, 0, scene.width, scene.height};
    film.window = window;
    film.planes.resize(channels.size());
    for (std::size_t c = 0; c < channels.size(); ++c) {
        film.planes[c].name = channels[c].name;
        film.planes[c].type = channels[c].type;
    }
}

bool make_planes(Film& film, const Scene& scene, const Window& window,
                 const std::vector<ChannelSource>& channels,
                 const std::vector<std::uint32_t>& undrawn) {
    const bool clear = !has_planes_of(film, window, channels.size());
    name_planes(film, scene, window, channels);
    if (clear)
        tbb::parallel_for(std::size_t(0), channels.size(), [&](std::size_t c) {
            film.planes[c].bits.assign(window.area(), undrawn[c]);
        });
    return clear;
}

PixelRect quad_rect(const Viewport& viewport, const Window& window) {
    PixelRect rect = flip_rect(viewport, {window.x0, window.y0, window.x1, window.y1});
    rect.x0 &= ~1;
    rect.y0 &= ~1;
    rect.x1 = std::min((rect.x1 + 1) & ~1, viewport.width);
    rect.y1 = std::min((rect.y1 + 1) & ~1, viewport.height);
    return rect;
}

}  // namespace quadrel
