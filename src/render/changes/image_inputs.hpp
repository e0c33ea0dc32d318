// What the pixels of an image depend on, object by object, so that after a change of the scene only
// those are drawn again that it can touch.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "quadrel/film/film.hpp"
#include "quadrel/render.hpp"
#include "quadrel/scene/scene.hpp"

namespace quadrel {

struct ObjectInputs {
    std::string name;      ///< of the object
    std::string material;  ///< name of its material
    std::string own;       ///< mesh, place and what else it has: equal texts, equal triangles
    std::string shading;   ///< all that the planned stages read of the material
    std::optional<Window> bounds;  ///< pixels that its triangles can cover; nothing: none
};

struct ImageInputs {
    std::string everywhere;  ///< what every pixel depends on
    std::vector<ObjectInputs> objects;
    Window window;  ///< of the image
};

/// Plans the render, which says what is read; loads no texture. Throws as `render` does.
ImageInputs image_inputs(const Scene& scene, const RenderOptions& options);

struct ImageChange {
    std::vector<std::string> what;  ///< in words; empty where no pixel depends on the change
    std::optional<Window> pixels;   ///< those that may differ; nothing where none does
};

ImageChange change_between(const ImageInputs& before, const ImageInputs& after);

}  // namespace quadrel
