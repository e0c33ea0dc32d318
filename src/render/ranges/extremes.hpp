// What conforming implementations may really differ by: a search for permitted errors that move
// values as far as they can. What it finds is a lower bound of every right range.
#pragma once

#include <array>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "render/plan/prepared.hpp"
#include "render/ranges/permitted_batch.hpp"

namespace quadrel {

/// How hard to search: batches of 64 implementations a level of detail, of how many levels, and
/// then batches between what was found.
struct SearchEffort {
    int levels = 5, batches_a_level = 40, batches_between = 33;
};

/// What implementations have in a pixel.
struct FoundPixel {
    int x = 0, y = 0;                        ///< image coordinates
    std::vector<std::vector<float>> values;  ///< [channel][implementation]
};

/// How far values lie apart.
struct FoundSpread {
    double width = 0;  ///< from the least to the greatest
    /// The same less the widest gap between neighbours: as much as any right range is wide,
    /// whatever gap it has.
    double width_less_gap = 0;
};
/// Of values in any order, which are sorted. Those that are no numbers do not count.
FoundSpread spread_of(std::vector<float>& values);

class Extremes {
  public:
    /// `channels` are float values of stages. `limits`: as RenderOptions has them. The scene must
    /// outlive it. Throws as `render` does.
    Extremes(const Scene& scene, const std::vector<std::string>& channels,
             const std::string& limits, const SearchEffort& effort = {});

    /// The covered pixels of a window, a quad each: every value of every implementation that was
    /// tried, the same ones each time.
    std::vector<FoundPixel> search(const Window& window);

  private:
    struct Candidate {
        PermittedErrors errors;
        double level = 0;
        float value = 0;
        bool found = false;
    };
    /// The least and the greatest value of a channel in a lane, and whose they are.
    struct Ends {
        Candidate least, greatest;
    };

    void search_quad(const QuadCoverage& quad);
    void run(const QuadCoverage& quad, const SharedChoices& shared);
    void search_level(const QuadCoverage& quad, double level);
    void search_between(const QuadCoverage& quad);
    void keep(double level);
    const Candidate* any_end();
    double random();  ///< [0, 1)
    PermittedErrors corner();
    PermittedErrors mutated(const PermittedErrors& of);
    SharedChoices choices(double level);

    SearchEffort effort_;
    PreparedRender prepared_;
    std::size_t channel_count_;
    std::unique_ptr<PermittedBatch> batch_;
    std::mt19937_64 random_;
    std::array<PermittedErrors, batch_quads> implementations_;
    std::vector<std::array<Ends, 4>> ends_;  ///< [channel][lane]: of this level
    std::vector<std::array<Ends, 4>> all_;   ///< of all levels
    std::array<FoundPixel, 4> pixels_;       ///< of the quad's lanes
};

}  // namespace quadrel
