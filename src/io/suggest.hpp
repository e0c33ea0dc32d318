// The nearest known word, for messages about a misspelt one.
#pragma once

#include <algorithm>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace quadrel {

/// Insertions, deletions, replacements and swaps of neighbours that turn `a` into `b` (optimal
/// string alignment).
inline int edit_distance(std::string_view a, std::string_view b) {
    std::vector<int> before_previous(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
    std::iota(previous.begin(), previous.end(), 0);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        current[0] = static_cast<int>(i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const int replaced = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            current[j] = std::min({replaced, previous[j] + 1, current[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                current[j] = std::min(current[j], before_previous[j - 2] + 1);
        }
        before_previous.swap(previous);
        previous.swap(current);
    }
    return previous[b.size()];
}

/// The known word nearest to `word`, or empty if none is near (more than half of it changed). One
/// that begins with `word` counts as one change away.
template <class Words>
std::string nearest_word(std::string_view word, const Words& known) {
    std::string best;
    int least = static_cast<int>(word.size()) / 2 + 2;
    for (const auto& candidate : known) {
        const bool begun = word.size() > 1 && std::string_view(candidate).starts_with(word);
        const int distance = begun && word != candidate ? 1 : edit_distance(word, candidate);
        if (distance < least) {
            least = distance;
            best = std::string(candidate);
        }
    }
    return best;
}

/// "one of a, b, c", with the nearest to `word` named first if there is one.
template <class Words>
std::string one_of(std::string_view word, const Words& known) {
    const std::string nearest = nearest_word(word, known);
    std::string text = nearest.empty() ? "one of" : "\"" + nearest + "\", or one of";
    const char* separator = " ";
    for (const auto& candidate : known) {
        text += separator + std::string(candidate);
        separator = ", ";
    }
    return known.empty() ? "none: there is none to name" : text;
}

}  // namespace quadrel
