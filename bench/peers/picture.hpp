// One row at one angle: the scene that both sides take, and how Quadrel draws it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "quadrel/render.hpp"

namespace quadrel::peers {

/// A quad that fills the frame, seen at `angle` degrees between view and normal from so far away
/// (4 degrees of field of view) that all pixels are; one tile of the maps is a unit of length and,
/// seen from the front, the frame's height.
Scene wall_scene(const std::filesystem::path& maps, double angle, int size,
                 const std::vector<std::string>& overrides);

/// Milliseconds.
struct Time {
    double wall = 0, cpu = 0;
};

/// Quadrel's drawing of a scene, again and again into one film.
class Picture {
  public:
    /// `skip`: that of RenderOptions.
    Picture(Scene scene, const std::string& isa, std::vector<std::string> channels,
            bool skip = true);

    /// Draws on so many threads; what drawing alone took, without planning and loading.
    Time draw(int threads);

    /// Renders with so much of statistics; what all of it took, planning and counting included.
    enum class Counting { nothing, stats, touched };
    Time render_counting(int threads, Counting counting);

    /// By texture slot, of a frame drawn on one thread with all shortcuts.
    std::map<std::string, std::uint64_t> look_ups();

    const Scene& scene() const { return scene_; }
    const Film& film() const { return film_; }
    /// What the first drawing loaded, derived maps included.
    Time load() const { return load_; }

  private:
    Scene scene_;
    RenderOptions options_;
    Film film_;
    Time load_;
    bool loaded_ = false;
};

/// The channels that llvmpipe's target has, too.
inline const std::vector<std::string> colour_channels{"R", "G", "B", "A"};

}  // namespace quadrel::peers
