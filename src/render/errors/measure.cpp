// Renders of err.* channels, of what a scene draws and of images that were drawn elsewhere.
#include <fmt/format.h>

#include <algorithm>

#include "quadrel/error.hpp"
#include "quadrel/errors.hpp"
#include "quadrel/render.hpp"
#include "render/errors/error_plan.hpp"
#include "render/probe/command.hpp"
#include "render/registry/added_stages.hpp"

namespace quadrel {
namespace {

RenderOptions render_options(const ErrorOptions& options, std::vector<std::string> channels) {
    RenderOptions made;
    made.channels = std::move(channels);
    made.window = options.window;
    made.number = options.number;
    made.isa = options.isa;
    made.threads = options.threads;
    made.progress = options.progress;
    return made;
}

/// The scene with the judge's search of layers; none where it has no others.
std::optional<Scene> with_judged_layers(const Scene& scene) {
    std::optional<Scene> judged;
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        const auto judge = error_judge(scene, scene.materials[m]);
        if (!judge || judge->layers == 0) continue;
        if (!judged) judged = scene;
        StageChoice& trace = judged->materials[m].trace;
        trace.id = judge->trace;
        trace.parameters.clear();
    }
    return judged;
}

/// Pixels in which another object is seen, or one is where nothing should be.
std::optional<std::uint64_t> count_other_objects(const Scene& scene, RenderOptions rendering) {
    const std::optional<Scene> judged = with_judged_layers(scene);
    if (!judged) return std::nullopt;
    rendering.channels = {"A", "id.object"};
    rendering.progress = {};
    const Film drawn = render(scene, rendering), truth = render(*judged, rendering);
    std::uint64_t other = 0;
    for (std::size_t i = 0; i < drawn.find("A")->bits.size(); ++i) {
        const auto seen = [&](const Film& film) {
            return std::pair(film.find("A")->as_float(i) > 0, film.find("id.object")->bits[i]);
        };
        other += seen(drawn) != seen(truth);
    }
    return other;
}

ErrorSummary measure(const Scene& scene, const RenderOptions& rendering,
                     const ErrorOptions& options) {
    Film own;
    Film& film = options.film != nullptr ? *options.film : own;
    film = render(scene, rendering);
    ErrorSummary summary = summarize_errors(film, options.worst);
    summary.judges = judges_text(scene);
    if (rendering.judged == nullptr) summary.other_object = count_other_objects(scene, rendering);
    const ProbeCommand command(scene, select_kernels(rendering), rendering.isa);
    for (WorstPixel& pixel : summary.worst) pixel.command = command.text(pixel.x, pixel.y);
    return summary;
}

bool has_any(const Film& image, std::initializer_list<const char*> names) {
    return std::ranges::any_of(names,
                               [&](const char* name) { return image.find(name) != nullptr; });
}

/// What of an image can be judged.
std::vector<std::string> channels_of(const Film& image) {
    std::vector<std::string> channels{"A", "err.kind", "err.certified"};
    if (image.find("hit.s")) channels.push_back("err.s");
    if (has_any(image, {"hit.U", "hit.V"})) channels.insert(channels.end(), {"err.uv", "err.cell"});
    if (has_any(image, {"N.X", "N.Y", "N.Z"})) channels.push_back("err.normal");
    if (has_any(image, {"shadow.visibility", "shadow.0.visibility"}))
        channels.push_back("err.shadow");
    for (const char* color : {"R", "G", "B"})
        if (image.find(color)) channels.push_back(std::string("err.color.") + color);
    if (channels.size() == 3)
        throw UsageError(
            "the image has no channel that can be judged: one of hit.U, hit.V, hit.s, N.X, N.Y, "
            "N.Z, shadow.visibility, R, G, B");
    return channels;
}

void check_frame(const Film& image, const Scene& scene) {
    const Window frame{0, 0, scene.width, scene.height};
    if (image.frame != frame || !contains(frame, image.window))
        throw UsageError(fmt::format("the image is {}x{}, the scene {}x{}", image.frame.width(),
                                     image.frame.height(), scene.width, scene.height));
}

}  // namespace

ErrorSummary measure_errors(const Scene& scene, const ErrorOptions& options) {
    return measure(scene, render_options(options, error_channels()), options);
}

ErrorSummary measure_errors(const Film& image, const Scene& scene, const ErrorOptions& options) {
    check_frame(image, scene);
    RenderOptions rendering = render_options(options, channels_of(image));
    Film part;
    rendering.judged = &image;
    if (options.window && *options.window != image.window) {
        if (!contains(image.window, *options.window))
            throw UsageError("the window is not a part of the image");
        part = image;
        crop(part, *options.window);
        rendering.judged = &part;
    }
    rendering.window = rendering.judged->window;
    return measure(scene, rendering, options);
}

}  // namespace quadrel
