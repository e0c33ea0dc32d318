// An implementation's film beside the reference's: what is known of the two, group by group.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "conformance/judge/groups.hpp"
#include "conformance/judge/judge.hpp"
#include "conformance/judge/reruns.hpp"
#include "quadrel/film/film.hpp"

namespace quadrel::conformance {

/// Pixels are counted row by row, over the frame.
struct Comparison {
    /// Draws the reference beside the implementation's film of the scene. Both must outlive it.
    Comparison(const Scene& of, const Film& by, const JudgeOptions& how);

    int x_of(std::size_t i) const { return static_cast<int>(i) % found.window.width(); }
    int y_of(std::size_t i) const { return static_cast<int>(i) / found.window.width(); }
    /// Where a pixel of the frame lies in a film of a part of it.
    std::size_t in(const Film& film, std::size_t i) const { return film.index(x_of(i), y_of(i)); }

    std::uint32_t found_bits(const std::string& channel, std::size_t i) const {
        return found.find(channel)->bits[i];
    }
    /// Whether a film has the implementation's bits.
    bool equals(const Film& film, const std::string& channel, std::size_t i) const {
        return film.find(channel)->bits[in(film, i)] == found_bits(channel, i);
    }
    bool equals(const Film& film, const Group& group, std::size_t i) const;

    /// The implementation's values of the groups before, around these pixels.
    Film given(const std::vector<std::size_t>& pixels) const;
    /// What the group's stages make of an image of the values before, at these pixels. Look-ups of
    /// heights give `heights` times what maps have, of a level of detail with `levels` added.
    Film made_of(const Group& group, const Film& image, const std::vector<std::size_t>& pixels,
                 double heights = 1, double levels = 0) const;

    const Scene& scene;
    const JudgeOptions options;
    const Film& found;
    Reruns reruns;
    Film reference;
    std::vector<std::string> earlier;  ///< channels of the groups before
    std::vector<bool> skipped;         ///< pixels that one side alone covers
    std::set<std::size_t> departed;    ///< with a value before that is more than roundings away
};

}  // namespace quadrel::conformance
