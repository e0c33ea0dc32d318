#include "stroke_font.hpp"

#include <algorithm>
#include <map>

namespace quadrel::textures {
namespace {

/// Cuts the corners of a polyline (Chaikin 1974) four times; its ends stay.
Stroke rounded(Stroke stroke) {
    for (int pass = 0; pass < 4; ++pass) {
        Stroke finer{stroke.front()};
        for (std::size_t i = 1; i < stroke.size(); ++i) {
            finer.push_back(mix(stroke[i - 1], stroke[i], 0.25));
            finer.push_back(mix(stroke[i - 1], stroke[i], 0.75));
        }
        finer.push_back(stroke.back());
        stroke = std::move(finer);
    }
    return stroke;
}

const std::map<char, std::vector<Stroke>>& font() {
    static const std::map<char, std::vector<Stroke>> letters = {
        {'A', {{{0, 1}, {0.5, 0}, {1, 1}}, {{0.2, 0.6}, {0.8, 0.6}}}},
        {'D',
         {{{0.3, 1}, {0, 1}, {0, 0}, {0.3, 0}}, rounded({{0.3, 0}, {1, 0}, {1, 1}, {0.3, 1}})}},
        {'E', {{{1, 0}, {0, 0}, {0, 1}, {1, 1}}, {{0, 0.5}, {0.8, 0.5}}}},
        {'L', {{{0, 0}, {0, 1}, {1, 1}}}},
        {'Q',
         {rounded({{0.5, 0}, {0.98, 0}, {1, 0.5}, {0.98, 1}, {0.5, 1}}),
          rounded({{0.5, 1}, {0.02, 1}, {0, 0.5}, {0.02, 0}, {0.5, 0}}),
          {{0.62, 0.68}, {1.02, 1.06}}}},
        {'R',
         {{{0, 1}, {0, 0}, {0.5, 0}},
          rounded({{0.5, 0}, {1, 0}, {1, 0.54}, {0.5, 0.54}}),
          {{0, 0.54}, {0.5, 0.54}, {1, 1}}}},
        {'U',
         {{{0, 0}, {0, 0.5}}, rounded({{0, 0.5}, {0, 1}, {1, 1}, {1, 0.5}}), {{1, 0.5}, {1, 0}}}},
    };
    return letters;
}

double distance_to_segment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
    const glm::dvec2 along = b - a;
    const double t = saturate(dot(p - a, along) / dot(along, along));
    return length(p - a - along * t);
}

}  // namespace

std::span<const Stroke> strokes_of(char letter) {
    const auto found = font().find(letter);
    if (found == font().end()) return {};
    return found->second;
}

double distance_to_letter(char letter, glm::dvec2 p, glm::dvec2 size) {
    double least = 1e9;
    for (const Stroke& stroke : strokes_of(letter))
        for (std::size_t i = 1; i < stroke.size(); ++i)
            least = std::min(least, distance_to_segment(p, stroke[i - 1] * size, stroke[i] * size));
    return least;
}

}  // namespace quadrel::textures
