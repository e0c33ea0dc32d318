// What no specification says anything of.
#include "conformance/judge/differences.hpp"

namespace quadrel::conformance {

void take_undefined(Differences& differences) {
    const Plane* const flags = differences.sides.found.find("hit.flags");
    if (flags == nullptr) return;
    differences.take(Verdict::open,
                     [&](std::size_t i) { return (flags->bits[i] & HitFlag::nan_look_up) != 0; });
}

void take_divergent(Differences& differences) {
    Comparison& sides = differences.sides;
    const GroupKind kind = differences.group.kind;
    // Which fragment is seen follows from hits where searches discard some.
    const bool is_of_fragments = kind <= GroupKind::derivatives && discards(sides.scene);
    const std::string steps = kind == GroupKind::shadow ? "shadow.steps" : "hit.steps";
    if ((!is_of_fragments && kind != GroupKind::hit && kind != GroupKind::shadow) ||
        sides.found.find(steps) == nullptr)
        return;
    const Plane &found = *sides.found.find(steps), &reference = *sides.reference.find(steps);
    const auto is_divergent = [&](std::size_t i) {
        const int x = sides.x_of(i) / 2 * 2, y = sides.y_of(i) / 2 * 2;
        for (const int dy : {0, 1})
            for (const int dx : {0, 1}) {
                if (x + dx >= sides.scene.width || y + dy >= sides.scene.height) continue;
                const std::size_t other = sides.found.index(x + dx, y + dy);
                if (found.bits[other] != found.bits[i] ||
                    reference.bits[other] != reference.bits[i])
                    return true;
            }
        return false;
    };
    differences.take(Verdict::divergent, [&](std::size_t i) {
        const bool is_taken = is_divergent(i);
        if (is_taken && is_of_fragments) sides.skipped[i] = true;
        return is_taken;
    });
}

}  // namespace quadrel::conformance
