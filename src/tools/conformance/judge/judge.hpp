// An implementation's film of a scene beside Quadrel's own, channel by channel in the order of the
// data flow: whatever differs is explained, or it is not.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "conformance/judge/perturbations.hpp"
#include "conformance/judge/verdicts.hpp"
#include "quadrel/scene/scene.hpp"

namespace quadrel::conformance {

/// The scene drawn once more by shaders that say the same in other words.
struct Redraw {
    Verdict verdict;  ///< of pixels that are explained then, and only then
    std::function<Film()> draw;
};

struct JudgeOptions {
    std::string limits = "gl";  ///< as RenderOptions::limits
    PermittedErrors errors;
    TexelSize texel;                 ///< of the height map
    std::size_t most_ranged = 200;   ///< quads of a group of searches whose ranges are computed,
                                     ///< which take long; others are `left`
    std::size_t examples = 3;        ///< unexplained pixels that are named
    int threads = 0;                 ///< of renders, as RenderOptions has them
    bool implicit_in_loops = false;  ///< whether loops of the shaders have implicit derivatives
    std::vector<Redraw> redraws;     ///< asked in turn, where something is left unexplained
};

/// Judges `found`, a film of the scene's frame. A group's stages are given the implementation's own
/// values of all groups before it, so that each is judged for itself; at a pixel, a group's verdict
/// is that of its worst channel.
std::vector<GroupReport> judge(const Scene& scene, const Film& found, const JudgeOptions& options);

}  // namespace quadrel::conformance
