// Between results of permitted errors.
#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "conformance/judge/bracket.hpp"
#include "conformance/judge/differences.hpp"

namespace quadrel::conformance {
namespace {

double number(const Plane& plane, std::uint32_t bits) {
    return plane.type == ChannelType::uint32 ? static_cast<double>(bits)
                                             : static_cast<double>(std::bit_cast<float>(bits));
}

/// What each channel of each pixel has been so far.
class Results {
  public:
    explicit Results(Differences& differences) : of_(differences) {
        for (const std::size_t i : of_.pixels) brackets_[i].resize(of_.group.channels.size());
    }

    /// What a film has, in whose result `moved` is to be undone.
    void include(const Film& film, const Perturbation& moved = {}) {
        for (std::size_t c = 0; c < of_.group.channels.size(); ++c) {
            const Plane& plane = *film.find(of_.group.channels[c]);
            const double by =
                moved_along(plane.name, of_.group.kind, moved, of_.sides.options.texel);
            for (const std::size_t i : of_.pixels)
                brackets_[i][c].include(number(plane, plane.bits[of_.sides.in(film, i)]) - by);
        }
    }

    /// Where all values before are the reference's but for roundings, its own are as good.
    void include_reference() {
        for (std::size_t c = 0; c < of_.group.channels.size(); ++c) {
            const Plane& plane = *of_.sides.reference.find(of_.group.channels[c]);
            for (const std::size_t i : of_.pixels)
                if (!of_.sides.departed.contains(i))
                    brackets_[i][c].include(number(plane, plane.bits[i]));
        }
    }

    void take() {
        of_.take(Verdict::perturbed, [&](std::size_t i) { return has(i); });
    }

  private:
    bool has(std::size_t i) const {
        for (std::size_t c = 0; c < of_.group.channels.size(); ++c) {
            const Plane& plane = *of_.sides.found.find(of_.group.channels[c]);
            const double value = number(plane, plane.bits[i]);
            if (!brackets_.at(i)[c].contains(value, off(c, i, value))) return false;
        }
        return true;
    }

    /// By how much the ends may be off. What flips a test is off by all of an error or by a part
    /// of it, and so is a height that was looked up.
    double off(std::size_t channel, std::size_t i, double value) const {
        const double rounding = of_.roundings.of(channel, of_.sides.in(of_.own, i));
        const bool is_height = of_.group.channels[channel] == "hit.h";
        return is_height ? std::max(rounding, of_.sides.options.errors.texel * std::fabs(value))
                         : rounding;
    }

    Differences& of_;
    std::map<std::size_t, std::vector<Bracket>> brackets_;
};

}  // namespace

void take_perturbed(Differences& differences) {
    const Comparison& sides = differences.sides;
    const Group& group = differences.group;
    const JudgeOptions& options = sides.options;
    if (sides.earlier.empty()) return;
    Results results(differences);
    results.include(differences.own);
    results.include_reference();
    const Film image = sides.given(differences.pixels);
    for (const Perturbation& perturbation :
         perturbations_of(group.kind, options.errors, has_vertex_rays(sides.scene))) {
        const Film moved = perturbed(image, group.kind, perturbation, options.texel);
        // Implicit gradients are no values that move.
        const double levels = options.implicit_in_loops ? perturbation.level : 0;
        const Moved by{1 + perturbation.texel, levels, perturbation.eye};
        results.include(sides.made_of(group, moved, differences.pixels, by), perturbation);
        results.take();
        if (differences.empty()) return;
    }
}

}  // namespace quadrel::conformance
