#include "cli/compare/against.hpp"

#include <fmt/format.h>

#include "cli/common/arguments.hpp"
#include "cli/common/console.hpp"
#include "cli/common/plugins.hpp"
#include "cli/compare/arguments.hpp"
#include "quadrel/errors.hpp"
#include "quadrel/film/comparable.hpp"
#include "quadrel/scene/load.hpp"

namespace quadrel::cli {
namespace {

/// Codes went through a transfer function that the file does not name.
void refuse_codes(const ComparableImage& image) {
    for (const auto& [name, storage] : image.stored)
        if (image.film.find(name) != nullptr &&
            (storage == Storage::unorm8 || storage == Storage::unorm16))
            throw UsageError(fmt::format(
                "--against: channel \"{}\" is stored as {}, expected floats, as of an EXR", name,
                storage_name(storage)));
}

ComparableImage judged_image(const AgainstArguments& arguments) {
    ComparableImage image = read_comparable(arguments.image, arguments.selection);
    if (arguments.flip_y) flip_y(image.film);
    map_channels(image, parse_mappings(arguments.mappings));
    if (!arguments.channels.empty()) {
        Film none{image.film.frame, image.film.window, {}};
        select_channels(arguments.channels, none, image.film);
    }
    refuse_codes(image);
    return image;
}

}  // namespace

ExitCode run_against(const AgainstArguments& arguments) {
    load_plugins(arguments.plugins);
    const ComparableImage image = judged_image(arguments);
    const Window& frame = image.film.frame;
    const Scene scene = load_scene(
        arguments.scene,
        with_size(arguments.overrides, fmt::format("{}x{}", frame.width(), frame.height())));
    say_notes(scene.notes);
    ErrorOptions options;
    if (!arguments.window.empty()) options.window = parse_window("--window", arguments.window);
    ErrorSummary summary;
    {
        ProgressBar bar;
        options.progress = [&bar](double share) { bar.show(share); };
        summary = measure_errors(image.film, scene, options);
    }
    summary.image = arguments.image;
    arguments.json ? print_json(to_json(summary)) : print(to_text(summary));
    return ExitCode::ok;
}

}  // namespace quadrel::cli
