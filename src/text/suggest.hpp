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

/// The most changes after which a word of that length is still the same word mistyped: none of one
/// letter, one of up to five, two of up to eight, then a third of it.
inline int most_changes(std::size_t length) {
    if (length < 2) return 0;
    return length < 9 ? 1 + static_cast<int>(length) / 6 : static_cast<int>(length) / 3;
}

/// The known word nearest to `word`, or empty if none is near (most_changes). One that begins with
/// `word` counts as one change away, and one of three letters or more that `word` begins with as
/// just near enough; of these the longest.
template <class Words>
std::string nearest_word(std::string_view word, const Words& known) {
    constexpr std::size_t least_beginning = 3;
    std::string best;
    const int most = most_changes(word.size());
    int least = most + 1;
    for (const auto& candidate : known) {
        const std::string_view text = candidate;
        const bool begun = word.size() > 1 && text.starts_with(word) && text != word;
        const bool longer = text.size() >= least_beginning && word.starts_with(text);
        int distance = begun ? 1 : edit_distance(word, text);
        if (longer) distance = std::min(distance, most);
        if (distance < least || (longer && distance == least && text.size() > best.size())) {
            least = distance;
            best = std::string(text);
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
