// What cannot be rendered is refused, with the right exception, key and text.
#include <algorithm>

#include "built_isas.hpp"
#include "kernels/select.hpp"
#include "quadrel/error.hpp"
#include "render/planted.hpp"
#include "render/scenes.hpp"
#include "scene/support.hpp"

namespace quadrel::render_tests {
namespace {

using ChangeScene = std::function<void(Scene&)>;
using ChangeOptions = std::function<void(RenderOptions&)>;

struct BadScene {
    const char* what;
    ChangeScene change;
    Complaint complaint;
};

Scene good_scene() {
    Scene scene = empty_scene(8, 6);
    set_perspective_camera(scene, {0, 0, 3}, {});
    scene.materials = {relief_material("stone", false)};
    add_object(scene, make_quad(), 0);
    return scene;
}

/// The scene's material as that of a shell.
Material& shell_of(Scene& scene) {
    Material& material = scene.materials[0];
    material.frame = stage("frame-shell", "");
    material.trace = stage("prism-exact", "");
    material.surface = stage("h2n-sobel", "");
    return material;
}

const std::vector<BadScene> bad_scenes = {
    {"a stage of no known id",
     [](Scene& s) { s.materials[0].trace.id = "liner"; },
     {"materials.stone.relief.trace", "unknown stage \"liner\"", "\"linear\""}},
    {"a stage of another room",
     [](Scene& s) { s.materials[0].frame.id = "linear"; },
     {"materials.stone.relief.frame", "\"linear\"", "frame-gram"}},
    {"a shade that is none",
     [](Scene& s) { s.materials[0].shade.id = "none"; },
     {"materials.stone.shade", "\"none\"", "shade-texture"}},
    {"a parameter that the stage does not have",
     [](Scene& s) { s.materials[0].trace.parameters["step"] = 3; },
     {"materials.stone.relief.trace.step", "unknown parameter", "steps"}},
    {"a parameter of a stage without any",
     [](Scene& s) { s.materials[0].surface.parameters["steps"] = 3; },
     {"materials.stone.relief.surface.steps", "unknown parameter", "takes no parameters"}},
    {"a parameter below its range",
     [](Scene& s) { s.materials[0].trace.parameters["steps"] = 0; },
     {"materials.stone.relief.trace.steps", "0", "an integer in [1, 65536]"}},
    {"a parameter above its range",
     [](Scene& s) { s.materials[0].shadow.parameters["steps"] = 1e6; },
     {"materials.stone.relief.shadow.steps", "1000000", "an integer in [1, 65536]"}},
    {"a fraction for a count",
     [](Scene& s) { s.materials[0].trace.parameters["steps"] = 2.5; },
     {"materials.stone.relief.trace.steps", "2.5", "an integer"}},
    {"a name that no value has",
     [](Scene& s) { s.materials[0].frame.parameters["split"] = "obliqe"; },
     {"materials.stone.relief.frame.split", "obliqe", "\"oblique\", or one of orthogonal, "}},
    {"a number without a name",
     [](Scene& s) { s.materials[0].frame.parameters["split"] = 2; },
     {"materials.stone.relief.frame.split", "2", "one of 0 orthogonal, 1 oblique"}},
    {"a name for a count",
     [](Scene& s) { s.materials[0].trace.parameters["steps"] = "many"; },
     {"materials.stone.relief.trace.steps", "many", "an integer in [1, 65536]"}},
    {"NaN for a parameter",
     [](Scene& s) { s.materials[0].trace.parameters["steps"] = std::nan(""); },
     {"materials.stone.relief.trace.steps", "nan", "an integer"}},
    {"relief without heights",
     [](Scene& s) { s.materials[0].textures.erase("height"); },
     {"materials.stone.height", "nothing", "a texture"}},
    {"a search of layers without them",
     [](Scene& s) { s.materials[0].trace = stage("dual-depth-exact", ""); },
     {"materials.stone.layers", "nothing", "dual-depth-exact"}},
    {"a search of shells without their frame",
     [](Scene& s) { s.materials[0].trace = stage("prism-exact", ""); },
     {"materials.stone.relief.trace", "prism-exact", "frame-shell"}},
    {"a shell without a search of shells",
     [](Scene& s) { s.materials[0].frame = stage("frame-shell", ""); },
     {"materials.stone.relief.trace", "linear", "prism-exact or prism-pom"}},
    {"prisms with the search of tetrahedra",
     [](Scene& s) { shell_of(s).frame = stage("frame-prism", ""); },
     {"materials.stone.relief.trace", "prism-exact", "prism-gs"}},
    {"a search of prisms without their frame",
     [](Scene& s) { s.materials[0].trace = stage("prism-gs@published", ""); },
     {"materials.stone.relief.trace", "prism-gs@published", "frame-prism@published"}},
    {"prisms as listed below the mesh",
     [](Scene& s) {
         shell_of(s).frame = stage("frame-prism@published", "");
         s.materials[0].trace = stage("prism-gs@published", "");
     },
     {"materials.stone.relief.seat", "1", "0"}},
    {"a shadow through a shell that is none",
     [](Scene& s) { s.materials[0].shadow = stage("shadow-shell", ""); },
     {"materials.stone.relief.shadow", "shadow-shell", "frame-shell"}},
    {"a shell of a depth in tiles",
     [](Scene& s) { shell_of(s).depth_in_tiles = true; },
     {"materials.stone.relief.depth", "tiles", "world units"}},
    {"a shell that fades",
     [](Scene& s) { shell_of(s).fade_from = 30; },
     {"materials.stone.relief.grazing_fade", "fades", "one depth"}},
    {"a shell from within",
     [](Scene& s) { shell_of(s).cull = Cull::front; },
     {"materials.stone.cull", "front", "none or back"}},
    {"a shell clipped at its top",
     [](Scene& s) { shell_of(s).clip = stage("clip-path", ""); },
     {"materials.stone.relief.clip", "clip-path", "clip-uv"}},
    {"a shell with normals of faces",
     [](Scene& s) { shell_of(s).surface = stage("h2n-thesis", ""); },
     {"materials.stone.relief.surface", "h2n-thesis", "h2n-sobel"}},
    {"a shell over facets",
     [](Scene& s) {
         shell_of(s);
         for (Mesh& mesh : s.meshes) mesh.normals.clear();
     },
     {"materials.stone.relief.frame", "without vertex normals", "along which"}},
    {"noise for a stage that reads texels",
     [](Scene& s) { s.materials[0].noise = NoiseHeights(); },
     {"materials.stone.height", "noise", "h2n-thesis"}},
    {"too many lights", [](Scene& s) { s.lights.resize(9); }, {"lights", "9 lights", "at most 8"}},
};

struct BadOptions {
    const char* what;
    ChangeOptions change;
    const char* text;  ///< part of the message
};

const std::vector<BadOptions> bad_options = {
    {"an empty window",
     [](RenderOptions& o) {
         o.window = Window{2, 2, 2, 4};
     },
     "window 2,2,2,4"},
    {"a window turned round",
     [](RenderOptions& o) {
         o.window = Window{4, 4, 2, 2};
     },
     "window"},
    {"a window beyond the frame",
     [](RenderOptions& o) {
         o.window = Window{0, 0, 9, 6};
     },
     "0,0,8,6"},
    {"a window left of the frame",
     [](RenderOptions& o) {
         o.window = Window{-1, 0, 4, 4};
     },
     "window -1,0,4,4"},
    {"an odd tile", [](RenderOptions& o) { o.tile = 7; }, "tile size 7"},
    {"no tile", [](RenderOptions& o) { o.tile = 0; }, "tile size 0"},
    {"a huge tile", [](RenderOptions& o) { o.tile = 2048; }, "2 to 1024"},
    {"fewer threads than none", [](RenderOptions& o) { o.threads = -1; }, "threads"},
    {"an unknown instruction set", [](RenderOptions& o) { o.isa = "mmx"; }, "isa: found \"mmx\""},
    {"an unknown number type", [](RenderOptions& o) { o.number = "half"; },
     "number: found \"half\""},
    {"double on lanes", [](RenderOptions& o) { o.number = "double", o.isa = "sse4"; },
     "beside double, expected scalar"},
    {"an unknown channel", [](RenderOptions& o) { o.channels = {"hit.Q"}; },
     "channels: found \"hit.Q\""},
    {"the shadow of a light that is not there",
     [](RenderOptions& o) { o.channels = {"shadow.2.visibility"}; }, "\"shadow.2.visibility\""},
    {"the shadow of a light that cannot be",
     [](RenderOptions& o) { o.channels = {"shadow.8.steps"}; }, "at most 8 lights"},
};

testing::AssertionResult refuses(const Renderer& renderer, const BadScene& bad) {
    Scene scene = good_scene();
    scene.lights.resize(2);
    bad.change(scene);
    return complains([&] { take(renderer, scene); }, bad.complaint) << ": " << bad.what;
}

testing::AssertionResult refuses(const Renderer& renderer, const BadOptions& bad) {
    Scene scene = good_scene();
    scene.lights.resize(2);
    RenderOptions options;
    bad.change(options);
    try {
        renderer(scene, options);
    } catch (const UsageError& error) {
        if (std::string(error.what()).find(bad.text) != std::string::npos)
            return testing::AssertionSuccess();
        return testing::AssertionFailure() << bad.what << ": " << error.what();
    }
    return testing::AssertionFailure() << bad.what << " is accepted";
}

TEST(BadScene, IsRefused) {
    EXPECT_NO_THROW(take(render, good_scene()));
    for (const BadScene& bad : bad_scenes) EXPECT_TRUE(refuses(render, bad));
    for (const BadScene& bad : bad_scenes)
        EXPECT_FALSE(refuses(with(Planted::anything_goes), bad)) << bad.what;
}

TEST(BadOptions, AreRefused) {
    for (const BadOptions& bad : bad_options) EXPECT_TRUE(refuses(render, bad));
    for (const BadOptions& bad : bad_options)
        EXPECT_FALSE(refuses(with(Planted::anything_goes), bad)) << bad.what;
}

TEST(BadOptions, AnInstructionSetThatTheCpuLacksIsRefused) {
    for (const std::string& isa : isa_names()) {
        RenderOptions options;
        options.isa = isa;
        const auto built = built_isas();
        if (std::find(built.begin(), built.end(), isa) != built.end())
            EXPECT_NO_THROW(render(good_scene(), options)) << isa;
        else
            EXPECT_THROW(render(good_scene(), options), UsageError) << isa;
    }
}

/// Asked for when a scene has no light at all: dark, not an error, for the bare name.
TEST(NoLights, HaveNoShadow) {
    Scene scene = good_scene();
    const Film film = take(render, scene, {"A", "shadow.visibility", "R"});
    EXPECT_TRUE(everywhere(film, covered(film), [&](int x, int y) {
        return differs("visibility", value(film, "shadow.visibility", x, y), 0, 0);
    }));
}

}  // namespace
}  // namespace quadrel::render_tests
