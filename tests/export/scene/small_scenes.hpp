// The installed scenes with small pictures and small maps, so that all of them can be exported.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "export/export.hpp"
#include "film/films.hpp"
#include "film/image_film.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/scene/load.hpp"
#include "render/plan/plan.hpp"

namespace quadrel::export_tests {

/// RGBA, 16x16, of no two texels alike; halves, which every format keeps well enough.
inline Image small_image() {
    Image image;
    image.width = image.height = 16;
    image.channels = 4;
    for (int i = 0; i < 16 * 16 * 4; ++i)
        image.values.push_back(static_cast<float>((i * 37 + i / 64 * 11) % 251) / 256.0f);
    return image;
}

class SmallScenes {
  public:
    SmallScenes() : map_(folder_ / "map.exr"), layers_(folder_ / "layers.exr") {
        Image image = small_image();
        write_exr(map_, image_film(image, false), {});
        for (auto texel = image.values.begin(); texel != image.values.end(); texel += 4)
            std::sort(texel, texel + 4);
        write_exr(layers_, image_film(image, false), {});
    }

    /// The scene at 16x16, all of its images the small one.
    Scene load(const std::string& name, std::vector<std::string> overrides = {}) const {
        overrides.emplace_back("size=[16,16]");
        Scene scene = load_scene(name, overrides);
        for (Material& material : scene.materials)
            for (auto& [slot, texture] : material.textures) {
                texture.file =
                    slot == "layers" || slot == "layers_2" || slot == "layers_3" ? layers_ : map_;
                texture.selection = {};
                texture.srgb = false;
                if (texture.swizzle == "alpha-or-first") texture.swizzle = "a";
            }
        if (scene.environment)
            for (std::size_t face = 0; face < 6; ++face) {
                scene.environment->faces[face] = map_;
                scene.environment->selections[face] = {};
            }
        return scene;
    }
    std::filesystem::path path(const std::string& name) const { return folder_ / name; }

  private:
    testing_films::TemporaryFolder folder_;
    std::filesystem::path map_, layers_;  ///< layers in their order
};

/// Stages of a scene's visible objects that cannot be shaders, but for those of which nothing is
/// asked.
inline std::vector<std::string> refused_stages(const Scene& scene) {
    static const std::vector<ExportRow> rows = export_rows();
    std::vector<std::string> refused;
    for (const Object& object : scene.objects)
        for (const PlannedStage& stage : material_stages(scene, scene.materials[object.material])) {
            const std::string room = stage.info->text.room;
            if (!object.visible || room == "quad" || room == "oracle") continue;
            for (const ExportRow& row : rows)
                if (row.id == stage.info->text.id && !row.refusal.empty())
                    refused.push_back(row.id);
        }
    return refused;
}

}  // namespace quadrel::export_tests
