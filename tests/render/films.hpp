// Rendering and comparing films.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "quadrel/film/channels.hpp"
#include "quadrel/render.hpp"

namespace quadrel::render_tests {

/// What the checks are run on: render(), or one with a planted error.
using Renderer = std::function<Film(const Scene&, const RenderOptions&)>;

/// Whether a channel is the judge's: these have tests of their own, and take longer than all
/// others.
inline bool is_judged(const std::string& name) {
    return name.starts_with("oracle.") ||
           (name.starts_with("certified") && !is_drawn_apart(name)) || name == "occlusion.error";
}

/// Every channel of the table that every scene has, but the judge's; those of a light once for each
/// light of the scene.
inline std::vector<std::string> all_channels(const Scene& scene) {
    std::vector<std::string> names;
    for (const ChannelInfo& channel : channel_table()) {
        if (is_drawn_apart(channel.name) || is_judged(channel.name)) continue;
        const std::size_t index = channel.name.find("<i>");
        if (index == std::string::npos) {
            names.push_back(channel.name);
            continue;
        }
        for (std::size_t light = 0; light < scene.lights.size(); ++light)
            names.push_back(std::string(channel.name).replace(index, 3, std::to_string(light)));
    }
    return names;
}

/// Everything but the counts that tell how it came about.
inline std::vector<std::string> channels_without_counts(const Scene& scene) {
    std::vector<std::string> names = all_channels(scene);
    std::erase_if(names, [](const std::string& name) {
        return name.ends_with("steps") || name.ends_with("fetches");
    });
    return names;
}

/// `names` without those that equal one of `left_out` or begin with it and a dot.
inline std::vector<std::string> without(std::vector<std::string> names,
                                        const std::vector<std::string>& left_out) {
    std::erase_if(names, [&](const std::string& name) {
        return std::any_of(left_out.begin(), left_out.end(), [&](const std::string& group) {
            return name == group || name.rfind(group + ".", 0) == 0;
        });
    });
    return names;
}

/// A render on the declared truth: plain lanes, one thread.
inline Film take(const Renderer& renderer, const Scene& scene,
                 const std::vector<std::string>& channels = {}) {
    RenderOptions options;
    options.channels = channels;
    options.isa = "scalar";
    options.threads = 1;
    return renderer(scene, options);
}

inline float value(const Film& film, const std::string& channel, int x, int y) {
    return film.find(channel)->as_float(film.index(x, y));
}
inline std::uint32_t bits(const Film& film, const std::string& channel, int x, int y) {
    return film.find(channel)->bits[film.index(x, y)];
}

/// The film with only these planes.
inline Film with_planes(const Film& film, const std::vector<std::string>& names) {
    Film out{film.frame, film.window, {}};
    for (const std::string& name : names) out.planes.push_back(*film.find(name));
    return out;
}

/// A condition on a pixel.
using Where = std::function<bool(int x, int y)>;

/// Whether the planes of `expected` are in `found`, with the same bits at the pixels of `where`.
inline testing::AssertionResult same_bits(const Film& expected, const Film& found,
                                          const Where& where = {}) {
    const Window& w = expected.window;
    if (w != found.window || expected.frame != found.frame)
        return testing::AssertionFailure() << "another frame or window";
    for (const Plane& plane : expected.planes) {
        const Plane* other = found.find(plane.name);
        if (!other || other->type != plane.type)
            return testing::AssertionFailure() << "no channel " << plane.name;
        for (int y = w.y0; y < w.y1; ++y)
            for (int x = w.x0; x < w.x1; ++x) {
                const std::size_t i = expected.index(x, y);
                if (plane.bits[i] == other->bits[i] || (where && !where(x, y))) continue;
                return testing::AssertionFailure() << fmt::format(
                           "{} at {},{}: expected {:#x} ({}), found {:#x} ({})", plane.name, x, y,
                           plane.bits[i], plane.as_float(i), other->bits[i], other->as_float(i));
            }
    }
    return testing::AssertionSuccess();
}

/// Whether a pixel is covered, in a film with channel A.
inline Where covered(const Film& film) {
    return [&film](int x, int y) { return value(film, "A", x, y) > 0; };
}

/// Whether the predicate holds at every pixel of `where`, and at one at least.
template <class Predicate>
testing::AssertionResult everywhere(const Film& film, const Where& where,
                                    const Predicate& predicate) {
    int pixels = 0;
    for (int y = film.window.y0; y < film.window.y1; ++y)
        for (int x = film.window.x0; x < film.window.x1; ++x) {
            if (where && !where(x, y)) continue;
            ++pixels;
            const std::string complaint = predicate(x, y);
            if (!complaint.empty())
                return testing::AssertionFailure() << "at " << x << "," << y << ": " << complaint;
        }
    if (pixels == 0) return testing::AssertionFailure() << "no such pixel";
    return testing::AssertionSuccess();
}

inline std::string differs(const char* what, double found, double expected, double tolerance) {
    if (found == expected || std::abs(found - expected) <= tolerance) return {};
    return fmt::format("{} is {}, expected {}", what, found, expected);
}

}  // namespace quadrel::render_tests
