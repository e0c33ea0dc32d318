// No ray takes for ever: what is asked for has an end, and what a listing leaves open gets one.
#include "effort.hpp"
#include "quadrel/error.hpp"
#include "quadrel/quad/value.hpp"
#include "quadrel/relief/registry.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"
#include "quadrel/stats.hpp"
#include "render/films.hpp"
#include "render/plan/shell_check.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

constexpr int map_texels = 16;
constexpr double quad_side = 40;  ///< of the quad, which is one tile before its matrix
/// Cells of an axis that a ray may pass (README.md, "Scenes").
constexpr double most_cells = 1 << 20;
/// Steps of a ray at most: some of every cell of both axes.
constexpr double most_steps_of_a_ray = 4 * most_cells;

bool counts_something(const ParameterText& parameter) {
    return parameter.integer && value_names(parameter).empty() &&
           std::string_view(parameter.name) != "seed";
}

StageChoice with_largest_counts(const std::string& id, const std::string& key) {
    StageChoice choice = stage(id, key);
    for (const ParameterText& parameter : find_stage(id)->parameters)
        if (counts_something(parameter)) choice.parameters[parameter.name] = parameter.maximum;
    return choice;
}

std::vector<std::string> ids_of(std::string_view room) {
    std::vector<std::string> ids;
    for (const StageInfo& info : all_stages())
        if (info.text.room == room) ids.emplace_back(info.text.id);
    return ids;
}

/// A quad of pixels whose rays pass about so many cells along one axis, over low heights: they go
/// nearly all the way.
Scene long_rays(double cells) {
    Scene scene = empty_scene(2, 2);
    set_perspective_camera(scene, {0.2, 0.3, 2.5}, {.near = 0.5, .far = 50});
    scene.lights = {directional_light({1, 0.4f, 0.4f})};
    scene.materials = {relief_material("relief", false)};
    Material& material = scene.materials[0];
    material.trace = stage("linear", material.trace.key);
    material.shadow = stage("none", material.shadow.key);
    material.textures["height"] =
        texture(write_texture("low.exr", map_texels,
                              [](int x, int y, int) { return 0.05 * noise(x, y, 5); }),
                "r");
    material.textures["height"].sampler.mip = MipFilter::none;
    material.textures["normal"] = noise_texture();
    // Two thin sheets with holes, through which most rays pass.
    material.textures["layers"] =
        texture(write_texture("sheets.exr", map_texels, [](int x, int y, int c) {
            return 0.4 + 0.4 * (c / 2) + (noise(x, y, 6) < 0.1 ? 1e-3 * (c % 2) : 0);
        }));
    material.textures["layers"].sampler.mip = MipFilter::none;
    // At 60 degrees a ray moves by 1.7 depths.
    const auto scale = static_cast<float>(cells * quad_side / (1.75 * material.depth * map_texels));
    material.texture_matrix = glm::mat4(1.0f);
    material.texture_matrix[0][0] = 0.25f * scale;
    material.texture_matrix[1][1] = scale;
    add_object(scene, make_quad(quad_side), 0, rotation(-60, {1, 0, 0}));
    return scene;
}

struct RayWork {
    double steps = 0;  ///< of a lane, trace and shadow
    std::uint32_t status = 0;
};

RayWork work_of(const Scene& scene) {
    RenderOptions options;
    RenderStats stats;
    options.threads = 1;
    options.stats = &stats;
    options.touched = true;
    options.channels = {"A", "hit.status", "hit.steps", "shadow.visibility"};
    const Film film = render(scene, options);
    EXPECT_GE(stats.covered_lanes, 1u);  // of four, less those that passed everything
    const double drawn = std::max<double>(static_cast<double>(stats.covered_lanes), 1);
    return {static_cast<double>(stats.trace_steps + stats.shadow_steps) / drawn,
            film.find("hit.status")->bits[0]};
}

bool judges(const std::string& id) { return id.find("oracle") != std::string::npos; }

/// Judges take a microsecond a step: they have shorter rays here.
double long_way(const std::string& id) { return judges(id) ? most_cells / 64 : 0.9 * most_cells; }

TEST(BoundedWork, EverySearchEnds) {
    if (test::sanitized) GTEST_SKIP() << "takes minutes under the sanitizers";
    double most = 0;
    for (const std::string& id : ids_of("trace")) {
        // No ray, and a rectangle of so many texels is refused; one tile in the middle of its card,
        // which is not in view here.
        if (id == "relief-prewarp" || id.starts_with("true-impostor")) continue;
        Scene scene = long_rays(long_way(id));
        Material& material = scene.materials[0];
        material.trace = with_largest_counts(id, "trace");
        if (is_of_shells(id)) {
            material.frame = stage(std::string(frame_of_search(id)), "frame");
            material.surface = stage("h2n-patch", "surface");
            if (id.ends_with("@published")) material.seat = 0;
        }
        SCOPED_TRACE(id);
        const RayWork work = work_of(scene);
        EXPECT_LE(work.steps, most_steps_of_a_ray);
        most = std::max(most, work.steps);
    }
    EXPECT_GT(most, 65536);  // the rays are as long as they are meant to be
}

TEST(BoundedWork, EveryShadowEnds) {
    if (test::sanitized) GTEST_SKIP() << "takes minutes under the sanitizers";
    for (const std::string& id : ids_of("shadow")) {
        Scene scene = long_rays(long_way(id));
        Material& material = scene.materials[0];
        material.shadow = with_largest_counts(id, "shadow");
        if (is_of_shells(id)) {
            material.frame = stage("frame-shell", "frame");
            material.trace = stage("prism-exact", "trace");
            material.surface = stage("h2n-patch", "surface");
        }
        EXPECT_LE(work_of(scene).steps, most_steps_of_a_ray) << id;
    }
}

/// Searches of cells do not begin with rays that pass more than they can tell apart, and say so.
TEST(BoundedWork, RaysOverTooManyCellsAreNotSearched) {
    for (const char* id : {"texel-exact", "max-mip", "qdm", "pyramid", "cone-cell", "rmq-leap",
                           "cone-robust-exact"}) {
        Scene scene = long_rays(8 * most_cells);
        scene.materials[0].trace = with_largest_counts(id, "trace");
        const RayWork work = work_of(scene);
        EXPECT_EQ(work.status, static_cast<std::uint32_t>(Status::cap)) << id;
        EXPECT_LE(work.steps, 2) << id;
        scene = long_rays(most_cells / 64);
        scene.materials[0].trace = with_largest_counts(id, "trace");
        EXPECT_NE(work_of(scene).status, static_cast<std::uint32_t>(Status::cap)) << id;
    }
}

/// Nothing that counts steps, rays or layers may be asked for without end.
TEST(BoundedWork, CountsHaveAnEnd) {
    int counts = 0;
    for (const StageInfo& info : all_stages())
        for (const ParameterText& parameter : info.parameters) {
            if (!counts_something(parameter)) continue;
            EXPECT_LE(parameter.maximum, most_steps) << info.text.id << ' ' << parameter.name;
            ++counts;
        }
    EXPECT_GT(counts, 40);
    Scene scene = long_rays(16);
    scene.materials[0].trace.parameters["steps"] = 1e9;
    EXPECT_THROW(work_of(scene), InputError);
}

}  // namespace
}  // namespace quadrel::render_tests
