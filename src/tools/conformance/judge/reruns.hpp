// The reference once more, from an implementation's own values on, in parts of the frame.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "quadrel/film/film.hpp"
#include "quadrel/render.hpp"
#include "quadrel/scene/scene.hpp"
#include "render/draw/geometry.hpp"
#include "render/plan/render_plan.hpp"

namespace quadrel::conformance {

/// The height maps and layers of a prepared render, all texels multiplied; not what is baked from
/// them. Bounds that searches know of the heights hold no longer, and are taken away.
class ScaledHeights {
  public:
    ScaledHeights(RenderPlan& plan, double factor);

  private:
    std::vector<std::vector<float>> texels_;
};

/// What stages read that is no value of an image.
struct Moved {
    double heights = 1;           ///< look-ups of heights give so many times what maps have
    double levels = 0;            ///< they are of a level of detail with this added
    std::array<double, 3> eye{};  ///< as Perturbation has it
};

/// Whether a search takes its ray from a vertex program, and not from a shell.
bool has_vertex_rays(const Scene& scene);

/// Moves the eye as the vertex programs of a prepared render have it.
void move_eye(Geometry& geometry, const std::array<double, 3>& parts);

class Reruns {
  public:
    /// `threads`: as RenderOptions has them. The scene must outlive it.
    Reruns(const Scene& scene, int threads) : scene_(scene), threads_(threads) {}

    /// The whole frame as the scene has it.
    Film reference(const std::vector<std::string>& channels) const;

    /// What stages make of the values `names` of an image: a film of its window, drawn in parts of
    /// it, elsewhere 0.
    Film made_of(const std::vector<std::string>& channels, const std::vector<std::string>& names,
                 const Film& image, const std::vector<Window>& parts,
                 const Moved& moved = {}) const;

    /// The same as ranges that `limits` permits: `take` gets a film of each of the windows, which
    /// lie in that of the image. Throws UsageError where a stage has none.
    void ranges(const std::vector<std::string>& channels, const std::vector<std::string>& names,
                const Film& image, const std::string& limits, const std::vector<Window>& windows,
                const std::function<void(const Window&, const Film&)>& take) const;

  private:
    RenderOptions options(const std::vector<std::string>& channels,
                          const std::vector<std::string>& names, const Film& image) const;

    const Scene& scene_;
    int threads_;
};

/// Planes of these names and A, in a window of the frame.
Film part_of(const Film& film, const std::vector<std::string>& names, const Window& window);

/// Squares of whole quads, 16 pixels a side, that hold these pixels of a window's frame.
std::vector<Window> squares_around(const std::vector<std::size_t>& pixels, const Window& frame,
                                   const Window& window);

/// The smallest window of whole quads that holds these pixels of a frame, and one quad more on each
/// side.
Window window_around(const std::vector<std::size_t>& pixels, const Window& frame);

}  // namespace quadrel::conformance
