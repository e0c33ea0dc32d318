// Shortcuts of drawing, each alone and all together, against drawing without: on random scenes, in
// windows that cut quads, with any channels, samples, tiles and number types.
#include <random>

#include "raster/solid_tile.hpp"
#include "render/plan/prepared.hpp"
#include "render/planted.hpp"
#include "render/registry/added_stages.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

/// Renders with shortcuts, or with an error in the place of one.
using Draw = std::function<Film(const Scene&, const RenderOptions&, const Shortcuts&)>;

PreparedRender prepare(const Scene& scene, const RenderOptions& options,
                       const Shortcuts& shortcuts) {
    PreparedRender prepared = prepare_render(scene, options, select_kernels(options));
    prepared.plan.shortcuts = shortcuts;
    return prepared;
}

Film real_draw(const Scene& scene, const RenderOptions& options, const Shortcuts& shortcuts) {
    return draw(prepare(scene, options, shortcuts), options);
}

/// Numbers for one scene: the engine's own output, which is the same everywhere.
class Dice {
  public:
    explicit Dice(unsigned seed) : engine_(seed) {}
    int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }
    float between(float low, float high) {
        return low + (high - low) * static_cast<float>(below(1 << 20)) / (1 << 20);
    }

  private:
    std::mt19937 engine_;
};

/// Lit by the cosine; relief by one look-up. A chain of stages has it all.
Material matte_relief(const std::string& name) {
    Material material = relief_material(name, false);
    material.trace.id = "offset-limit";
    material.trace.parameters.clear();
    material.surface.id = "none";
    material.shadow.id = "none";
    material.shadow.parameters.clear();
    material.shade.id = "shade-lambert";
    return material;
}

/// Opaque, with holes, under relief, and one whose colour is no number, of unusual payload. Of
/// those under relief one has maps of two sizes, one is a chain but for its search, and one clips.
std::vector<Material> materials() {
    std::vector<Material> all{
        plain_material("plain", {0.25f, 0.5f, 1}),
        plain_material("holes", {1, 0.5f, 0.25f}),
        relief_material("relief", false),
        plain_material("undefined", glm::vec3(std::bit_cast<float>(0xffc54321u))),
        matte_relief("matte"),
        matte_relief("searched"),
        matte_relief("clipped"),
        plain_material("lit", {0.125f, 0.25f, 0.5f}),
        plain_material("unlit")};
    all[1].textures["color"] = holes_texture();
    all[1].discard_below = 0.5f;
    all[2].trace = stage("offset-limit", "materials.relief.relief.trace");
    all[2].shadow = stage("none", "materials.relief.relief.shadow");
    all[4].textures["color"] = texture(write_texture("smaller.exr", 8, noise));
    all[5].trace.id = "parallax";
    all[6].clip = stage("clip-uv", "materials.clipped.relief.clip");
    all[7].shade.id = "shade-lambert";
    all[7].textures["color"] = noise_texture();
    all[8].shade.id = "shade-texture";
    all[8].textures["color"] = noise_texture();
    return all;
}

/// A lamp and a sun.
std::vector<Light> lights() {
    std::vector<Light> all(2);
    all[0].position = {3, 4, 5};
    all[1].kind = Light::Kind::directional;
    all[1].position = {-0.6f, 0, 0.8f};
    return all;
}

