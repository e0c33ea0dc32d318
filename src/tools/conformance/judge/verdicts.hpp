// What is said of a pixel, stage by stage.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace quadrel::conformance {

/// Of a pixel's channels of one group, the first that holds.
enum class Verdict : std::int32_t {
    same,       ///< the reference's bits
    inherited,  ///< the bits that the reference makes of the implementation's own earlier values
    rounded,    ///< off these by no more than a few roundings (PermittedErrors::rounding)
    perturbed,  ///< between what it makes of these, moved by permitted errors (perturbations.hpp);
                ///< or the reference's where mix is written out, whose roundings are left open
    legal,      ///< in the range of what the specification permits
    open,       ///< that range is infinite, or a look-up was at NaN: nothing is known
    divergent,  ///< behind look-ups in a loop that fragments of the quad have left at different
                ///< steps, whose implicit derivatives are undefined (GLSL 4.60, 8.9)
    unordered,  ///< the reference's where min and max are written out as comparisons: what they
                ///< make of NaN, and of zeros of two signs, is left to implementations
    defect,     ///< the reference's where a defect of the implementation that is known, with the
                ///< paragraph of the specification, is kept out of the way (rewrites.hpp)
    coverage,   ///< covered on one side only, beside an edge that snapping may move past it; or
                ///< by another object, where depths are the same but for roundings
    left,       ///< not looked at: of more pixels than were to be
    unexplained,  ///< anything else
};
inline constexpr std::size_t verdict_count = 12;

inline constexpr std::array<const char*, verdict_count> verdict_names{
    "same",      "inherited", "rounded", "perturbed", "legal", "open",
    "divergent", "unordered", "defect",  "coverage",  "left",  "unexplained"};

using Counts = std::array<std::uint64_t, verdict_count>;

inline std::uint64_t total(const Counts& counts) {
    std::uint64_t sum = 0;
    for (const std::uint64_t count : counts) sum += count;
    return sum;
}

inline std::uint64_t count_of(const Counts& counts, Verdict verdict) {
    return counts[static_cast<std::size_t>(verdict)];
}

inline void add(Counts& counts, const Counts& more) {
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += more[i];
}

/// A pixel that is not explained, in image coordinates.
struct Unexplained {
    std::string channel;
    int x = 0, y = 0;
    std::uint32_t reference = 0, found = 0;  ///< bits
    std::string command;                     ///< what re-runs the reference there
};

/// Channels of one place in the data flow.
struct GroupReport {
    std::string name;
    Counts counts{};                    ///< pixels
    std::vector<Unexplained> examples;  ///< the first few
    std::string note;                   ///< why there are no ranges; empty where there are
};

struct CaseReport {
    std::string row, map;
    int angle = 0;
    std::string refusal;              ///< why it cannot be exported; empty: it can
    std::string failure;              ///< why the implementation did not draw it; empty: it did
    std::vector<GroupReport> groups;  ///< in the order of the data flow

    Counts counts() const {
        Counts sum{};
        for (const GroupReport& group : groups) add(sum, group.counts);
        return sum;
    }
};

}  // namespace quadrel::conformance
