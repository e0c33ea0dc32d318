// Maps and meshes beside the wall of the other tables: Quadrel beside llvmpipe, and beside itself
// without shortcuts. All at 45 degrees.
#include <fmt/format.h>

#include <functional>

#include "agreement.hpp"
#include "llvmpipe/llvmpipe.hpp"
#include "maps.hpp"
#include "measure.hpp"
#include "tables/tables.hpp"

namespace quadrel::peers {
namespace {

constexpr double angle = 45, nothing = std::numeric_limits<double>::quiet_NaN();

/// The rows that are drawn.
std::vector<std::string> works(const Options& options) {
    if (options.quick) return {"linear-256"};
    std::vector<std::string> names{"plain", "linear-256", "relief-binary", "thesis-0.05",
                                   "max-mip"};
    std::erase_if(names, [&](const std::string& name) { return !chosen(options.rows, name); });
    return names;
}

/// What a row is drawn on.
struct Surface {
    std::string title;
    std::vector<std::string> overrides = {};  ///< of the picture's scene, after the row's
    /// What no override says.
    std::function<void(Scene&)> change = {};
    /// In the place of the run's; 0 by 0: these.
    glm::ivec2 wall = {0, 0};
    bool llvmpipe = true;  ///< whether llvmpipe draws it: one material, one mesh
    bool qdm = true;       ///< and QDM: sides are powers of two, and repeat
    /// Tolerance of the rows' times this: where each hit may be another's by a rounding.
    double tolerance = 1;
};

/// The wall with other heights.
Surface heights(const std::string& title, const std::string& kind, double tolerance) {
    return {.title = title,
            .overrides = {fmt::format("textures.height.file={}.exr", kind)},
            .tolerance = tolerance};
}

/// So many tiles in the frame: levels of detail above 3. The relief is as deep in tiles.
Surface minified(int tiles) {
    return {.title = fmt::format("bricks, {} tiles a side, heights with mip levels", tiles),
            .overrides = {"textures.height.mip=box", "textures.height.min=linear-mipmap-linear"},
            .change =
                [tiles](Scene& scene) {
                    Material& material = scene.materials[0];
                    material.texture_matrix[0][0] *= static_cast<float>(tiles);
                    material.texture_matrix[1][1] *= static_cast<float>(tiles);
                    material.depth /= static_cast<float>(tiles);
                },
            .tolerance = 10};
}

constexpr const char* teapot =
    R"(objects=[{"mesh":{"shape":"teapot","tessellation":16,"size":0.9},)"
    R"("transform":[{"rotate":30,"axis":[1,0,0]}]}])";

/// A wall of bricks, before it a teapot of spikes and a ball of noise.
constexpr const char* three_objects =
    R"(objects=[{"mesh":{"shape":"quad","size":2},"transform":[{"rotate":-45,"axis":[1,0,0]}]},)"
    R"({"mesh":{"shape":"teapot","tessellation":16,"size":0.5},)"
    R"("transform":[{"rotate":30,"axis":[1,0,0]},{"translate":[-0.2,0,1]}]},)"
    R"({"mesh":{"shape":"sphere","radius":0.2},"transform":[{"translate":[0.25,0.2,1]}]}])";

void give_materials(Scene& scene) {
    const char* const files[] = {"spikes.exr", "noise.exr"};
    for (std::size_t i = 1; i < 3; ++i) {
        Material material = scene.materials[0];
        material.name = files[i - 1];
        if (const auto height = material.textures.find("height"); height != material.textures.end())
            height->second.file.replace_filename(files[i - 1]);
        scene.materials.push_back(material);
        scene.objects.at(i).material = i;
    }
}

std::vector<Surface> surfaces() {
    return {
        {.title = "bricks, as in the other tables"},
        {.title = "bricks, 1000x600 texels", .wall = {1000, 600}, .qdm = false},
        {.title = "bricks, clamped",
         .overrides = {"textures.height.wrap=clamp-to-edge", "textures.color.wrap=clamp-to-edge",
                       "textures.gloss.wrap=clamp-to-edge"},
         .qdm = false},
        minified(16),
        minified(64),
        heights("spikes, one texel in 128", "spikes", 10),
        heights("white noise", "noise", 50),
        heights("checker of single texels", "checker", 50),
        {.title = "bricks on a teapot", .overrides = {teapot}},
        {.title = "three materials, three meshes",
         .overrides = {three_objects},
         .change = give_materials,
         .llvmpipe = false},
    };
}

/// Milliseconds, and how far the picture is from llvmpipe's.
struct Drawn {
    double quadrel = nothing, without = nothing, llvmpipe = nothing, difference = nothing;
};

class Turns {
  public:
    Turns(Run& run, Llvmpipe* llvmpipe, const Surface& surface)
        : run_(run), llvmpipe_(llvmpipe), surface_(surface) {
        if (surface.wall.x > 0) write_wall(folder_.path(), surface.wall * run.options.map / 1024);
    }