/// A wall that fills tiles, triangles of all sizes before and behind it, and slivers.
Scene random_scene(unsigned seed) {
    Dice dice(seed);
    Scene scene = empty_scene(41 + dice.below(20), 33 + dice.below(20));
    scene.samples = seed % 4 == 3 ? 4 : 1;
    scene.centroid = seed % 8 == 7;
    scene.conventions = seed % 3 == 1 ? Conventions::d3d : Conventions::gl;
    if (seed % 2 == 0)
        set_pixel_camera(scene);
    else
        set_perspective_camera(scene, {1, 2, 22},
                               {.near = 0.5, .far = 60, .reversed_z = seed % 5 == 0});
    scene.materials = materials();
    if (seed % 3 != 0) scene.lights = lights();
    const auto material = [&] {
        return static_cast<std::size_t>(dice.below(static_cast<int>(scene.materials.size())));
    };
    const auto corner = [&](float reach) {
        return glm::vec3(dice.between(-reach, reach), dice.between(-reach, reach),
                         dice.between(-8.5f, -1.5f));
    };
    if (seed % 6 != 5)
        add_object(scene, rectangle(-30, -29, 31, 27, -5), seed % 6 == 4 ? 1 : material());
    for (int i = dice.below(5); i > 0; --i) {
        const glm::vec3 a = corner(25), b = corner(25), c = corner(25);
        add_object(scene, triangle(a, b, c), material());
        add_object(scene, triangle(a, b, a + 0.02f * (c - a)), material());
    }
    return scene;
}

RenderOptions random_options(const Scene& scene, unsigned seed) {
    Dice dice(seed + 1000);
    RenderOptions options;
    options.threads = 1;
    options.tile = 8 << dice.below(3);
    options.number = dice.below(4) == 0 ? "double" : "float";
    options.isa = dice.below(2) == 0 ? "scalar" : "auto";
    if (options.number == "double") options.isa = "auto";
    if (dice.below(3) == 0) options.channels = all_channels(scene);
    if (dice.below(3) == 1) options.channels = {"R", "id", "quad", "uv", "hit.status", "Z"};
    if (dice.below(3) != 0) {
        const int x = dice.below(20), y = dice.below(16);
        options.window = Window{x, y, x + 1 + dice.below(scene.width - x - 1),
                                y + 1 + dice.below(scene.height - y - 1)};
    }
    return options;
}

/// Tiles of the scene that one triangle alone fills.
int solid_tiles(const Scene& scene, const RenderOptions& options) {
    const PreparedRender prepared = prepare(scene, options, {});
    int solid = 0;
    for (const Tile& tile :
         bin_triangles(prepared.geometry, {0, 0, scene.width, scene.height}, options.tile)) {
        int touching = 0, filling = 0;
        for (const std::uint32_t t : tile.triangles) {
            const Cover cover =
                cover_of(prepared.geometry.triangles[t].screen, tile.rect, scene.samples);
            touching += cover != Cover::none;
            filling += cover == Cover::all;
        }
        solid += touching == 1 && filling == 1;
    }
    return solid;
}

constexpr unsigned scenes = 24;

testing::AssertionResult same_without(const Draw& draw, const Shortcuts& shortcuts) {
    for (unsigned seed = 0; seed < scenes; ++seed) {
        const Scene scene = random_scene(seed);
        const RenderOptions options = random_options(scene, seed);
        if (auto same =
                same_bits(real_draw(scene, options, no_shortcuts), draw(scene, options, shortcuts));
            !same)
            return same << ", scene " << seed;
    }
    return testing::AssertionSuccess();
}

constexpr bool Shortcuts::*all_shortcuts[] = {&Shortcuts::film_rows, &Shortcuts::edge_runs,
                                              &Shortcuts::solid_tiles, &Shortcuts::chains,
                                              &Shortcuts::shared_scales};

TEST(Shortcuts, KeepEveryBit) {
    EXPECT_TRUE(same_without(real_draw, {}));
    for (const auto shortcut : all_shortcuts) {
        Shortcuts alone = no_shortcuts;
        alone.*shortcut = true;
        EXPECT_TRUE(same_without(real_draw, alone));
    }
}

TEST(Shortcuts, AreTakenByTheseScenes) {
    int solid = 0, with_others = 0;
    for (unsigned seed = 0; seed < scenes; ++seed) {
        const Scene scene = random_scene(seed);
        const int tiles = solid_tiles(scene, random_options(scene, seed));
        solid += tiles;
        with_others += tiles > 0 && scene.objects.size() > 1;
    }
    EXPECT_GT(solid, 100);
    EXPECT_GT(with_others, 5);
}

