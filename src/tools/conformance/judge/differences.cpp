#include "conformance/judge/differences.hpp"

#include <algorithm>
#include <cmath>

namespace quadrel::conformance {
namespace {

/// `at`: the pixel i of the frame in the film whose planes come first.
bool are_equal(const Differences::Pairs& pairs, std::size_t at, std::size_t i) {
    return std::ranges::all_of(
        pairs, [&](const auto& of) { return of.first->bits[at] == of.second->bits[i]; });
}

}  // namespace

Differences::Differences(Comparison& both, const Group& of)
    : sides(both), group(of), report{of.name, {}, {}, {}} {
    const Pairs pairs = pairs_with(sides.reference);
    for (std::size_t i = 0; i < sides.skipped.size(); ++i) {
        if (sides.skipped[i]) continue;
        if (are_equal(pairs, i, i))
            count(Verdict::same);
        else
            pixels.push_back(i);
    }
}

void Differences::draw_own() {
    own =
        sides.earlier.empty() ? sides.reference : sides.made_of(group, sides.given(pixels), pixels);
    roundings = Roundings(own, group.channels, sides.options.errors);
}

Differences::Pairs Differences::pairs_with(const Film& film) const {
    Pairs pairs;
    for (const std::string& name : group.channels)
        pairs.emplace_back(film.find(name), sides.found.find(name));
    return pairs;
}

bool Differences::is_rounded(const Pairs::value_type& pair, std::size_t channel,
                             std::size_t i) const {
    const auto& [made, found] = pair;
    const std::size_t at = sides.in(own, i);
    if (made->bits[at] == found->bits[i]) return true;
    const double off =
        static_cast<double>(found->as_float(i)) - static_cast<double>(made->as_float(at));
    return std::fabs(off) <= roundings.of(channel, at);
}

const std::string& Differences::worst_channel(std::size_t i) const {
    const std::string* differing = &group.channels.front();
    for (auto name = group.channels.rbegin(); name != group.channels.rend(); ++name)
        if (!sides.equals(sides.reference, *name, i)) differing = &*name;
    if (group.kind == GroupKind::coverage) return *differing;
    const Pairs pairs = pairs_with(own);
    for (std::size_t c = 0; c < pairs.size(); ++c)
        if (!is_rounded(pairs[c], c, i)) return group.channels[c];
    return *differing;
}

void take_inherited(Differences& differences) {
    const Differences::Pairs pairs = differences.pairs_with(differences.own);
    differences.take(Verdict::inherited, [&](std::size_t i) {
        return are_equal(pairs, differences.sides.in(differences.own, i), i);
    });
}

void take_rounded(Differences& differences) {
    const Differences::Pairs pairs = differences.pairs_with(differences.own);
    differences.take(Verdict::rounded, [&](std::size_t i) {
        for (std::size_t c = 0; c < pairs.size(); ++c)
            if (!differences.is_rounded(pairs[c], c, i)) return false;
        return true;
    });
}

}  // namespace quadrel::conformance
