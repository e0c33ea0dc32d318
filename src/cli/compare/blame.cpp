#include "cli/compare/blame.hpp"

#include <fmt/format.h>

#include "cli/common/arguments.hpp"
#include "cli/compare/arguments.hpp"
#include "quadrel/scene/load.hpp"
#include "text/shell_word.hpp"

namespace quadrel::cli {

ProbedScene open_probed_scene(const std::string& name, const std::vector<std::string>& overrides) {
    load_scene(name, overrides);
    return {name, overrides, {}};
}

void point_at_probe(Blame& blame, const ProbedScene& scene, const ComparableImage& reference) {
    const Window& frame = reference.film.frame;
    const std::string size = fmt::format("{}x{}", frame.width(), frame.height());
    const Scene as_written = load_scene(scene.name, scene.overrides);
    const bool resized = as_written.width != frame.width() || as_written.height != frame.height();
    blame.command =
        fmt::format("quadrel probe {} --pixel {},{}", shell_word(scene.name), blame.x, blame.y);
    for (const std::string& override : scene.overrides)
        blame.command += " -D " + shell_word(override);
    for (const std::string& plugin : scene.plugins)
        blame.command += " --plugin " + shell_word(plugin);
    if (resized) blame.command += " --size " + size;
    const auto recorded = reference.attributes.find("quadrel:sceneHash");
    if (recorded == reference.attributes.end()) return;
    const Scene as_rendered =
        resized ? load_scene(scene.name, with_size(scene.overrides, size)) : as_written;
    blame.same_scene = recorded->second == as_rendered.hash;
}

}  // namespace quadrel::cli
