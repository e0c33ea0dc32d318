// The error of what a scene draws, or of an image that was drawn elsewhere, against the truth: the
// exact frame of each triangle and the proven first hit of each ray.
//
// Three errors are told apart (README, "The error of an algorithm"):
//
//     whole    what is drawn                     against  exact frame, judge's search
//     search   exact frame, the scene's search   against  the same
//     frame    the scene's frame, judge's search against  the same
//
// The judge's search has the surface that the scene's searches (bilinear patches, or blocks where
// it reads texels as such) on level 0 under the sampler's wrap modes. Depth layers are judged by
// the exact search of as many layers, which is right up to rounding and not proven.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "quadrel/film/film.hpp"
#include "quadrel/scene/scene.hpp"

namespace quadrel {

/// err.kind: where a hit lies beside the judge's. Part of the file format.
enum class ErrorKind : std::int32_t {
    same = 0,           ///< not further than 1/256 of a texel and 2^-16 of the relief's depth
    late = 1,           ///< inside of the relief, behind the surface that the ray meets first
    early = 2,          ///< above the relief
    invented = 3,       ///< a hit where the judge has none
    missed = 4,         ///< none where the judge has one
    other_surface = 5,  ///< behind a part of the relief that it passed through, or beside the ray
    not_judged = 6,     ///< no frame, no map of heights or layers, or a ray that no one can follow
};
inline constexpr std::size_t error_kinds = 7;

/// "same", "late", ...
const char* error_kind_name(ErrorKind kind);

/// The greatest of so many values, and the values that so many per cent of them do not exceed (the
/// smallest value of that rank). NaN where there are none.
struct ErrorSpread {
    std::string channel;  ///< err.uv; err.color is the largest magnitude of its three
    std::string unit;
    std::uint64_t values = 0;  ///< finite ones
    std::uint64_t not_finite = 0;
    double p50 = 0, p90 = 0, p99 = 0, p999 = 0, most = 0;  ///< of magnitudes
};

/// One of the three errors.
struct ErrorPartSummary {
    std::string name;                                ///< "whole", "search", "frame"
    std::array<std::uint64_t, error_kinds> kinds{};  ///< pixels, by ErrorKind
    /// Pixels whose hit lies in another cell; none of an image that does not say where it lies.
    std::optional<std::uint64_t> other_cell;
    std::vector<ErrorSpread> spreads;  ///< |s|, uv, normal, |shadow|, largest |colour|, frame K

    /// Of the pixels that are judged; 0 where there are none.
    double share(ErrorKind kind) const;
};

/// A pixel to look at.
struct WorstPixel {
    int x = 0, y = 0;     ///< image coordinates
    std::string channel;  ///< in which it is the worst
    double value = 0;
    ErrorKind kind = ErrorKind::same;
    std::string command;  ///< `quadrel probe`, to copy
};

struct ErrorSummary {
    std::uint64_t pixels = 0;     ///< of the window
    std::uint64_t covered = 0;    ///< with a fragment
    std::uint64_t judged = 0;     ///< of these; the rest has no frame or no height map
    std::uint64_t certified = 0;  ///< of the judged ones, those whose truth is proven
    /// Of the window, those that show another object than with the judges' searches, in scenes with
    /// depth layers: rays that pass what they should meet, or are stopped by what is not there.
    std::optional<std::uint64_t> other_object;
    std::string judges;  ///< a line a material: its exact frame and the judge's search
    std::string image;   ///< the file that was judged; empty: what the scene draws
    std::vector<ErrorPartSummary> parts;  ///< whole, search, frame; of an image the whole alone
    std::vector<WorstPixel> worst;        ///< of the whole: by uv, then by normal and colour
};

struct ErrorOptions {
    std::optional<Window> window;  ///< image coordinates; the whole frame if absent
    std::string number = "float";  ///< as RenderOptions has it
    std::string isa = "auto";
    int threads = 0;
    std::size_t worst = 3;  ///< pixels to name a channel
    Film* film = nullptr;   ///< receives the channels
    std::function<void(double)> progress;
};

/// Renders the scene's view with all err.* channels and sums them up. A pixel counts by its
/// fragment of the lowest covered sample. Throws as `render` does.
ErrorSummary measure_errors(const Scene& scene, const ErrorOptions& options = {});

/// Judges an image of the scene's size that was drawn elsewhere, by the channels that it holds of
/// hit.U, hit.V, hit.s, hit.status, N, shadow.visibility, R, G, B, A (where that is 0, nothing was
/// drawn) as `render` names them. hit.s may lack: then late and early are told by UV alone; the
/// colour is compared with that of the scene's stages at the judge's hit. The window is the
/// image's, cut to options.window. Throws UsageError where it has none of these channels, or its
/// frame is not the scene's size.
ErrorSummary measure_errors(const Film& image, const Scene& scene,
                            const ErrorOptions& options = {});

/// The same from a film with some of error_channels(), A and err.kind among them: for who draws on
/// his own. Names no judges, and no commands.
ErrorSummary summarize_errors(const Film& film, std::size_t worst = 3);

/// The channels that summarize_errors reads: A and err.*.
std::vector<std::string> error_channels();

/// A table for people, and one JSON object.
std::string to_text(const ErrorSummary& summary);
std::string to_json(const ErrorSummary& summary);

}  // namespace quadrel
