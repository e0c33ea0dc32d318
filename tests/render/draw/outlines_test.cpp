// Outlines of relief over curved surfaces, held against the same relief as geometry. Prints the
// table that data/scenes/README.md shows; its own pictures are smaller unless QUADREL_OUTLINE_SIZE
// says how large they are to be.
#include <fmt/format.h>

#include <cstdlib>
#include <map>

#include "quadrel/scene/load.hpp"
#include "render/planted.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

int picture_size() {
    const char* const asked = std::getenv("QUADREL_OUTLINE_SIZE");
    return asked != nullptr ? std::atoi(asked) : 96;
}

Film drawn_scene(const std::string& scene, std::vector<std::string> overrides) {
    const std::string size = std::to_string(picture_size());
    overrides.push_back("size=[" + size + "," + size + "]");
    return take(render, load_scene(scene, overrides), {"A", "Z"});
}

bool is_covered(const Film& film, int x, int y) { return value(film, "A", x, y) > 0; }

using Pixels = std::vector<glm::ivec2>;

/// Covered pixels next to one that is not.
Pixels outline(const Film& film) {
    Pixels pixels;
    const int size = picture_size();
    for (int y = 1; y + 1 < size; ++y)
        for (int x = 1; x + 1 < size; ++x) {
            const bool inside = is_covered(film, x - 1, y) && is_covered(film, x + 1, y) &&
                                is_covered(film, x, y - 1) && is_covered(film, x, y + 1);
            if (is_covered(film, x, y) && !inside) pixels.emplace_back(x, y);
        }
    return pixels;
}

/// From each of `from` to the nearest of `to`, in pixels.
std::vector<double> distances(const Pixels& from, const Pixels& to) {
    std::vector<double> all;
    for (const glm::ivec2& a : from) {
        double least = 1e9;
        for (const glm::ivec2& b : to) {
            const double x = a.x - b.x, y = a.y - b.y;
            least = std::min(least, x * x + y * y);
        }
        all.push_back(std::sqrt(least));
    }
    return all;
}

/// The value that `part` of all are at or below.
double quantile(std::vector<double> all, double part) {
    if (all.empty()) return 0;
    std::sort(all.begin(), all.end());
    return all[static_cast<std::size_t>(part * static_cast<double>(all.size() - 1))];
}

struct OutlineErrors {
    int coverage = 0;                 ///< pixels that one covers and the other does not
    double mean = 0, greatest = 0;    ///< between the outlines, both ways, pixels
    double z_median = 0, z_most = 0;  ///< difference in Z where both cover: median, 99th percentile
};

OutlineErrors outline_errors(const Film& truth, const Film& found) {
    OutlineErrors errors;
    std::vector<double> z;
    for (int y = 0; y < picture_size(); ++y)
        for (int x = 0; x < picture_size(); ++x) {
            const bool a = is_covered(truth, x, y), b = is_covered(found, x, y);
            errors.coverage += a != b;
            if (a && b) z.push_back(std::abs(value(truth, "Z", x, y) - value(found, "Z", x, y)));
        }
    const Pixels first = outline(truth), second = outline(found);
    std::vector<double> all = distances(first, second);
    for (const double d : distances(second, first)) all.push_back(d);
    for (const double d : all) errors.mean += d / static_cast<double>(all.size());
    errors.greatest = quantile(all, 1);
    errors.z_median = quantile(z, 0.5);
    errors.z_most = quantile(z, 0.99);
    return errors;
}

/// A way to draw the relief of a shape.
struct OutlineRow {
    const char* name;
    const char* trace;
    const char* split;
};
constexpr OutlineRow outline_rows[] = {
    {"linear", "linear", "orthogonal"},
    {"curved-quadric", "curved-quadric", "orthogonal"},
    {"curved-quadric, oblique", "curved-quadric", "oblique"},
    {"prism-free", "prism-free", "orthogonal"},
    {"prism-free, oblique", "prism-free", "oblique"},
};

OutlineErrors errors_of(const std::string& shape, const OutlineRow& row,
                        std::vector<std::string> more = {}) {
    static std::map<std::string, Film> truths;
    if (truths.count(shape) == 0)
        truths[shape] = drawn_scene("displaced-" + shape, {"objects[0].mesh.displace.cells=64"});
    more.push_back(
        fmt::format(R"(material.relief.frame={{"id":"frame-gram","split":"{}"}})", row.split));
    more.push_back(fmt::format("material.relief.trace={}", row.trace));
    return outline_errors(truths.at(shape), drawn_scene("curved-" + shape, more));
}

/// Rows over curved surfaces come much nearer to the outline than relief within the polygons, and
/// are as deep.
testing::AssertionResult comes_near(const std::string& shape, const OutlineRow& row,
                                    const std::vector<std::string>& flaw = {}) {
    const OutlineErrors within = errors_of(shape, outline_rows[0]);
    const OutlineErrors found = errors_of(shape, row, flaw);
    fmt::print("| {} | {} | {} | {:.2f} | {:.1f} | {:.4f} | {:.4f} |\n", shape, row.name,
               found.coverage, found.mean, found.greatest, found.z_median, found.z_most);
    if (3 * found.coverage <= within.coverage && found.z_most <= within.z_most)
        return testing::AssertionSuccess();
    return testing::AssertionFailure() << found.coverage << " pixels of " << within.coverage;
}

TEST(Outlines, OfCurvedReliefComeNearToThoseOfGeometry) {
    fmt::print("| shape | search | coverage | outline | greatest | Z | Z, 99 % |\n");
    for (const std::string shape : {"sphere", "torus"}) {
        EXPECT_FALSE(comes_near(shape, outline_rows[0]));
        for (std::size_t i = 1; i < std::size(outline_rows); ++i)
            EXPECT_TRUE(comes_near(shape, outline_rows[i]));
        EXPECT_FALSE(comes_near(shape, outline_rows[1], {"material.relief.depth=0.01"}));
        EXPECT_FALSE(comes_near(shape, outline_rows[3], {"material.relief.depth=0.01"}));
    }
}

}  // namespace
}  // namespace quadrel::render_tests
