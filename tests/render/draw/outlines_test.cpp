// Outlines of relief over curved surfaces, held against the same relief as geometry and in shells
// (prism-exact). Prints the tables that data/scenes/README.md shows, where QUADREL_OUTLINES is "256
// 256": how large pictures are, and the cells of the geometry. Its own are smaller.
#include <fmt/format.h>

#include <cstdlib>
#include <map>
#include <sstream>
#include <tuple>

#include "effort.hpp"
#include "quadrel/scene/load.hpp"
#include "render/planted.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

struct OutlineSettings {
    int size = test::sanitized ? 64 : 96;
    std::string cells = "48";
    std::vector<std::string> shapes{"sphere"};
    std::vector<int> facets{64};
};

const OutlineSettings& settings() {
    static const OutlineSettings all = [] {
        OutlineSettings made;
        if (!test::sanitized) made.shapes.emplace_back("torus");
        if (const char* const asked = std::getenv("QUADREL_OUTLINES")) {
            std::istringstream(asked) >> made.size >> made.cells;
            made.facets = {32, 128};
        }
        return made;
    }();
    return all;
}
int picture_size() { return settings().size; }

/// A sphere or a torus of so many facets around, both ways.
std::vector<std::string> with_facets(const std::string& shape, int facets) {
    std::vector<std::string> overrides;
    for (const char* key :
         shape == "sphere" ? std::array{"slices", "stacks"} : std::array{"sides", "rings"})
        overrides.push_back(fmt::format("objects[0].mesh.{}={}", key, facets));
    return overrides;
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

/// What outlines are held against.
enum class OutlineJudge { geometry, shell };

struct OutlineCase {
    std::string shape;
    int facets;
    std::string trace;
    std::vector<std::string> flaw{};
    OutlineJudge judge = OutlineJudge::geometry;
};

const Film& true_outlines(const OutlineCase& of) {
    static std::map<std::tuple<std::string, int, OutlineJudge>, Film> truths;
    const auto [truth, is_new] = truths.try_emplace({of.shape, of.facets, of.judge});
    if (!is_new) return truth->second;
    std::vector<std::string> overrides = with_facets(of.shape, of.facets);
    if (of.judge == OutlineJudge::geometry)
        overrides.push_back("objects[0].mesh.displace.cells=" + settings().cells);
    const std::string kind = of.judge == OutlineJudge::geometry ? "displaced-" : "silhouette-";
    return truth->second = drawn_scene(kind + of.shape, overrides);
}

OutlineErrors errors_of(const OutlineCase& of) {
    std::vector<std::string> overrides = with_facets(of.shape, of.facets);
    overrides.push_back("material.relief.trace=" + of.trace);
    overrides.insert(overrides.end(), of.flaw.begin(), of.flaw.end());
    return outline_errors(true_outlines(of), drawn_scene("curved-" + of.shape, overrides));
}

void print_row(const OutlineCase& of, const OutlineErrors& errors) {
    fmt::print("| {} | {} | {} | {} | {:.2f} | {:.1f} | {:.5f} | {:.4f} |\n", of.shape, of.facets,
               of.trace, errors.coverage, errors.mean, errors.greatest, errors.z_median,
               errors.z_most);
}

/// Far fewer pixels are wrongly covered, and outlines are nearer, than with relief that ends where
/// the polygons do; what both cover is no less deep.
testing::AssertionResult comes_near(const OutlineCase& of) {
    const OutlineErrors within = errors_of({of.shape, of.facets, "linear", {}, of.judge});
    const OutlineErrors found = errors_of(of);
    if (of.flaw.empty()) print_row(of, found);
    if (2 * found.coverage <= within.coverage && 2 * found.mean <= within.mean &&
        found.z_most <= within.z_most)
        return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << found.coverage << " pixels of " << within.coverage << ", outlines " << found.mean
           << " of " << within.mean << " apart, Z " << found.z_most << " of " << within.z_most;
}

void all_come_near(OutlineJudge judge) {
    fmt::print("| shape | facets | search | coverage | outline | greatest | Z | Z, 99 % |\n");
    for (const std::string& shape : settings().shapes)
        for (const int facets : settings().facets) {
            EXPECT_FALSE(comes_near({shape, facets, "linear", {}, judge}));
            for (const std::string trace : {"curved-quadric", "prism-free"})
                EXPECT_TRUE(comes_near({shape, facets, trace, {}, judge}))
                    << shape << ", " << trace;
        }
}

TEST(Outlines, OfCurvedReliefComeNearToThoseOfGeometry) { all_come_near(OutlineJudge::geometry); }

/// Of the searches' own surface, whose patches are bilinear.
TEST(Outlines, OfCurvedReliefComeNearToThoseOfShells) { all_come_near(OutlineJudge::shell); }

TEST(Outlines, AreMissedByWrongRelief) {
    for (const std::string trace : {"curved-quadric", "prism-free"})
        for (const char* flaw : {"material.relief.depth=0.01", "material.relief.depth=0.2"})
            EXPECT_FALSE(comes_near({"sphere", 64, trace, {flaw}})) << trace << ", " << flaw;
}

}  // namespace
}  // namespace quadrel::render_tests
