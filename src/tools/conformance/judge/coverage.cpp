// Which fragment is seen, if any.
#include <algorithm>
#include <cmath>
#include <set>

#include "conformance/judge/differences.hpp"
#include "conformance/judge/edges.hpp"
#include "render/plan/plan.hpp"

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

bool discards(const Scene& scene) {
    return std::ranges::any_of(scene.materials, [](const Material& of) { return clips(of); });
}

namespace {

/// Rays are as much longer as reliefs are deeper.
Scene with_deeper_reliefs(Scene scene, double part) {
    for (Material& material : scene.materials)
        material.depth = static_cast<float>(static_cast<double>(material.depth) * (1 + part));
    return scene;
}

/// Whether the implementation has what the film has, but for roundings.
bool has_the_same(const Differences& differences, const Film& film, const Roundings& roundings,
                  std::size_t i) {
    const Differences::Pairs pairs = differences.pairs_with(film);
    for (std::size_t c = 0; c < pairs.size(); ++c) {
        const auto& [made, found] = pairs[c];
        const std::size_t at = differences.sides.in(film, i);
        const double off =
            static_cast<double>(found->as_float(i)) - static_cast<double>(made->as_float(at));
        if (made->bits[at] != found->bits[i] && !(std::fabs(off) <= roundings.of(c, at)))
            return false;
    }
    return true;
}

}  // namespace

void take_other_fragment(Differences& differences) {
    Comparison& sides = differences.sides;
    if (!discards(sides.scene)) return;
    for (const double part : permitted_parts)
        for (const double by : {-part, part}) {
            if (differences.empty()) return;
            const Scene other = with_deeper_reliefs(sides.scene, by * sides.options.errors.ray);
            const Film film = Reruns(other, sides.options.threads)
                                  .made_of(differences.group.channels, {}, sides.found,
                                           squares_around(differences.pixels, sides.found.window,
                                                          sides.found.window));
            const Roundings roundings(film, differences.group.channels, sides.options.errors);
            differences.take(Verdict::perturbed, [&](std::size_t i) {
                const bool is_seen = has_the_same(differences, film, roundings, i);
                if (is_seen) sides.skipped[i] = true;
                return is_seen;
            });
        }
}

}  // namespace quadrel::conformance
