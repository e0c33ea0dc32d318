#include "conformance/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "conformance/bracket.hpp"
#include "conformance/edges.hpp"
#include "conformance/reruns.hpp"
#include "conformance/rounding.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/channels.hpp"
#include "quadrel/render.hpp"
#include "render/probe/command.hpp"
#include "render/registry/added_stages.hpp"

namespace quadrel::conformance {
namespace {

/// One group at a time, with the pixels that are still to be explained.
class Judge {
  public:
    Judge(const Scene& scene, const Film& found, const JudgeOptions& options)
        : scene_(scene),
          options_(options),
          found_(found),
          reruns_(scene, options.threads),
          command_(scene, select_kernels(RenderOptions()), "auto") {
        std::vector<std::string> names;
        for (const Plane& plane : found.planes)
            if (find_channel(plane.name) != nullptr) names.push_back(plane.name);
        reference_ = reruns_.reference(names);
        groups_ = groups_of(scene, reference_, found);
        skipped_.resize(found.window.area(), false);
    }

    std::vector<GroupReport> run() {
        std::vector<GroupReport> reports;
        for (const Group& group : groups_) {
            reports.push_back(judge(group));
            const std::vector<std::string> more = injectable(group.channels);
            earlier_.insert(earlier_.end(), more.begin(), more.end());
        }
        return reports;
    }

    /// Pixels of a group that nothing explains, or that were not looked at.
    std::set<std::size_t> not_explained(const std::string& group) const {
        const auto found = not_explained_.find(group);
        return found != not_explained_.end() ? found->second : std::set<std::size_t>();
    }

  private:
    std::uint32_t found_bits(const std::string& channel, std::size_t i) const {
        return found_.find(channel)->bits[i];
    }
    /// Where a pixel of the frame lies in a film of a part of it.
    std::size_t in(const Film& film, std::size_t i) const { return film.index(x_of(i), y_of(i)); }
    bool equals(const Film& film, const std::string& channel, std::size_t i) const {
        return film.find(channel)->bits[in(film, i)] == found_bits(channel, i);
    }
    /// Planes of a group: those of a film, and the implementation's.
    using Pairs = std::vector<std::pair<const Plane*, const Plane*>>;
    Pairs pairs_with(const Film& film, const Group& group) const {
        Pairs pairs;
        for (const std::string& name : group.channels)
            pairs.emplace_back(film.find(name), found_.find(name));
        return pairs;
    }
    /// `at`: the pixel i of the frame in that film.
    static bool are_equal(const Pairs& pairs, std::size_t at, std::size_t i) {
        return std::ranges::all_of(
            pairs, [&](const auto& of) { return of.first->bits[at] == of.second->bits[i]; });
    }
    bool equals(const Film& film, const Group& group, std::size_t i) const {
        return std::ranges::all_of(group.channels,
                                   [&](const std::string& name) { return equals(film, name, i); });
    }

    /// The implementation's values of the groups before, around these pixels.
    Film given(const std::vector<std::size_t>& pixels) const {
        return part_of(found_, earlier_, window_around(pixels, found_.window));
    }

    /// What the group's stages make of an image of the values before, at these pixels.
    Film made_of(const Group& group, const Film& image, const std::vector<std::size_t>& pixels,
                 double heights = 1) const {
        return reruns_.made_of(group.channels, earlier_, image,
                               squares_around(pixels, found_.window, image.window), heights);
    }

