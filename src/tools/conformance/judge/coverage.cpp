// Which fragment is seen, if any.
#include <cmath>
#include <set>

#include "conformance/judge/differences.hpp"
#include "conformance/judge/edges.hpp"

namespace quadrel::conformance {

void take_coverage(Differences& differences) {
    if (differences.empty()) return;
    Comparison& sides = differences.sides;
    for (const std::size_t i : differences.pixels) sides.skipped[i] = true;
    const std::set<std::size_t> edges = pixels_beside_edges(sides.scene, sides.options.limits);
    differences.take(Verdict::coverage, [&](std::size_t i) { return edges.contains(i); });
}

void take_other_object(Differences& differences) {
    Comparison& sides = differences.sides;
    if (sides.scene.objects.size() < 2) return;
    std::vector<std::string> channels = differences.group.channels;
    channels.insert(channels.end(), {"A", "depth"});
    const Film seen = sides.reruns.reference({"depth"});
    std::set<std::size_t> others;
    for (std::size_t object = 0; object < sides.scene.objects.size(); ++object) {
        Scene alone = sides.scene;
        for (std::size_t of = 0; of < alone.objects.size(); ++of)
            alone.objects[of].visible &= of == object;
        const Film film = Reruns(alone, sides.options.threads).reference(channels);
        for (const std::size_t i : differences.pixels) {
            const double depth = film.find("depth")->as_float(i),
                         nearest = seen.find("depth")->as_float(i);
            if (film.find("A")->as_float(i) > 0 && sides.equals(film, differences.group, i) &&
                std::fabs(depth - nearest) <= sides.options.errors.depth * std::fabs(nearest))
                others.insert(i);
        }
    }
    for (const std::size_t i : others) sides.skipped[i] = true;
    differences.take(Verdict::coverage, [&](std::size_t i) { return others.contains(i); });
}

}  // namespace quadrel::conformance
