// Ranges of what the specification permits, quad by quad.
#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

#include "conformance/judge/differences.hpp"
#include "quadrel/error.hpp"

namespace quadrel::conformance {
namespace {

/// Whether the group's stages search, so that its ranges take long.
bool searches(GroupKind kind) {
    return kind == GroupKind::hit || kind == GroupKind::shadow || kind == GroupKind::occlusion;
}

/// The parts of the frame whose ranges are computed: of searches quads, and no more than so many;
/// of others all that differs.
std::vector<Window> windows(const Differences& differences) {
    const Comparison& sides = differences.sides;
    const GroupKind kind = differences.group.kind;
    if (kind == GroupKind::level) return {window_around(differences.pixels, sides.found.window)};
    std::set<std::pair<int, int>> quads;
    for (const std::size_t i : differences.pixels)
        quads.insert({sides.y_of(i) / 2, sides.x_of(i) / 2});
    const std::size_t most =
        searches(kind) ? std::max<std::size_t>(sides.options.most_ranged, 1) : quads.size();
    const std::size_t step = (quads.size() + most - 1) / most;
    std::vector<Window> chosen;
    std::size_t next = 0;
    for (const auto& [y, x] : quads)
        if (next++ % step == 0)
            chosen.push_back({2 * x, 2 * y, std::min(2 * x + 2, sides.scene.width),
                              std::min(2 * y + 2, sides.scene.height)});
    return chosen;
}

/// Between two ranges that the value may be in, where nothing is permitted.
bool is_in_gap(const Film& ranges, const std::string& name, std::size_t i, double value) {
    const Plane* const low = ranges.find("gpu.gap.lo." + name);
    const Plane* const high = ranges.find("gpu.gap.hi." + name);
    return low != nullptr && high != nullptr && value > low->as_float(i) &&
           value < high->as_float(i);
}

/// Whether each channel lies in its range; `open`: in one that is infinite. Integers have none:
/// they may be others where a decision is open.
bool is_legal(const Differences& differences, const Film& ranges, std::size_t i, bool& open) {
    const Comparison& sides = differences.sides;
    const std::size_t in_quad = sides.in(ranges, i);
    const Plane* const decisions = ranges.find("undecided");
    const bool undecided = decisions != nullptr && decisions->bits[in_quad] != 0;
    for (const std::string& name : differences.group.channels) {
        const Plane* const low = ranges.find("gpu.lo." + name);
        const Plane* const high = ranges.find("gpu.hi." + name);
        if (low == nullptr || high == nullptr) {
            if (!sides.equals(differences.own, name, i) && !undecided) return false;
            continue;
        }
        const double lo = low->as_float(in_quad), hi = high->as_float(in_quad);
        const double value = std::bit_cast<float>(sides.found_bits(name, i));
        if (std::isinf(lo) || std::isinf(hi) || std::isnan(lo) || std::isnan(hi))
            open = true;
        else if (!(lo <= value && value <= hi) || is_in_gap(ranges, name, in_quad, value))
            return false;
    }
    return true;
}

}  // namespace

void take_legal(Differences& differences) {
    const Comparison& sides = differences.sides;
    std::vector<std::string> channels;
    for (const std::string& name : differences.group.channels)
        if (has_range(name)) channels.push_back(name);
    if (channels.empty()) return;
    if (differences.group.kind == GroupKind::hit) channels.emplace_back("undecided");
    std::set<std::size_t> legal, open, looked_at;
    const auto look = [&](const Window& window, const Film& ranges) {
        for (const std::size_t i : differences.pixels) {
            const int x = sides.x_of(i), y = sides.y_of(i);
            if (!contains(window, {x, y, x + 1, y + 1})) continue;
            looked_at.insert(i);
            bool is_open = false;
            if (is_legal(differences, ranges, i, is_open)) (is_open ? open : legal).insert(i);
        }
    };
    try {
        sides.reruns.ranges(channels, sides.earlier, sides.given(differences.pixels),
                            sides.options.limits, windows(differences), look);
    } catch (const UsageError& error) {
        differences.report.note = error.what();
        return;
    }
    differences.take(Verdict::legal, [&](std::size_t i) { return legal.contains(i); });
    differences.take(Verdict::open, [&](std::size_t i) { return open.contains(i); });
    differences.take(Verdict::left, [&](std::size_t i) {
        return !looked_at.contains(i) && differences.left.insert(i).second;
    });
}

}  // namespace quadrel::conformance