    GroupReport judge(const Group& group) {
        GroupReport report{group.name, {}, {}, {}};
        std::vector<std::size_t> pixels;
        const Pairs sides = pairs_with(reference_, group);
        for (std::size_t i = 0; i < skipped_.size(); ++i) {
            if (skipped_[i]) continue;
            if (are_equal(sides, i, i))
                count(report, Verdict::same);
            else
                pixels.push_back(i);
        }
        if (group.kind == GroupKind::coverage) {
            judge_coverage(group, pixels, report);
            return report;
        }
        if (!pixels.empty()) {
            own_ = earlier_.empty() ? reference_ : made_of(group, given(pixels), pixels);
            roundings_ = Roundings(own_, group.channels, options_.errors);
        }
        std::set<std::size_t> departed(pixels.begin(), pixels.end());
        if (!pixels.empty()) take_inherited(group, pixels, report);
        for (const std::size_t i : pixels) departed.erase(i);
        if (!pixels.empty()) take_rounded(group, pixels, report);
        departed.insert(pixels.begin(), pixels.end());
        if (!pixels.empty() && group.kind > GroupKind::hit) take_undefined(pixels, report);
        if (!pixels.empty()) take_perturbed(group, pixels, report);
        if (!pixels.empty() && group.kind == GroupKind::geometry)
            take_other_object(group, pixels, report);
        if (!pixels.empty()) take_legal(group, pixels, report);
        if (!pixels.empty() && options_.implicit_in_loops) take_divergent(group, pixels, report);
        if (!pixels.empty()) take_redrawn(group, pixels, report);
        give_up(group, pixels, report);
        if (group.kind != GroupKind::level) departed_.insert(departed.begin(), departed.end());
        return report;
    }

    static void count(GroupReport& report, Verdict verdict) {
        ++report.counts[static_cast<std::size_t>(verdict)];
    }

    /// Takes out of `pixels` those of which `explained` says so, and counts them.
    template <class Explained>
    static void take(std::vector<std::size_t>& pixels, GroupReport& report, Verdict verdict,
                     const Explained& explained) {
        std::erase_if(pixels, [&](std::size_t i) {
            const bool taken = explained(i);
            if (taken) count(report, verdict);
            return taken;
        });
    }

    /// Where one side has a fragment and the other none, nothing else is compared.
    void judge_coverage(const Group& group, std::vector<std::size_t>& pixels, GroupReport& report) {
        for (const std::size_t i : pixels) skipped_[i] = true;
        if (!pixels.empty()) {
            const std::set<std::size_t> edges = pixels_beside_edges(scene_, options_.limits);
            take(pixels, report, Verdict::coverage,
                 [&](std::size_t i) { return edges.contains(i); });
        }
        give_up(group, pixels, report);
    }

    void take_inherited(const Group& group, std::vector<std::size_t>& pixels,
                        GroupReport& report) const {
        const Pairs sides = pairs_with(own_, group);
        take(pixels, report, Verdict::inherited,
             [&](std::size_t i) { return are_equal(sides, in(own_, i), i); });
    }

    void take_rounded(const Group& group, std::vector<std::size_t>& pixels,
                      GroupReport& report) const {
        const Pairs sides = pairs_with(own_, group);
        take(pixels, report, Verdict::rounded, [&](std::size_t i) {
            for (std::size_t c = 0; c < sides.size(); ++c)
                if (!is_rounded(sides[c], c, i)) return false;
            return true;
        });
    }

    /// Whether the implementation's value of a channel of the group is what is made of its own
    /// earlier values, but for roundings.
    bool is_rounded(const Pairs::value_type& sides, std::size_t channel, std::size_t i) const {
        const auto& [own, found] = sides;
        const std::size_t at = in(own_, i);
        if (own->bits[at] == found->bits[i]) return true;
        const double off =
            static_cast<double>(found->as_float(i)) - static_cast<double>(own->as_float(at));
        return std::fabs(off) <= roundings_.of(channel, at);
    }

    /// Behind hits at NaN: no specification says what look-ups there give.
    void take_undefined(std::vector<std::size_t>& pixels, GroupReport& report) const {
        if (found_.find("hit.flags") == nullptr) return;
        take(pixels, report, Verdict::open, [&](std::size_t i) {
            return (found_bits("hit.flags", i) & HitFlag::nan_look_up) != 0;
        });
    }

