// A scene as one HTML page that draws it on the visitor's own GPU and judges what that gives.
#pragma once

#include <string>
#include <vector>

#include "export/scene/export_scene.hpp"

namespace quadrel {

struct ExportContent;

struct JudgePage {
    /// Language and reference are the page's own. Channels: none: judged_channels.
    SceneExport scene;
    /// As RenderOptions has it: what ranges are embedded; empty: none.
    std::string limits = "gl";
    int every = 1;  ///< every so-manyth row of quads has ranges, the others are not judged
};

/// What a page judges unless channels are asked for: of each step of the data flow what it gives,
/// so that the first that is wrong is seen, and no more, so that pages stay small.
std::vector<std::string> judged_channels(const Scene& scene);

/// The page. Channels whose stages do not run on ranges have none, and the page says why. Throws as
/// export_scene does, and UsageError for several samples per pixel and for limits that are none.
std::string judge_page(const Scene& scene, const JudgePage& options);

/// The last step: of what is gathered, in `page_language`; `reference` has the expected channels
/// and, behind them, gpu.lo.X, gpu.hi.X, gpu.paths.X and, if it knows them, gpu.gap.lo.X and
/// gpu.gap.hi.X of those that are judged. `refusal`: why others have none, or empty.
std::string judge_page_of(const ExportContent& content, Film reference, const JudgePage& options,
                          const std::string& refusal);

}  // namespace quadrel
