#include "conformance/judge/judge.hpp"

#include <map>
#include <memory>
#include <set>

#include "conformance/judge/differences.hpp"
#include "quadrel/render.hpp"
#include "render/probe/command.hpp"
#include "render/registry/added_stages.hpp"

namespace quadrel::conformance {
namespace {

/// One group after the other, in the order of the data flow.
class Judge {
  public:
    Judge(const Scene& scene, const Film& found, const JudgeOptions& options)
        : sides_(scene, found, options), command_(scene, select_kernels(RenderOptions()), "auto") {}

    std::vector<GroupReport> run() {
        std::vector<GroupReport> reports;
        for (const Group& group : groups_of(sides_.scene, sides_.reference, sides_.found)) {
            reports.push_back(judge(group));
            const std::vector<std::string> more = injectable(group.channels);
            sides_.earlier.insert(sides_.earlier.end(), more.begin(), more.end());
        }
        return reports;
    }

    /// Pixels of a group that nothing explains, or that were not looked at.
    std::set<std::size_t> not_explained(const std::string& group) const {
        const auto found = not_explained_.find(group);
        return found != not_explained_.end() ? found->second : std::set<std::size_t>();
    }

  private:
    GroupReport judge(const Group& group) {
        Differences differences(sides_, group);
        if (group.kind == GroupKind::coverage)
            take_coverage(differences);
        else if (!differences.empty())
            explain(differences);
        if (!differences.empty()) take_redrawn(differences);
        if (!differences.empty() && group.kind <= GroupKind::derivatives)
            explain_fragments(differences);
        give_up(differences);
        return differences.report;
    }

    void explain(Differences& differences) {
        const GroupKind kind = differences.group.kind;
        std::set<std::size_t> departed(differences.pixels.begin(), differences.pixels.end());
        differences.draw_own();
        take_inherited(differences);
        for (const std::size_t i : differences.pixels) departed.erase(i);
        take_rounded(differences);
        departed.insert(differences.pixels.begin(), differences.pixels.end());
        explain_departed(differences);
        if (kind != GroupKind::level) sides_.departed.insert(departed.begin(), departed.end());
    }

    /// What is off by more than roundings.
    void explain_departed(Differences& differences) {
        const GroupKind kind = differences.group.kind;
        if (!differences.empty() && kind > GroupKind::hit) take_undefined(differences);
        if (!differences.empty()) take_perturbed(differences);
        if (!differences.empty() && kind == GroupKind::geometry) take_other_object(differences);
        if (!differences.empty()) take_legal(differences);
        if (!differences.empty() && kind >= GroupKind::hit) take_loops(differences);
    }

    /// Why another fragment is seen.
    void explain_fragments(Differences& differences) {
        take_other_fragment(differences);
        if (!differences.empty()) take_loops(differences);
    }

    void take_loops(Differences& differences) {
        if (sides_.options.implicit_in_loops) take_divergent(differences);
    }

    /// Where it is only the words of the shader that make the difference.
    void take_redrawn(Differences& differences) {
        const std::vector<Redraw>& redraws = sides_.options.redraws;
        for (std::size_t n = 0; n < redraws.size() && !differences.empty(); ++n) {
            const Redrawn& other = redrawn(n);
            const std::set<std::size_t> left = other.judge->not_explained(differences.group.name);
            differences.take(redraws[n].verdict, [&](std::size_t i) {
                return !left.contains(i) && !sides_.equals(other.film, differences.group, i);
            });
        }
    }

    struct Redrawn {
        Film film;
        std::unique_ptr<Judge> judge;
    };

    const Redrawn& redrawn(std::size_t number) {
        if (redrawn_.size() <= number) {
            JudgeOptions options = sides_.options;
            options.redraws.clear();
            // Films keep their place: judges refer to them.
            auto other = std::make_unique<Redrawn>();
            other->film = sides_.options.redraws[number].draw();
            other->judge = std::make_unique<Judge>(sides_.scene, other->film, options);
            other->judge->run();
            redrawn_.push_back(std::move(other));
        }
        return *redrawn_[number];
    }

    void give_up(Differences& differences) {
        std::set<std::size_t>& left = not_explained_[differences.group.name];
        left = differences.left;
        left.insert(differences.pixels.begin(), differences.pixels.end());
        for (const std::size_t i : differences.pixels) {
            differences.count(Verdict::unexplained);
            if (differences.report.examples.size() >= sides_.options.examples) continue;
            const int x = sides_.x_of(i), y = sides_.y_of(i);
            const std::string& name = differences.worst_channel(i);
            differences.report.examples.push_back({name, x, y, sides_.reference.find(name)->bits[i],
                                                   sides_.found_bits(name, i),
                                                   command_.text(x, y)});
        }
    }

    Comparison sides_;
    ProbeCommand command_;
    std::map<std::string, std::set<std::size_t>> not_explained_;  ///< by group
    std::vector<std::unique_ptr<Redrawn>> redrawn_;               ///< those that were asked for
};

}  // namespace

std::vector<GroupReport> judge(const Scene& scene, const Film& found, const JudgeOptions& options) {
    return Judge(scene, found, options).run();
}

}  // namespace quadrel::conformance
