// A scene that is drawn frame after frame:
//
//     PreparedScene prepared = prepare(load_scene("bricks-45"));
//     Film film;
//     for (const glm::mat4& view : views) {
//         prepared.scene().camera.view = view;
//         prepared.draw_into(film);
//     }
#pragma once

#include <filesystem>
#include <memory>

#include "quadrel/film/exr.hpp"
#include "quadrel/render.hpp"

namespace quadrel {

/// What a frame needs and the one before has made is taken from there: textures and baked maps of
/// files that have not changed, what was measured of them, and geometry unless the camera, a mesh,
/// an object or the frame's size has changed. Every frame has the bits of `render` of that scene
/// and those options. Not for several threads at once.
class PreparedScene {
  public:
    /// Plans, assembles and loads what a frame of this needs, so that the first is like all others.
    /// Throws as `render` does.
    PreparedScene(Scene scene, RenderOptions options);
    ~PreparedScene();
    PreparedScene(PreparedScene&&) noexcept;
    PreparedScene& operator=(PreparedScene&&) noexcept;

    /// To be changed at will between frames: anything of them, which is seen without being told.
    Scene& scene();
    RenderOptions& options();

    /// Draw a frame. Throw as `render`, `render_into` and `render_to_exr` do.
    Film draw();
    void draw_into(Film& film);
    void draw_to_exr(const std::filesystem::path& file,
                     ExrCompression compression = ExrCompression::zip);

    /// How often it has assembled geometry so far.
    int assembled() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// A PreparedScene.
inline PreparedScene prepare(Scene scene, RenderOptions options = {}) {
    return {std::move(scene), std::move(options)};
}

}  // namespace quadrel