    /// Of searches, for hits and towards the first light.
    void take_divergent(const Group& group, std::vector<std::size_t>& pixels,
                        GroupReport& report) const {
        const std::string steps = group.kind == GroupKind::hit ? "hit.steps" : "shadow.steps";
        if ((group.kind != GroupKind::hit && group.kind != GroupKind::shadow) ||
            found_.find(steps) == nullptr)
            return;
        take(pixels, report, Verdict::divergent, [&](std::size_t i) {
            const int x = x_of(i) / 2 * 2, y = y_of(i) / 2 * 2;
            for (const int dy : {0, 1})
                for (const int dx : {0, 1}) {
                    if (x + dx >= scene_.width || y + dy >= scene_.height) continue;
                    const std::size_t other = found_.index(x + dx, y + dy);
                    if (found_bits(steps, other) != found_bits(steps, i) ||
                        reference_.find(steps)->bits[other] != reference_.find(steps)->bits[i])
                        return true;
                }
            return false;
        });
    }

    void take_perturbed(const Group& group, std::vector<std::size_t>& pixels,
                        GroupReport& report) const {
        const auto perturbations = perturbations_of(group.kind, options_.errors);
        if (perturbations.empty() || earlier_.empty()) return;
        std::map<std::size_t, std::vector<Bracket>> brackets;
        for (const std::size_t i : pixels) brackets[i].resize(group.channels.size());
        const auto include = [&](const Film& film, const Perturbation& perturbation) {
            for (std::size_t c = 0; c < group.channels.size(); ++c) {
                const Plane& plane = *film.find(group.channels[c]);
                const double moved =
                    moved_along(plane.name, group.kind, perturbation, options_.texel);
                for (const std::size_t i : pixels)
                    brackets[i][c].include(number(plane, plane.bits[in(film, i)]) - moved);
            }
        };
        include(own_, {});
        // Where all values before are the reference's but for roundings, these are as good.
        for (std::size_t c = 0; c < group.channels.size(); ++c) {
            const Plane& plane = *reference_.find(group.channels[c]);
            for (const std::size_t i : pixels)
                if (!departed_.contains(i)) brackets[i][c].include(number(plane, plane.bits[i]));
        }
        const Film image = given(pixels);
        for (const Perturbation& perturbation : perturbations) {
            include(made_of(group, perturbed(image, group.kind, perturbation, options_.texel),
                            pixels, 1 + perturbation.texel),
                    perturbation);
            take(pixels, report, Verdict::perturbed,
                 [&](std::size_t i) { return is_within(group, brackets[i], i); });
            if (pixels.empty()) return;
        }
    }

    bool is_within(const Group& group, const std::vector<Bracket>& brackets, std::size_t i) const {
        for (std::size_t c = 0; c < group.channels.size(); ++c) {
            const Plane& plane = *found_.find(group.channels[c]);
            if (!brackets[c].contains(number(plane, plane.bits[i]), roundings_.of(c, in(own_, i))))
                return false;
        }
        return true;
    }

    static double number(const Plane& plane, std::uint32_t bits) {
        return plane.type == ChannelType::uint32 ? static_cast<double>(bits)
                                                 : static_cast<double>(std::bit_cast<float>(bits));
    }

    /// The parts of the frame whose ranges are computed: quads, since most take long, and no more
    /// than so many; all that differs of levels and derivatives, which take next to nothing.
    std::vector<Window> windows(const Group& group, const std::vector<std::size_t>& pixels) const {
        if (group.kind == GroupKind::level) return {window_around(pixels, found_.window)};
        std::set<std::pair<int, int>> quads;
        for (const std::size_t i : pixels) quads.insert({y_of(i) / 2, x_of(i) / 2});
        const std::size_t most = group.kind == GroupKind::derivatives
                                     ? quads.size()
                                     : std::max<std::size_t>(options_.most_ranged, 1);
        const std::size_t step = (quads.size() + most - 1) / most;
        std::vector<Window> chosen;
        std::size_t next = 0;
        for (const auto& [y, x] : quads)
            if (next++ % step == 0)
                chosen.push_back({2 * x, 2 * y, std::min(2 * x + 2, scene_.width),
                                  std::min(2 * y + 2, scene_.height)});
        return chosen;
    }

