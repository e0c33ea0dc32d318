#include "cli/bake_layers.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "bake/layers/closed_mesh.hpp"
#include "cli/common/arguments.hpp"
#include "cli/common/command_files.hpp"
#include "cli/common/console.hpp"
#include "cli/common/hints.hpp"
#include "quadrel/bake/depth_layers.hpp"
#include "quadrel/error.hpp"
#include "quadrel/scene/mesh_file.hpp"

namespace quadrel::cli {
namespace {

/// "x,y,z", not all 0.
glm::dvec3 parse_direction(const std::string& text) {
    const std::vector<std::string> parts = parse_list("--towards", text);
    glm::dvec3 direction(0);
    bool sound = parts.size() == 3;
    for (std::size_t c = 0; sound && c < 3; ++c) {
        const char* const end = parts[c].data() + parts[c].size();
        const auto [stop, error] =
            std::from_chars(parts[c].data(), end, direction[static_cast<int>(c)]);
        sound = error == std::errc() && stop == end &&
                std::abs(direction[static_cast<int>(c)]) <= 1e100;
    }
    const double size =
        std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    if (!sound || !(size > 1e-100))
        throw UsageError(
            fmt::format("--towards: found \"{}\", expected 3 numbers, not all 0: x,y,z", text));
    return direction / size;
}

DepthLayerOptions make_layer_options(const LayerArguments& arguments) {
    constexpr int largest = 16384;
    const Size size = parse_size("--size", arguments.size);
    if (size.width > largest || size.height > largest)
        throw UsageError(fmt::format("--size: found \"{}\", expected at most {}x{}", arguments.size,
                                     largest, largest));
    if (!(arguments.margin >= 0 && arguments.margin < 0.5))
        throw UsageError(
            fmt::format("--margin: found {}, expected a number in [0, 0.5)", arguments.margin));
    if (arguments.solids < 1 || arguments.solids > most_solids)
        throw UsageError(
            fmt::format("--solids: found {}, expected 1 to {}", arguments.solids, most_solids));
    return {size.width, size.height, parse_direction(arguments.towards), arguments.margin,
            arguments.solids};
}

}  // namespace

ExitCode bake_layers(const LayerArguments& arguments) {
    const DepthLayerOptions options = make_layer_options(arguments);
    check_output_kinds({{"-o", ".exr", arguments.output}});
    CommandFiles files;
    if (!is_closed_shape(arguments.mesh))
        for (const auto& file : files_of_mesh(arguments.mesh)) files.add_input(file);
    files.add_output("-o", arguments.output);
    files.check_writable();
    const DepthLayers layers = peel_depth_layers(closed_mesh(arguments.mesh), options);
    write_exr(arguments.output, layers.film, attributes_of(layers),
              {arguments.compression, arguments.threads});
    if (layers.deeper > 0)
        tell(fmt::format(
            "quadrel: {} texels have more than {} behind each other: the nearest are "
            "kept",
            layers.deeper,
            options.solids == 1 ? "one solid" : fmt::format("{} solids", options.solids)));
    tell(
        fmt::format("quadrel: one tile is {:g} long, the relief {:g} deep: "
                    "\"depth\": {{\"thickness\": {:g}, \"tile\": {:g}}}",
                    layers.tile, layers.thickness, layers.thickness, layers.tile));
    tell(fmt::format("quadrel: its middle is at ({:g}, {:g}, {:g})", layers.middle.x + 0.0,
                     layers.middle.y + 0.0, layers.middle.z + 0.0));
    say_written(arguments.output);
    return ExitCode::ok;
}

}  // namespace quadrel::cli
