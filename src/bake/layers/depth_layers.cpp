#include "quadrel/bake/depth_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "bake/layers/crossings.hpp"
#include "quadrel/error.hpp"

namespace quadrel {
namespace {

/// Right, up and the way of depth, unit vectors.
struct Axes {
    glm::dvec3 right, up, towards;

    explicit Axes(const glm::dvec3& direction) : towards(unit(direction)) {
        const bool along_y = towards.x == 0 && towards.z == 0;
        right = unit(glm::cross(towards, along_y ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0)));
        up = glm::cross(right, towards);
    }
    glm::dvec3 of(const glm::vec3& p) const {
        const glm::dvec3 q(p);
        return {glm::dot(q, right), glm::dot(q, up), glm::dot(q, towards)};
    }

  private:
    static glm::dvec3 unit(const glm::dvec3& v) { return v / std::sqrt(glm::dot(v, v)); }
};

struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()}, high = -low;

    glm::dvec3 size() const { return high - low; }
    void take(const glm::dvec3& p) {
        for (int c = 0; c < 3; ++c) {
            low[c] = std::min(low[c], p[c]);
            high[c] = std::max(high[c], p[c]);
        }
    }
};

/// One solid under a texel's centre; none where it has no thickness.
struct Solid {
    float front = 1, back = 1;
    bool is_there() const { return front < back; }
    double middle() const { return (double(front) + double(back)) / 2; }
};

/// Those that are kept come first.
using TexelSolids = std::array<Solid, most_solids>;

/// The `kept` nearest solids of a texel; whether there are more.
bool solids_of(const std::vector<Crossing>& crossings, std::size_t kept, TexelSolids& solids) {
    int winding = 0;
    std::size_t count = 0;
    double front = 0;
    for (const Crossing& crossing : crossings) {
        const int before = winding;
        winding += crossing.winding;
        if (before == 0) front = crossing.depth;
        if (before == 0 || winding != 0) continue;
        const Solid solid{static_cast<float>(front), static_cast<float>(crossing.depth)};
        if (!solid.is_there()) continue;
        if (count < kept) solids[count] = solid;
        ++count;
    }
    return count > kept;
}

/// Where pairs that a texel lacks are closed: in the middle of those of its neighbours.
class Closing {
  public:
    Closing(const std::vector<TexelSolids>& texels, const DepthLayerOptions& options)
        : texels_(texels),
          width_(options.width),
          height_(options.height),
          pairs_(static_cast<std::size_t>(options.solids)) {}

    /// Sorted, as the pairs before and behind are.
    TexelSolids closed(int i, int j) const {
        TexelSolids solids = at(i, j);
        float above = 0;
        for (std::size_t pair = 0; pair < pairs_; ++pair) {
            Solid& solid = solids[pair];
            if (!solid.is_there())
                solid.front = solid.back = std::max(above, middle_beside(i, j, pair));
            above = solid.back;
        }
        return solids;
    }

  private:
    const TexelSolids& at(int i, int j) const {
        return texels_[static_cast<std::size_t>(j) * width_ + i];
    }
    float middle_beside(int i, int j, std::size_t pair) const {
        double sum = 0;
        int count = 0;
        for (int y = std::max(j - 1, 0); y <= std::min(j + 1, height_ - 1); ++y)
            for (int x = std::max(i - 1, 0); x <= std::min(i + 1, width_ - 1); ++x) {
                const Solid& solid = at(x, y)[pair];
                if (!solid.is_there()) continue;
                sum += solid.middle();
                ++count;
            }
        return count == 0 ? 1.0f : static_cast<float>(sum / count);
    }

    const std::vector<TexelSolids>& texels_;
    int width_, height_;
    std::size_t pairs_;
};

/// Maps of two solids each; a last one that is alone has nothing behind it.
Film film_of(const std::vector<TexelSolids>& texels, const DepthLayerOptions& options,
             const std::function<void(double)>& progress) {
    constexpr const char* prefixes[] = {"", "second.", "third."};
    Film film;
    film.frame = film.window = {0, 0, options.width, options.height};
    const int maps = (options.solids + 1) / 2;
    for (int map = 0; map < maps; ++map)
        for (const char* name : {"R", "G", "B", "A"})
            film.add(std::string(prefixes[map]) + name, ChannelType::float32);
    const Closing closing(texels, options);
    for (int j = 0; j < options.height; ++j) {
        progress(static_cast<double>(j) / options.height);
        for (int i = 0; i < options.width; ++i) {
            const TexelSolids solids = closing.closed(i, j);
            for (std::size_t c = 0; c < film.planes.size(); ++c) {
                const Solid& solid = solids[c / 2];
                film.planes[c].bits[film.index(i, j)] =
                    std::bit_cast<std::uint32_t>(c % 2 == 0 ? solid.front : solid.back);
            }
        }
    }
    return film;
}

}  // namespace

DepthLayers peel_depth_layers(const Mesh& mesh, const DepthLayerOptions& options) {
    const WeldedMesh welded = weld_closed(mesh);
    const Axes axes(options.towards);
    ProjectedMesh projected{{}, welded.triangles};
    Box box;
    for (const glm::vec3& position : welded.positions) {
        projected.positions.push_back(axes.of(position));
        box.take(projected.positions.back());
    }
    const glm::dvec3 size = box.size();
    const double longer = std::max(size.x, size.y);
    if (!(longer > 0) || !(size.z > 0))
        throw InputError(mesh.name, "", "a mesh that is flat, seen from there",
                         "one with a volume");
    DepthLayers layers;
    layers.tile = longer / (1 - 2 * options.margin);
    layers.thickness = size.z;
    const glm::dvec3 middle = (box.low + box.high) * 0.5;
    layers.middle = axes.right * middle.x + axes.up * middle.y + axes.towards * middle.z;
    for (glm::dvec3& p : projected.positions) {
        const glm::dvec3 from = p - box.low;
        p = {((from.x - size.x / 2) / layers.tile + 0.5) * options.width,
             ((from.y - size.y / 2) / layers.tile + 0.5) * options.height, from.z / size.z};
    }
    constexpr double crossed = 0.75;  // of the time, when all crossings are found
    const auto tell = [&](double share) {
        if (options.progress) options.progress(share);
    };
    const auto crossings = texel_crossings(projected, options.width, options.height,
                                           [&](double share) { tell(crossed * share); });
    std::vector<TexelSolids> texels(crossings.size());
    for (std::size_t t = 0; t < crossings.size(); ++t)
        layers.deeper +=
            solids_of(crossings[t], static_cast<std::size_t>(options.solids), texels[t]);
    layers.film =
        film_of(texels, options, [&](double share) { tell(crossed + (1 - crossed) * share); });
    return layers;
}

Attributes attributes_of(const DepthLayers& layers) {
    return {{"quadrel:bake.kind", "depth-layers"},
            {"quadrel:bake.tile", fmt::format("{}", layers.tile)},
            {"quadrel:bake.thickness", fmt::format("{}", layers.thickness)},
            {"quadrel:bake.middle",
             fmt::format("{} {} {}", layers.middle.x, layers.middle.y, layers.middle.z)}};
}

}  // namespace quadrel