    void take_legal(const Group& group, std::vector<std::size_t>& pixels, GroupReport& report) {
        std::vector<std::string> channels;
        for (const std::string& name : group.channels)
            if (has_range(name)) channels.push_back(name);
        if (channels.empty()) return;
        if (group.kind == GroupKind::hit) channels.emplace_back("undecided");
        std::set<std::size_t> legal, open, looked_at;
        const auto look = [&](const Window& window, const Film& ranges) {
            for (const std::size_t i : pixels) {
                const int x = x_of(i), y = y_of(i);
                if (!contains(window, {x, y, x + 1, y + 1})) continue;
                looked_at.insert(i);
                bool is_open = false;
                if (is_legal(group, ranges, i, is_open)) (is_open ? open : legal).insert(i);
            }
        };
        try {
            reruns_.ranges(channels, earlier_, given(pixels), options_.limits,
                           windows(group, pixels), look);
        } catch (const UsageError& error) {
            report.note = error.what();
            return;
        }
        take(pixels, report, Verdict::legal, [&](std::size_t i) { return legal.contains(i); });
        take(pixels, report, Verdict::open, [&](std::size_t i) { return open.contains(i); });
        std::set<std::size_t>& left = not_explained_[group.name];
        take(pixels, report, Verdict::left,
             [&](std::size_t i) { return !looked_at.contains(i) && left.insert(i).second; });
    }

    /// Where two objects have the same depth but for roundings, either may be seen.
    void take_other_object(const Group& group, std::vector<std::size_t>& pixels,
                           GroupReport& report) {
        if (scene_.objects.size() < 2) return;
        std::vector<std::string> channels = group.channels;
        channels.insert(channels.end(), {"A", "depth"});
        const Film seen = reruns_.reference({"depth"});
        std::set<std::size_t> others;
        for (std::size_t object = 0; object < scene_.objects.size(); ++object) {
            Scene alone = scene_;
            for (std::size_t of = 0; of < alone.objects.size(); ++of)
                alone.objects[of].visible &= of == object;
            const Film film = Reruns(alone, options_.threads).reference(channels);
            for (const std::size_t i : pixels) {
                const double depth = film.find("depth")->as_float(i),
                             nearest = seen.find("depth")->as_float(i);
                if (film.find("A")->as_float(i) > 0 && equals(film, group, i) &&
                    std::fabs(depth - nearest) <= options_.errors.depth * std::fabs(nearest))
                    others.insert(i);
            }
        }
        for (const std::size_t i : others) skipped_[i] = true;
        take(pixels, report, Verdict::coverage, [&](std::size_t i) { return others.contains(i); });
    }

    /// Where it is only the words of the shader that make the difference.
    void take_redrawn(const Group& group, std::vector<std::size_t>& pixels, GroupReport& report) {
        for (std::size_t n = 0; n < options_.redraws.size() && !pixels.empty(); ++n) {
            const Redrawn& other = redrawn(n);
            const std::set<std::size_t> left = other.judge->not_explained(group.name);
            take(pixels, report, options_.redraws[n].verdict,
                 [&](std::size_t i) { return !left.contains(i) && !equals(other.film, group, i); });
        }
    }

    struct Redrawn {
        Film film;
        std::unique_ptr<Judge> judge;
    };

    const Redrawn& redrawn(std::size_t number) {
        if (redrawn_.size() <= number) {
            JudgeOptions options = options_;
            options.redraws.clear();
            // Films keep their place: judges refer to them.
            auto other = std::make_unique<Redrawn>();
            other->film = options_.redraws[number].draw();
            other->judge = std::make_unique<Judge>(scene_, other->film, options);
            other->judge->run();
            redrawn_.push_back(std::move(other));
        }
        return *redrawn_[number];
    }

