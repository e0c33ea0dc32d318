// Impostors in a scene: cards with the layers of a mesh, beside that mesh, from several sides; they
// are tested by depth like anything else, and are made anew for each camera.
#include "quadrel/bake/depth_layers.hpp"
#include "render/planted.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

constexpr int map_side = 192;

/// A torus that stands on its side, seen twice along z.
Mesh ring() {
    Mesh mesh = make_torus(0.3, 0.8, 24, 48);
    for (std::vector<glm::vec3>* const list : {&mesh.positions, &mesh.normals})
        for (glm::vec3& p : *list) p = {p.x, -p.z, p.y};
    return mesh;
}

const DepthLayers& ring_layers() {
    static const DepthLayers layers = [] {
        DepthLayerOptions options;
        options.width = options.height = map_side;
        return peel_depth_layers(ring(), options);
    }();
    return layers;
}

Material impostor_material() {
    Material material = plain_material("ring");
    material.frame.id = "frame-impostor";
    material.trace.id = "true-impostor";
    material.trace.parameters["steps"] = 128;
    material.surface.id = "h2n-impostor";
    material.frag_depth = stage("frag-depth", "materials.ring.relief.frag_depth");
    material.depth = static_cast<float>(ring_layers().thickness / ring_layers().tile);
    material.depth_in_tiles = true;
    material.textures["layers"] = texture(write_if_new("ring_layers.exr", ring_layers().film));
    material.textures["layers"].sampler.wrap_u = material.textures["layers"].sampler.wrap_v =
        Wrap::clamp_to_edge;
    return material;
}

/// Rings that go through each other, as cards or as they are.
Scene rings(const glm::dvec3& eye, bool cards) {
    Scene scene = empty_scene(64, 48);
    set_perspective_camera(scene, eye, {});
    scene.lights = {directional_light({1, 2, 3})};
    scene.materials = {cards ? impostor_material() : plain_material("ring")};
    const Mesh mesh = cards ? make_billboard(ring_layers().tile, 1.25) : ring();
    add_object(scene, mesh, 0, rotation(20, {1, 0, 0}));
    add_object(
        scene, mesh, 0,
        translation({0.7, 0.2, -0.1}) * rotation(80, {0, 1, 0.3}) * scaling(glm::dvec3(0.8)));
    return scene;
}

/// Where cards and meshes cover the same pixels, the same thing is nearest at the same distance;
/// few pixels, at outlines, differ.
testing::AssertionResult shows_the_meshes(const Renderer& renderer) {
    for (const glm::dvec3& eye : {glm::dvec3(0.3, 0.4, 5), glm::dvec3(4.5, 1, 0.4),
                                  glm::dvec3(-1, -4.6, -0.5), glm::dvec3(1, 2, -4)}) {
        const std::vector<std::string> channels = {"A", "Z", "id.object", "N"};
        const Film found = take(renderer, rings(eye, true), channels);
        const Film meshes = take(render, rings(eye, false), channels);
        int covered = 0, outline = 0, other = 0, apart = 0, turned = 0;
        for (int y = 0; y < meshes.frame.y1; ++y)
            for (int x = 0; x < meshes.frame.x1; ++x) {
                const bool is = value(meshes, "A", x, y) == 1, shown = value(found, "A", x, y) == 1;
                covered += is;
                outline += is != shown;
                if (!is || !shown) continue;
                if (bits(meshes, "id.object", x, y) != bits(found, "id.object", x, y)) {
                    ++other;
                    continue;
                }
                apart += std::abs(value(meshes, "Z", x, y) - value(found, "Z", x, y)) > 0.04;
                float cosine = 0;
                for (const char* axis : {"N.X", "N.Y", "N.Z"})
                    cosine += value(meshes, axis, x, y) * value(found, axis, x, y);
                turned += cosine < 0.8f;
            }
        if (covered < 180 || outline > covered / 30 || other > covered / 40 ||
            apart > covered / 40 || turned > covered / 20)
            return testing::AssertionFailure()
                   << covered << " pixels, " << outline << " at outlines, " << other
                   << " of another, " << apart << " at another distance, " << turned << " turned";
    }
    return testing::AssertionSuccess();
}

Renderer changed(const std::function<void(Scene&)>& change) {
    return [change](const Scene& scene, const RenderOptions& options) {
        Scene other = scene;
        change(other);
        return render(other, options);
    };
}

TEST(Impostors, ShowTheMeshesOfTheirLayers) {
    EXPECT_TRUE(shows_the_meshes(render));
    EXPECT_FALSE(shows_the_meshes(changed([](Scene& scene) {
        scene.materials[0].frag_depth = {};
    }))) << "the depth of their cards";
    EXPECT_FALSE(shows_the_meshes(changed([](Scene& scene) {
        scene.materials[0].frame.id = "frame-gram";
    }))) << "a frame of the card alone";
    EXPECT_FALSE(shows_the_meshes(changed([](Scene& scene) { scene.materials[0].depth *= 1.15f; })))
        << "too deep";
    EXPECT_FALSE(shows_the_meshes(changed([](Scene& scene) {
        for (Mesh& mesh : scene.meshes) mesh.billboard.reset();
    }))) << "cards that do not turn";
}

}  // namespace
}  // namespace quadrel::render_tests
