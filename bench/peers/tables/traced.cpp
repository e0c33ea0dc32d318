// Exact hits: max-mip beside rays that Embree traces, in turns.
#include <fmt/format.h>

#include "agreement.hpp"
#include "embree/embree.hpp"
#include "measure.hpp"
#include "tables/tables.hpp"

namespace quadrel::peers {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
/// Of depths in units of the relief's: flat triangles lie beside the bilinear patches, the more the
/// larger a texel is.
double depth_tolerance(const Run& run) { return 0.002 + 0.4 / run.options.map; }
/// Of pixels whose light one side sees and the other does not.
constexpr double light_tolerance = 0.02;
/// Of rays that go through between two triangles.
constexpr double miss_tolerance = 0.001;

struct Work {
    const char* name;
    const char* title;
    const char* shadow;
    bool shadows;
};

constexpr Work works[] = {{"hits", "max-mip; Embree: primary rays", "shadow-none", false},
                          {"hits-shadow", "max-mip, shadow-exact; Embree: primary and shadow rays",
                           "shadow-exact", true}};

std::string relief(const char* trace, const char* shadow) {
    return fmt::format(R"(material.relief={{"frame":"frame-gram","surface":"none","depth":0.05,)"
                       R"("trace":"{}","shadow":"{}"}})",
                       trace, shadow);
}

/// What Quadrel stores where Embree stores the distance.
std::vector<std::string> hit_channels(const Work& work) {
    std::vector<std::string> channels{"hit.U", "hit.V", "hit.s"};
    if (work.shadows) channels.emplace_back("shadow.visibility");
    return channels;
}

/// The picture, drawn once, and the milliseconds that its pyramid took, the height map being there.
struct Prepared {
    Picture picture;
    double pyramid;
};

Prepared prepare(const Run& run, const Work& work, double angle, int threads) {
    const auto scene = [&](const char* trace, const char* shadow) {
        return wall_scene(run.maps, angle, run.options.size, {relief(trace, shadow)});
    };
    // Of stages that need no pyramid.
    Picture plain(scene("texel-exact", "shadow-none"), run.options.isa, hit_channels(work));
    plain.draw(threads);
    Scene with_pyramid = scene("max-mip", work.shadow);
    with_pyramid.texture_cache = plain.scene().texture_cache;
    Picture picture(std::move(with_pyramid), run.options.isa, hit_channels(work));
    picture.draw(threads);
    const Time load = picture.load();
    return {std::move(picture), threads == 1 ? load.cpu : load.wall};
}

struct Traced {
    double quadrel = nothing, pyramid = nothing, embree = nothing, build = nothing,
           memory = nothing, difference = nothing;
    std::string way = "-";
};

void judge(Run& run, const Work& work, double angle, const Film& film, const EmbreeWall& wall,
           double difference) {
    const std::string place = fmt::format("{} at {} degrees: ", work.name, angle);
    run.judge(place + "Quadrel's depths and Embree's", difference, depth_tolerance(run));
    if (wall.missed() > miss_tolerance)
        run.disagreements.push_back(
            fmt::format("{}{:.3f} % of Embree's rays miss", place, 100 * wall.missed()));
    if (work.shadows && !run.options.planted)
        run.judge(place + "Quadrel's lights and Embree's",
                  mean_difference(*film.find("shadow.visibility"), wall.lit()), light_tolerance);
}

/// The least of all ways, with what that way built.
void take_best(const EmbreeWall& wall, const std::vector<LeastTime>& times, int threads,
               Traced& traced) {
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (traced.embree <= times[i].of(threads)) continue;
        const EmbreeWay& way = wall.ways()[i];
        traced.embree = times[i].of(threads);
        traced.build = threads == 1 ? way.build.cpu : way.build.wall;
        traced.memory = way.memory_mib;
        traced.way = way.name;
    }
}

Traced trace_in_turns(Run& run, const Work& work, double angle, int threads, EmbreeWall* wall) {
    Traced traced;
    auto [picture, pyramid] = prepare(run, work, angle, threads);
    traced.pyramid = pyramid;
    std::vector<LeastTime> times(wall != nullptr ? wall->ways().size() : 0);
    LeastTime quadrel;
    for (int i = 0; i < run.options.repeats; ++i) {
        quadrel.add(picture.draw(threads));
        for (std::size_t way = 0; way < times.size(); ++way)
            times[way].add(time_of([&] { wall->trace(way, work.shadows); }));
    }
    traced.quadrel = quadrel.of(threads);
    if (wall == nullptr) return traced;
    take_best(*wall, times, threads, traced);
    traced.difference = mean_difference(*picture.film().find("hit.s"), wall->depths());
    judge(run, work, angle, picture.film(), *wall, traced.difference);
    return traced;
}

/// The relief of max-mip, as rays of the frame's pixels meet it; of another depth where errors are
/// planted.
std::unique_ptr<EmbreeWall> wall_of(Run& run, double angle, int threads) {
    Scene scene = wall_scene(run.maps, angle, run.options.size, {relief("max-mip", "shadow-none")});
    if (run.options.planted) scene.materials.at(0).depth *= 1.2f;
    std::string why;
    auto wall = build_embree_wall(scene, threads, why);
    if (!wall) run.skip("Embree", why);
    return wall;
}

std::vector<Cell> cells(const Work& work, double angle, const Traced& t) {
    return {work.title,
            {angle, 0},
            {t.quadrel, 1},
            {t.pyramid, 1},
            {t.embree, 1},
            t.way,
            {t.build, 1},
            {t.memory, 1},
            {t.quadrel / t.embree, 2},
            {(t.quadrel + t.pyramid) / t.embree, 2},
            {t.difference, 5}};
}

std::string title(const Run& run, int threads) {
    return fmt::format(
        "Exact hits of {0}x{0} rays with a relief of {1}x{1} texels, {2}: least of {3}, "
        "milliseconds of {4}, a line for each angle. Embree 3, the best way of several; its build, "
        "and the pyramid that max-mip needs, come on top; difference: mean of the "
        "depths', in units of the relief's.",
        run.options.size, run.options.map, threads == 1 ? "one thread" : "two threads",
        run.options.repeats, threads == 1 ? "CPU time" : "wall time");
}

}  // namespace

Table traced_table(Run& run, int threads) {
    Table table;
    table.title = title(run, threads);
    table.columns = {"work",      "angle", "Quadrel", "pyramid",          "Embree",
                     "way",       "build", "MiB",     "Quadrel / Embree", "with pyramid / Embree",
                     "difference"};
    for (const double angle : run.options.angles) {
        const auto wall = wall_of(run, angle, threads);
        for (const Work& work : works)
            table.rows.push_back(
                cells(work, angle, trace_in_turns(run, work, angle, threads, wall.get())));
    }
    return table;
}

}  // namespace quadrel::peers