    int x_of(std::size_t i) const { return static_cast<int>(i) % found_.window.width(); }
    int y_of(std::size_t i) const { return static_cast<int>(i) / found_.window.width(); }

    /// Whether each channel lies in its range. Integers have none: they may be others where a
    /// decision is open.
    bool is_legal(const Group& group, const Film& ranges, std::size_t i, bool& open) const {
        const std::size_t in_quad = in(ranges, i);
        const Plane* const decisions = ranges.find("undecided");
        const bool undecided = decisions != nullptr && decisions->bits[in_quad] != 0;
        for (const std::string& name : group.channels) {
            const Plane* const low = ranges.find("gpu.lo." + name);
            const Plane* const high = ranges.find("gpu.hi." + name);
            if (low == nullptr || high == nullptr) {
                if (!equals(own_, name, i) && !undecided) return false;
                continue;
            }
            const double lo = low->as_float(in_quad), hi = high->as_float(in_quad);
            const double value = std::bit_cast<float>(found_bits(name, i));
            if (std::isinf(lo) || std::isinf(hi) || std::isnan(lo) || std::isnan(hi))
                open = true;
            else if (!(lo <= value && value <= hi) || is_in_gap(ranges, name, in_quad, value))
                return false;
        }
        return true;
    }

    /// Between two ranges that the value may be in, where nothing is permitted.
    static bool is_in_gap(const Film& ranges, const std::string& name, std::size_t i,
                          double value) {
        const Plane* const low = ranges.find("gpu.gap.lo." + name);
        const Plane* const high = ranges.find("gpu.gap.hi." + name);
        return low != nullptr && high != nullptr && value > low->as_float(i) &&
               value < high->as_float(i);
    }

    void give_up(const Group& group, const std::vector<std::size_t>& pixels, GroupReport& report) {
        not_explained_[group.name].insert(pixels.begin(), pixels.end());
        for (const std::size_t i : pixels) {
            count(report, Verdict::unexplained);
            if (report.examples.size() >= options_.examples) continue;
            const std::string& name = worst_channel(group, i);
            report.examples.push_back({name, x_of(i), y_of(i), reference_.find(name)->bits[i],
                                       found_bits(name, i), command_.text(x_of(i), y_of(i))});
        }
    }

    /// The first channel that is off by more than roundings, or that differs at all.
    const std::string& worst_channel(const Group& group, std::size_t i) const {
        const std::string* differing = &group.channels.front();
        for (auto name = group.channels.rbegin(); name != group.channels.rend(); ++name)
            if (!equals(reference_, *name, i)) differing = &*name;
        if (group.kind == GroupKind::coverage) return *differing;
        const Pairs sides = pairs_with(own_, group);
        for (std::size_t c = 0; c < sides.size(); ++c)
            if (!is_rounded(sides[c], c, i)) return group.channels[c];
        return *differing;
    }

    const Scene& scene_;
    const JudgeOptions options_;
    const Film& found_;
    Reruns reruns_;
    ProbeCommand command_;
    Film reference_;
    Film own_;             ///< of the group that is judged, around the pixels that differ: from the
                           ///< implementation's earlier values
    Roundings roundings_;  ///< of that film
    std::vector<Group> groups_;
    std::vector<std::string> earlier_;  ///< channels of the groups before
    std::vector<bool> skipped_;         ///< pixels that one side alone covers
    std::map<std::string, std::set<std::size_t>> not_explained_;  ///< by group
    std::set<std::size_t> departed_;  ///< pixels with a value that is more than roundings away
    std::vector<std::unique_ptr<Redrawn>> redrawn_;  ///< those that were asked for
};

}  // namespace

std::vector<GroupReport> judge(const Scene& scene, const Film& found, const JudgeOptions& options) {
    return Judge(scene, found, options).run();
}

}  // namespace quadrel::conformance
