// What may change between two frames of a scene.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "render/scenes.hpp"

namespace quadrel::render_tests {

struct Change {
    std::string name;
    std::function<void(Scene&)> apply;
    bool moves;  ///< geometry is another one
};

/// Of a scene like varied_scene, each to be applied to what those before it have left.
inline std::vector<Change> scene_changes() {
    return {
        {"nothing", [](Scene&) {}, false},
        {"a parameter", [](Scene& s) { s.materials[0].trace.parameters["steps"] = 7; }, false},
        {"a stage", [](Scene& s) { s.materials[0].shade.id = "shade-lambert"; }, false},
        {"depth", [](Scene& s) { s.materials[0].depth = 0.1f; }, false},
        {"a light", [](Scene& s) { s.lights[0].intensity = 0.5f; }, false},
        {"background", [](Scene& s) { s.background.r = 0.75f; }, false},
        {"a sampler",
         [](Scene& s) { s.materials[0].textures["color"].sampler.wrap_u = Wrap::mirrored_repeat; },
         false},
        {"a swizzle", [](Scene& s) { s.materials[0].textures["height"].swizzle = "b"; }, false},
        {"a texture", [](Scene& s) { s.materials[3].textures["color"] = noise_texture(); }, false},
        {"the view",
         [](Scene& s) {
             s.camera.view = glm::mat4(translation({0.1, -0.2, 0.3})) * s.camera.view;
         },
         true},
        {"the projection", [](Scene& s) { s.camera.projection[0][0] *= 1.25f; }, true},
        {"a transform",
         [](Scene& s) {
             s.objects[0].transform = glm::mat4(rotation(10, {0, 1, 0}));
         },
         true},
        {"a vertex", [](Scene& s) { s.meshes[0].positions[0].x += 0.25f; }, true},
        {"a texture coordinate", [](Scene& s) { s.meshes[0].uvs[1].y -= 0.125f; }, true},
        {"a normal",
         [](Scene& s) {
             s.meshes[1].normals[0] = {0.6f, 0, 0.8f};
         },
         true},
        {"an index",
         [](Scene& s) { std::swap(s.meshes[0].triangles[0], s.meshes[0].triangles[1]); }, true},
        {"a texture matrix",
         [](Scene& s) {
             s.materials[0].texture_matrix = glm::mat4(scaling({2, 3, 1}));
         },
         true},
        {"culling", [](Scene& s) { s.materials[3].cull = Cull::back; }, true},
        {"a frame", [](Scene& s) { s.materials[0].frame.id = "frame-mikkt"; }, true},
        {"a material of an object", [](Scene& s) { s.objects[1].material = 0; }, true},
        {"a mesh of an object", [](Scene& s) { s.objects[1].mesh = 0; }, true},
        {"visibility", [](Scene& s) { s.objects[2].visible = false; }, true},
        {"an object less", [](Scene& s) { s.objects.pop_back(); }, true},
        {"hardware", [](Scene& s) { s.hardware = Hardware::llvmpipe; }, true},
        {"samples", [](Scene& s) { s.samples = 4; }, true},
        {"size", [](Scene& s) { s.width = 30; }, true},
        {"conventions", [](Scene& s) { s.conventions = Conventions::vulkan; }, true},
    };
}

}  // namespace quadrel::render_tests
