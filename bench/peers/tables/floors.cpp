// How near a frame is to what its look-ups and its film alone take.
#include <fmt/format.h>

#include <cmath>

#include "floors/look_ups.hpp"
#include "measure.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/scene/load.hpp"
#include "quadrel/stats.hpp"
#include "quadrel/texture/texture_cache.hpp"
#include "rows.hpp"
#include "scene_maps.hpp"
#include "tables/tables.hpp"

namespace quadrel::peers {
namespace {

/// Look-ups of the frame with all shortcuts, millions.
struct LookUps {
    double heights = 0, others = 0;
};

LookUps look_ups_of(Picture& picture) {
    LookUps all;
    for (const auto& [kind, count] : picture.look_ups())
        (kind == "height" ? all.heights : all.others) += 1e-6 * static_cast<double>(count);
    return all;
}

std::shared_ptr<const Texture> map_of(const Scene& scene, const std::string& slot) {
    return load_map(scene, scene.materials.at(0).textures.at(slot));
}

/// Where the frame of a search meets the relief, and how it went there.
Places places_of(const Run& run, double angle) {
    const std::vector<std::string> channels{"hit.U",   "hit.V",   "K.U",     "K.V",
                                            "dUVdx.U", "dUVdx.V", "dUVdy.U", "dUVdy.V"};
    Picture picture(wall_scene(run.maps, angle, run.options.size, row_of("linear-256").overrides),
                    run.options.isa, channels);
    picture.draw(1);
    const Film& film = picture.film();
    std::vector<const Plane*> planes;
    for (const std::string& channel : channels) planes.push_back(film.find(channel));
    Places places;
    constexpr int tile = 64;
    const int side = run.options.size;
    const auto texels = static_cast<float>(map_of(picture.scene(), "color")->view().width[0]);
    const auto add = [&](int x, int y) {
        const auto value = [&](int i) {
            return planes[static_cast<std::size_t>(i)]->as_float(film.index(x, y));
        };
        places.u.push_back(value(0));
        places.v.push_back(value(1));
        places.du.push_back(value(2) / 256);
        places.dv.push_back(value(3) / 256);
        const float footprint =
            std::max(std::hypot(value(4), value(5)), std::hypot(value(6), value(7)));
        places.level.push_back(std::max(0.0f, std::log2(footprint * texels)));
    };
    for (int top = 0; top < side; top += tile)
        for (int left = 0; left < side; left += tile)
            for (int y = top; y < std::min(top + tile, side); ++y)
                for (int x = left; x < std::min(left + tile, side); ++x) add(x, y);
    return places;
}

}  // namespace

Table floor_table(Run& run) {
    const int repeats = run.options.repeats;
    Table table;
    table.title = fmt::format(
        "Drawing {0}x{0} pixels, one thread, least of {1}, milliseconds of CPU time; beside it the "
        "floor: the look-ups that the frame makes with all shortcuts, at what a loop of nothing "
        "but "
        "such look-ups takes at the places of the frame (heights bilinear by the widest gathers, "
        "all "
        "others as four channels between two levels), and writing the film.",
        run.options.size, repeats);
    table.columns = {"work",           "angle",       "height look-ups per pixel",
                     "others",         "ns a height", "ns an other",
                     "film",           "floor",       "drawing",
                     "drawing / floor"};
    for (const double angle : run.options.angles) {
        const Places places = places_of(run, angle);
        const Scene scene =
            wall_scene(run.maps, angle, run.options.size, row_of("linear-256").overrides);
        const auto pixels = static_cast<double>(places.u.size());
        const double height = height_look_up_ns(map_of(scene, "height")->view(), places, repeats);
        const double colour = colour_look_up_ns(map_of(scene, "color")->view(), places, repeats);
        const double film = 1e-6 * pixels * four_floats_ns(places.u.size(), repeats);
        for (const Row& row : drawn_rows()) {
            if (!chosen(run.options.rows, row.name)) continue;
            Picture picture = colour_picture(run, angle, row.overrides);
            const LookUps made = look_ups_of(picture);
            LeastTime drawing;
            for (int i = 0; i < repeats; ++i) drawing.add(picture.draw(1));
            const double floor = made.heights * height + made.others * colour + film;
            table.rows.push_back({row.title,
                                  {angle, 0},
                                  {1e6 * made.heights / pixels, 2},
                                  {1e6 * made.others / pixels, 2},
                                  {height, 2},
                                  {colour, 2},
                                  {film, 1},
                                  {floor, 1},
                                  {drawing.of(1), 1},
                                  {drawing.of(1) / floor, 2}});
        }
    }
    return table;
}

Table file_floor_table(Run& run) {
    Table table;
    table.title = fmt::format(
        "What a render to a file cannot do without, 1024x1024 pixels, one thread, least of {}, "
        "milliseconds of CPU time: loading (maps inflated, decoded, their levels made), drawing, "
        "packing the film with zip.",
        run.options.repeats);
    table.columns = {"scene", "loading", "drawing", "zip", "sum with zip", "with none"};
    for (const char* name : {"thesis-quad", "bricks-45"}) {
        LeastTime load, draw, none, zip;
        for (int i = 0; i < run.options.repeats; ++i) {
            Picture picture(
                load_scene(name, {run.options.quick ? "size=[64,64]" : "size=[1024,1024]"}),
                run.options.isa, {});
            draw.add(picture.draw(1));
            load.add(picture.load());
            const auto pack = [&](ExrCompression compression) {
                return time_of([&] { exr_bytes(picture.film(), {}, {compression, 1}); });
            };
            none.add(pack(ExrCompression::none));
            zip.add(pack(ExrCompression::zip));
        }
        const double rest = load.of(1) + draw.of(1);
        table.rows.push_back({name,
                              {load.of(1), 1},
                              {draw.of(1), 1},
                              {zip.of(1), 1},
                              {rest + zip.of(1), 1},
                              {rest + none.of(1), 1}});
    }
    return table;
}

}  // namespace quadrel::peers
