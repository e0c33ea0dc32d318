// Rendering a scene to named channels.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "quadrel/film/exr.hpp"
#include "quadrel/film/film.hpp"
#include "quadrel/scene/scene.hpp"

namespace quadrel {

class KnownTruths;     // of the library's own, for sweeps
struct RenderStats;    // stats.hpp
struct RenderSummary;  // stats.hpp

/// A render whose pixels are integrals: see "Integrals over pixels" in the README.
struct IntegralOptions {
    static constexpr int replicates = 16;  ///< independent estimates, whose spread is the error
    static constexpr int least_samples = 16, most_samples = 65536;

    int samples = 4096;  ///< a pixel; a multiple of `replicates`
    /// Above 0: a quad gets no more samples once no standard error in its pixels is above this, in
    /// units of the channels; `samples` is the most.
    double error = 0;
};

/// Values that are taken from an image instead of from the stage that computes them: later stages,
/// and the film, get what the image has. So a stage is judged by what another implementation has
/// computed before it.
struct Injection {
    /// Values ("hit.uv"), channels ("hit.U") or groups of channels ("hit"), which stand for those
    /// that the image has; commas between them. What is rendered must read one of them at least.
    std::string values;
    /// Of the frame's size, with all of the window that is rendered. Floats for what is a number,
    /// integers for codes and counts. NaN is a value as any other. Where it has a channel A and
    /// that is not above 0, it has no fragment, and the stage's own value stays; as it does in
    /// helper lanes, and where fragments are tested for being discarded.
    std::shared_ptr<const Film> image;
    std::string source;  ///< what messages call the image
};

struct RenderOptions {
    std::vector<std::string> channels;  ///< names or groups; none: R G B A Z
    std::optional<Window> window;       ///< image coordinates; the whole frame if absent
    std::string number = "float";       ///< float | double
    std::string isa = "auto";           ///< auto | scalar | sse4 | avx2 | avx512 | neon
    /// vulkan, d3d, gl or webgpu: what gpu.* channels take for granted; for each other channel that
    /// has a range (has_range) they are rendered, too. After the name, settings of what no
    /// specification states: "gl,plane=1e-6" (README of data/limits). Empty: no gpu.* channels.
    std::string limits;
    /// Not beside exact.*, derr.*, err.* and bound.* channels, integrals, and several samples a
    /// pixel.
    std::vector<Injection> injected;
    int threads = 0;   ///< 0: as many as the process may use; more are obeyed
    bool skip = true;  ///< false: compute and load what no channel asks for, too
    /// What err.* channels judge in the place of what is drawn: a film of the same window, which
    /// must stay as long as the render (errors.hpp says which channels of it).
    const Film* judged = nullptr;
    /// What the judge has found in renders before this one, which may differ in material.trace and
    /// what that alone reads: it gets what this one finds. For err.* channels.
    KnownTruths* truths = nullptr;
    RenderStats* stats = nullptr;  ///< receives what the render did and took
    /// `stats` also tells what look-ups touched and how many steps searches made: by a second pass,
    /// which takes three to four times as long as drawing.
    bool touched = false;
    RenderSummary* summary = nullptr;  ///< receives the little of it that costs nothing
    /// Each pixel is the mean of the judge's shading over its area. The scene is changed for that:
    /// the first hit of the height field in place of what the trace finds, textures filtered
    /// bilinearly at level 0, exact hardware, one sample per pixel and pass. Channels are then R,
    /// G, B, A and integral.*, which is the default.
    std::optional<IntegralOptions> integral;
    int tile = 64;                         ///< side of a tile in pixels, even, 2 to 1024
    std::function<void(double)> progress;  ///< called with 0 to 1, from any thread, one at a time
    /// The same before the first tile, while a map that no cache has is derived from heights; `map`
    /// is what to call it.
    std::function<void(const std::string& map, double share)> baking;
    /// Seconds that deriving a map may take, after which the render ends with an InputError that
    /// names the command that bakes it.
    double baking_limit = 20;
    /// Told why the disk cache, unless it is switched off, does not keep such a map.
    std::function<void(const std::string& reason)> not_kept;
};

/// Renders. The film's bits depend on scene, channels and number type only: not on window (beyond
/// what it holds), instruction set, threads or tile size. Rendered again, with another camera,
/// window, or whatever of the scene is changed, a scene has its textures ready
/// (Scene::texture_cache). Throws InputError for a scene that cannot be planned or textures that
/// cannot be read, UsageError for options that make no sense.
Film render(const Scene& scene, const RenderOptions& options);

/// The same into a film, for one frame after another: what it held is lost, the memory of its
/// planes is used again where it is large enough. Unspecified, but valid, after an exception.
void render_into(Film& film, const Scene& scene, const RenderOptions& options);

/// Renders into an EXR file while it is drawn: the file that write_exr would write of the film,
/// with render_attributes, whole or not at all. Memory grows with the width of the image, not with
/// its height, and films that `render` refuses for their size are possible. Throws as `render` and
/// write_exr do; where the disk is full, drawing stops.
void render_to_exr(const std::filesystem::path& file, const Scene& scene,
                   const RenderOptions& options, ExrCompression compression = ExrCompression::zip);

/// The same for who writes other files: `take` is called with rows of the film, the top ones first,
/// each a film whose window is its part of the whole one; from any thread, one at a time. What it
/// throws ends the render.
void render_in_bands(const Scene& scene, const RenderOptions& options,
                     const std::function<void(const Film& band)>& take);

/// The plan of a render, for people; loads and renders nothing. Throws as `render` does.
std::string explain(const Scene& scene, const RenderOptions& options);

/// The quadrel:* attributes of a render: scene hash, conventions, stages and parameters, number
/// type, version, loaded plugins with their hashes. Nothing that changes between equal runs.
std::vector<std::pair<std::string, std::string>> render_attributes(const Scene& scene,
                                                                   const RenderOptions& options);

}  // namespace quadrel
