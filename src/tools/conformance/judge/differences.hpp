// The pixels of a group in which an implementation differs, and that are still to be explained.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "conformance/judge/comparison.hpp"
#include "conformance/judge/rounding.hpp"

namespace quadrel::conformance {

struct Differences {
    /// All pixels of other bits than the reference's; the others are counted as the same.
    Differences(Comparison& both, const Group& of);

    bool empty() const { return pixels.empty(); }

    /// Draws `own`: what the explanations below begin with.
    void draw_own();

    /// Takes out of `pixels` those of which `explained` says so, and counts them.
    template <class Explained>
    void take(Verdict verdict, const Explained& explained) {
        std::erase_if(pixels, [&](std::size_t i) {
            const bool taken = explained(i);
            if (taken) count(verdict);
            return taken;
        });
    }
    void count(Verdict verdict) { ++report.counts[static_cast<std::size_t>(verdict)]; }

    /// Planes of the group's channels: those of a film, and the implementation's.
    using Pairs = std::vector<std::pair<const Plane*, const Plane*>>;
    Pairs pairs_with(const Film& film) const;
    /// Whether the implementation's value of a channel, given by its pair with `own`, is what is
    /// made of its own earlier values, but for roundings.
    bool is_rounded(const Pairs::value_type& pair, std::size_t channel, std::size_t i) const;

    /// The first channel that is off by more than roundings, or that differs at all.
    const std::string& worst_channel(std::size_t i) const;

    Comparison& sides;
    const Group& group;
    std::vector<std::size_t> pixels;
    GroupReport report;
    Film own;                    ///< from the implementation's earlier values, around the pixels
    Roundings roundings;         ///< of that film
    std::set<std::size_t> left;  ///< pixels that were not looked at
};

/// Whether searches discard fragments.
bool discards(const Scene& scene);

// Each takes out what it explains; in the order in which they are asked.

/// Beside an edge that snapping may move past them. Nothing else is compared where one side has a
/// fragment and the other none.
void take_coverage(Differences& differences);
/// The bits that the reference makes of the implementation's own earlier values.
void take_inherited(Differences& differences);
/// Off these by no more than a few roundings.
void take_rounded(Differences& differences);
/// Behind hits at NaN: no specification says what look-ups there give.
void take_undefined(Differences& differences);
/// Between what the reference makes of the implementation's earlier values, moved by permitted
/// errors.
void take_perturbed(Differences& differences);
/// Where two objects have the same depth but for roundings, either may be seen.
void take_other_object(Differences& differences);
/// Where searches discard fragments: what the reference sees when rays are longer or shorter by a
/// part of what is permitted. Nothing else is compared there.
void take_other_fragment(Differences& differences);
/// In the range of what the specification permits, where that is known and looked at.
void take_legal(Differences& differences);
/// Of searches, for hits and towards the first light: behind loops that fragments of the quad have
/// left at different steps. Where hits decide over fragments also which of them is seen.
void take_divergent(Differences& differences);

}  // namespace quadrel::conformance