    Drawn draw(const Row& row) {
        Picture picture = picture_of(row.overrides), plain = picture_of(row.overrides, false);
        picture.draw(1);
        plain.draw(1);
        check_bits(row, picture.film(), plain.film());
        Drawn drawn;
        const auto frame = peer(row, picture.scene(), drawn);
        LeastTime quadrel, without, theirs;
        for (int i = 0; i < run_.options.repeats; ++i) {
            quadrel.add(picture.draw(1));
            without.add(plain.draw(1));
            if (frame) theirs.add(time_of([&] { frame->draw(); }));
        }
        drawn.quadrel = quadrel.of(1);
        drawn.without = without.of(1);
        if (frame) drawn.llvmpipe = theirs.of(1);
        return drawn;
    }

  private:
    Picture picture_of(std::vector<std::string> overrides, bool skip = true) const {
        const auto& maps = surface_.wall.x > 0 ? folder_.path() : run_.maps;
        overrides.insert(overrides.end(), surface_.overrides.begin(), surface_.overrides.end());
        Scene scene = wall_scene(maps, angle, run_.options.size, overrides);
        if (surface_.change) surface_.change(scene);
        return {std::move(scene), run_.options.isa, colour_channels, skip};
    }

    void check_bits(const Row& row, const Film& with, const Film& without) {
        for (std::size_t c = 0; c < with.planes.size(); ++c)
            if (with.planes[c].bits != without.planes[c].bits)
                run_.disagreements.push_back(fmt::format("{} on {}: shortcuts change {}", row.name,
                                                         surface_.title, with.planes[c].name));
    }

    /// llvmpipe's frame, judged; null where it has none.
    std::unique_ptr<ShadedFrame> peer(const Row& row, const Scene& scene, Drawn& drawn) {
        if (llvmpipe_ == nullptr || !surface_.llvmpipe) return nullptr;
        if (row.name == "max-mip" && !surface_.qdm) return nullptr;
        auto frame = llvmpipe_->frame(row, scene, {});
        frame->draw();
        Picture judged = picture_of(row.judged_overrides());
        judged.draw(1);
        drawn.difference = mean_difference(judged.film(), frame->read());
        run_.judge(
            fmt::format("{} on {}: Quadrel's picture and llvmpipe's", row.name, surface_.title),
            drawn.difference, row.tolerance * surface_.tolerance);
        return frame;
    }

    Run& run_;
    Llvmpipe* llvmpipe_;
    const Surface& surface_;
    TemporaryFolder folder_;
};

std::string title(const Run& run, const std::string& peer) {
    return fmt::format(
        "Drawing {0}x{0} pixels on other maps and meshes, at 45 degrees, one thread: least of {1} "
        "in "
        "turns, milliseconds of CPU time, of {2}. \"Without\": by --no-skip, with the same bits. "
        "The "
        "peer is {3}.",
        run.options.size, run.options.repeats, joined(works(run.options)), peer);
}

}  // namespace

Table other_map_table(Run& run) {
    std::string why;
    const auto llvmpipe = open_llvmpipe(1, why);
    if (!llvmpipe) run.skip("llvmpipe", why);
    for (const char* kind : {"spikes", "noise", "checker"})
        write_heights(run.maps / fmt::format("{}.exr", kind), kind, run.options.map);
    Table table;
    table.title = title(run, llvmpipe ? llvmpipe->description() : "missing: " + why);
    table.columns = {
        "maps",    "Quadrel", "without", "Quadrel / without", "llvmpipe", "Quadrel / llvmpipe",
        "imitated"};
    for (const Surface& surface : surfaces()) {
        Turns turns(run, llvmpipe.get(), surface);
        std::vector<double> ours, without, theirs, differences;
        for (const std::string& work : works(run.options)) {
            const Drawn drawn = turns.draw(row_of(work));
            ours.push_back(drawn.quadrel);
            without.push_back(drawn.without);
            theirs.push_back(drawn.llvmpipe);
            differences.push_back(drawn.difference);
        }
        table.rows.push_back({surface.title,
                              {ours, 1},
                              {without, 1},
                              {ratios(ours, without), 2},
                              {theirs, 1},
                              {ratios(ours, theirs), 2},
                              {differences, 6}});
    }
    return table;
}

}  // namespace quadrel::peers