TEST(Shortcuts, RendersWithoutSkippingTakeNone) {
    const Scene scene = random_scene(0);
    RenderOptions options = random_options(scene, 0);
    for (const bool skip : {true, false}) {
        options.skip = skip;
        const Shortcuts s = plan_render(scene, options, select_kernels(options)).plan.shortcuts;
        for (const auto shortcut : all_shortcuts) EXPECT_EQ(s.*shortcut, skip);
    }
}

/// What a shortcut would draw that looks away from something in the scene.
Draw blind_to(const std::function<void(Scene&)>& change) {
    return [change](Scene scene, const RenderOptions& options, const Shortcuts& shortcuts) {
        change(scene);
        return real_draw(scene, options, shortcuts);
    };
}

/// The film with its planes changed.
Draw damaged(const std::function<void(Film&, const Scene&)>& change) {
    return [change](const Scene& scene, const RenderOptions& options, const Shortcuts& shortcuts) {
        Film film = real_draw(scene, options, shortcuts);
        change(film, scene);
        return film;
    };
}

/// Every plane's bits at (x, y) become those at (x ^ dx, y ^ dy), where the window has them.
void exchange(Film& film, int dx, int dy) {
    const Film old = film;
    const Window& w = film.window;
    for (std::size_t p = 0; p < film.planes.size(); ++p)
        for (int y = w.y0; y < w.y1; ++y)
            for (int x = w.x0; x < w.x1; ++x)
                if (contains(w, {x ^ dx, y ^ dy, (x ^ dx) + 1, (y ^ dy) + 1}))
                    film.planes[p].bits[film.index(x, y)] =
                        old.planes[p].bits[film.index(x ^ dx, y ^ dy)];
}

/// Draws with the plan of each material changed, if chains are taken.
Draw with_chains(const std::function<void(MaterialPlan&)>& change) {
    return [change](const Scene& scene, const RenderOptions& options, const Shortcuts& shortcuts) {
        PreparedRender prepared = prepare(scene, options, shortcuts);
        for (MaterialPlan& plan : prepared.plan.materials)
            if (shortcuts.chains && !plan.chains.empty()) change(plan);
        return draw(prepared, options);
    };
}

TEST(Shortcuts, ErrorsAreNoticed) {
    const Draw errors[] = {
        with_chains([](MaterialPlan& plan) {
            plan.in_arrays.reset(static_cast<std::size_t>(Value::color));
        }),
        with_chains([](MaterialPlan& plan) { plan.chains[0].end = plan.stages.size(); }),
        blind_to([](Scene& scene) { scene.materials[1].discard_below = -1; }),
        blind_to([](Scene& scene) {
            scene.objects.resize(std::min<std::size_t>(scene.objects.size(), 1));
        }),
        blind_to([](Scene& scene) { scene.samples = 1; }),
        blind_to([](Scene& scene) { scene.centroid = false; }),
        blind_to([](Scene& scene) { scene.camera.reversed_z = false; }),
        damaged([](Film& film, const Scene&) { exchange(film, 1, 0); }),
        damaged([](Film& film, const Scene&) { exchange(film, 0, 1); }),
        damaged([](Film& film, const Scene&) {
            for (Plane& plane : film.planes)
                for (std::uint32_t& bits : plane.bits)
                    if (plane.type == ChannelType::float32 && bits == canonical_nan)
                        bits = 0xffc54321u;
        }),
        damaged([](Film& film, const Scene& scene) {  // a column of quads that the window cuts
            if (film.window.x0 % 2 == 0 || scene.samples > 1) return;
            for (Plane& plane : film.planes)
                for (int y = film.window.y0; y < film.window.y1; ++y)
                    plane.bits[film.index(film.window.x0, y)] = 0;
        }),
    };
    for (const Draw& error : errors)
        EXPECT_FALSE(same_without(error, {})) << "error " << &error - errors;
}

}  // namespace
}  // namespace quadrel::render_tests
