// What err.* channels have run beside what is drawn: the same quads with the judge's frame, the
// judge's search, or both in the place of the material's own.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "quadrel/relief/trace/oracle/first_hit.hpp"
#include "render/plan/plan.hpp"

namespace quadrel {

/// The runs of a batch beside the drawn one.
enum class JudgedRun : std::int32_t {
    truth,   ///< exact frame, judge's search
    search,  ///< exact frame, the material's search
    frame,   ///< the material's frame, judge's search
};
inline constexpr int judged_runs = 3;

/// The run whose values an error of that part is measured in; none: what is drawn.
std::optional<JudgedRun> judged_run(ErrorPart part);

/// Who judges a material.
struct ErrorJudge {
    std::string frame;          ///< id of the exact frame: frame-face
    std::string trace;          ///< id of the judge's search
    oracle::Surface surface{};  ///< that it searches, of heights
    std::int32_t layers = 0;    ///< how many depth layers it searches in their place
};

/// What judges a material; none where there is neither a map of heights nor one of layers, or where
/// rays are no straight ones through a polygon.
std::optional<ErrorJudge> error_judge(const Scene& scene, const Material& material);

struct ErrorPlan {
    std::optional<ErrorJudge> judge;  ///< none: nothing is judged, and nothing runs
    bool shadows = false;             ///< light 0 has a shadow to be judged
    std::array<std::optional<MaterialPlan>, judged_runs> runs;  ///< those that channels need

    const std::optional<MaterialPlan>& run(JudgedRun which) const {
        return runs[static_cast<std::size_t>(which)];
    }
};

bool is_error(const ChannelSource& channel);

/// What of a drawn fragment the channel reads, whose part is the whole.
std::vector<Value> judged_values(ErrorMeasure measure);

/// For each of the scene's materials; empty where no channel asks. Throws InputError as planning
/// the material does.
std::vector<ErrorPlan> plan_errors(const Scene& scene, const std::vector<ChannelSource>& channels,
                                   const KernelTable& kernels);

/// Who judges what, for people and files: "materials.x: frame-face, oracle-bilinear", a line each.
std::string judges_text(const Scene& scene);

}  // namespace quadrel
