#include "render/probe/command.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "render/registry/added_stages.hpp"
#include "text/shell_word.hpp"

namespace quadrel {

ProbeCommand::ProbeCommand(const Scene& scene, const KernelTable& table, const std::string& isa)
    : scene_(scene) {
    for (const std::string& assignment : scene.overrides)
        options_ += " -D " + shell_word(assignment);
    const auto plugins = loaded_plugins();
    for (const auto& plugin : plugins) options_ += " --plugin " + shell_word(plugin.string());
    // A plugin may lack a part for the set that was chosen: then it cannot be asked for by name.
    const bool by_name = isa != "auto" || plugins.empty();
    options_ += fmt::format(" --number {} --isa {}",
                            table.scalar_bytes == sizeof(float) ? "float" : "double",
                            by_name ? table.isa : "auto");
}

void ProbeCommand::add(const std::string& option, const std::string& value) {
    options_ += fmt::format(" {} {}", option, shell_word(value));
}

std::string ProbeCommand::text(const QuadCoverage& quad) const {
    const auto seen =
        std::find_if(quad.samples.begin(), quad.samples.end(), [](auto s) { return s != 0; });
    const auto lane =
        seen == quad.samples.end() ? 0 : static_cast<int>(seen - quad.samples.begin());
    const Viewport viewport{scene_.width, scene_.height, scene_.conventions};
    return text(quad.x + lane % 2, flip_row(viewport, quad.y + lane / 2));
}

std::string ProbeCommand::text(int x, int y) const {
    return fmt::format("quadrel probe {} --pixel {},{}{}", shell_word(scene_.file.string()), x, y,
                       options_);
}

std::string QuadContext::text() const {
    const std::string command = command_.text(quads_.front());
    if (quads_.size() == 1) return "to reproduce: " + command;
    return fmt::format("while shading {} quads, the first of them: {}", quads_.size(), command);
}

}  // namespace quadrel
