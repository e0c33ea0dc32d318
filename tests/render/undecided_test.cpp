// What `undecided` says of coverage and of cells: edges that are moved, hits that may be in two.
#include <cmath>

#include "quadrel/film/presence.hpp"
#include "quadrel/num/range/context.hpp"
#include "quadrel/scene/load.hpp"
#include "quadrel/texture/image.hpp"
#include "render/films.hpp"

namespace quadrel::render_tests {
namespace {

constexpr double pixel = 2 * 2 * 0.36397 / 32;  // at the quad, two units away, of 40 degrees in 32

/// A quad whose edges run across the frame, moved by so many pixels.
Film turned_quad(double right, double up, const std::string& limits) {
    RenderOptions options;
    options.channels = {"A", "undecided"};
    options.limits = limits;
    return render(
        load_scene("rows/offset-limit",
                   {"size=[32,32]",
                    R"(camera={"type":"perspective","fov_y":40,"eye":[0,0,2],"target":[0,0,0]})",
                    fmt::format(R"(objects=[{{"mesh":{{"shape":"quad","size":1}},"transform":[
                                {{"rotate":20,"axis":[0,0,1]}},{{"translate":[{},{},0]}}]}}])",
                                right * pixel, up * pixel)}),
        options);
}

bool is_covered(const Film& film, std::size_t i) { return film.find("A")->as_float(i) > 0; }
bool has_bit(const Film& film, std::size_t i, std::uint32_t bit) {
    return (film.find("undecided")->bits[i] & bit) != 0;
}

/// Whether pixels that are lost where the quad moves by a quarter of a pixel are marked. Towards
/// its corners all edges move by more than towards its sides.
testing::AssertionResult marks_what_may_be_lost(const std::string& limits) {
    const Film film = turned_quad(0, 0, limits);
    int lost = 0, marked = 0, covered = 0;
    for (std::size_t i = 0; i < film.window.area(); ++i) {
        covered += is_covered(film, i);
        marked += has_bit(film, i, Undecided::coverage);
    }
    for (const double right : {-0.24, 0.24})
        for (const double up : {-0.24, 0.24}) {
            const Film moved = turned_quad(right, up, limits);
            for (std::size_t i = 0; i < film.window.area(); ++i) {
                if (!is_covered(film, i) || is_covered(moved, i)) continue;
                ++lost;
                if (!has_bit(film, i, Undecided::coverage))
                    return testing::AssertionFailure() << "pixel " << i << " is not marked";
            }
        }
    if (lost == 0 || marked * 4 > covered)
        return testing::AssertionFailure() << lost << " lost, " << marked << " of " << covered;
    return testing::AssertionSuccess();
}

TEST(Undecided, MarksCoverageThatSnappingMayChange) {
    EXPECT_TRUE(marks_what_may_be_lost("gl,snapping=0.25"));
    EXPECT_FALSE(marks_what_may_be_lost("gl,snapping=0.05"));
    EXPECT_FALSE(marks_what_may_be_lost("gl,snapping=0"));
}

/// Whether no pixel of the other kind is within two pixels.
bool is_inner(const Film& film, int x, int y) {
    const Window& w = film.window;
    const bool covered = is_covered(film, film.index(x, y));
    for (int v = std::max(y - 2, w.y0); v < std::min(y + 3, w.y1); ++v)
        for (int u = std::max(x - 2, w.x0); u < std::min(x + 3, w.x1); ++u)
            if (is_covered(film, film.index(u, v)) != covered) return false;
    return true;
}

/// Whether pixels are marked, and none else, that gain or lose what covers them where the quad
/// moves by a quarter of a pixel; its diagonal, of which both sides move together, is no edge.
/// `gained`: pixels that nothing covers count.
testing::AssertionResult marks_what_may_change(const std::string& limits, bool gained = true) {
    const Film film = turned_quad(0, 0, limits);
    int changed[2] = {};
    for (const double right : {-0.24, 0.24})
        for (const double up : {-0.24, 0.24}) {
            const Film moved = turned_quad(right, up, limits);
            for (std::size_t i = 0; i < film.window.area(); ++i) {
                const bool before = is_covered(film, i), after = is_covered(moved, i);
                if (before == after || (after && !gained)) continue;
                ++changed[after];
                if (!has_bit(film, i, undecided_presence))
                    return testing::AssertionFailure()
                           << "pixel " << i << (after ? " is gained" : " is lost");
            }
        }
    for (int y = 0; y < film.window.y1; ++y)
        for (int x = 0; x < film.window.x1; ++x)
            if (is_inner(film, x, y) && has_bit(film, film.index(x, y), undecided_presence))
                return testing::AssertionFailure() << x << "," << y << " is marked";
    return changed[0] > 0 && (changed[1] > 0 || !gained)
               ? testing::AssertionSuccess()
               : testing::AssertionFailure() << changed[0] << ", " << changed[1] << " change";
}

TEST(Undecided, MarksPixelsThatSnappingMayCoverOrNot) {
    EXPECT_TRUE(marks_what_may_change("gl,snapping=0.25"));
    EXPECT_FALSE(marks_what_may_change("gl,snapping=0.05"));
    EXPECT_FALSE(marks_what_may_change("gl,snapping=0"));
    EXPECT_FALSE(marks_what_may_change("gl,snapping=0", false));
}

/// Where a search clips what it discards: along the rims of bars, not in the holes between them.
TEST(Undecided, MarksDiscardedFragmentsWhereTheyMayBeKept) {
    RenderOptions options;
    options.channels = {"A", "undecided"};
    options.limits = "gl,snapping=0.0625";
    options.window = Window{12, 12, 24, 24};
    const Film film = render(load_scene("lattice", {"size=[40,40]"}), options);
    int marked[2] = {}, unmarked[2] = {};
    for (int y = 12; y < 24; ++y)
        for (int x = 12; x < 24; ++x) {
            const std::size_t i = film.index(x, y);
            const bool covered = is_covered(film, i), open = has_bit(film, i, undecided_presence);
            ++(open ? marked : unmarked)[covered];
            EXPECT_FALSE(open && is_inner(film, x, y)) << x << "," << y;
            EXPECT_TRUE(covered || (film.find("undecided")->bits[i] & ~undecided_presence) == 0);
        }
    EXPECT_GT(marked[0] + marked[1], 0);
    EXPECT_GT(unmarked[0], 0);
    EXPECT_GT(unmarked[1], 0);
}

/// Of hits whose range holds a border between cells those are marked, and no others; `shift`: the
/// bits of a pixel so far away.
testing::AssertionResult marks_cells(const Film& film, int texels, std::size_t shift = 0) {
    int open = 0, closed = 0;
    for (std::size_t i = 0; i + shift < film.window.area(); ++i) {
        if (!is_covered(film, i)) continue;
        bool crosses = false, close = false;
        for (const std::string axis : {"U", "V"}) {
            const double lo = film.find("gpu.lo.hit." + axis)->as_float(i) * double(texels) - 0.5,
                         hi = film.find("gpu.hi.hit." + axis)->as_float(i) * double(texels) - 0.5;
            if (!std::isfinite(lo) || !std::isfinite(hi)) crosses = true;
            crosses = crosses || std::floor(lo) != std::floor(hi);
            // Ends are rounded outwards in the film.
            for (const double end : {lo, hi})
                close = close || std::fabs(end - std::round(end)) < 1e-4;
        }
        if (close) continue;
        ++(crosses ? open : closed);
        if (has_bit(film, i + shift, Undecided::cell) != crosses)
            return testing::AssertionFailure() << "pixel " << i;
    }
    return open > 0 && closed > 0 ? testing::AssertionSuccess()
                                  : testing::AssertionFailure() << open << ", " << closed;
}

TEST(Undecided, MarksHitsThatMayBeInTwoCells) {
    RenderOptions options;
    options.channels = {"A", "hit.U", "hit.V", "undecided"};
    options.limits = "vulkan";
    options.window = Window{40, 40, 72, 64};
    const Scene scene = load_scene("rows/offset-limit");
    const Film film = render(scene, options);
    const Image map = load_image(scene.materials.front().textures.at("height").file);
    ASSERT_EQ(map.width, map.height);
    EXPECT_TRUE(marks_cells(film, map.width));
    EXPECT_FALSE(marks_cells(film, map.width, 1));
    EXPECT_FALSE(marks_cells(film, map.width / 2));
}

/// What float and double decide otherwise is marked, without any --limits: rounding alone has
/// flipped it. Unless `marks` no mark is looked at.
testing::AssertionResult marks_what_rounding_flips(const std::string& trace, bool marks = true) {
    // Far from the origin of the texture roundings are so large that some do flip.
    const Scene scene =
        load_scene("rows/linear", {"size=[128,128]", "material.relief.trace=" + trace,
                                   R"(material.texture_matrix={"offset":[300.3,0.7]})"});
    RenderOptions options;
    options.channels = {"A", "hit.status", "hit.steps", "hit.U", "hit.V", "undecided"};
    options.window = Window{8, 40, 120, 88};
    const Film drawn = render(scene, options);
    options.channels.pop_back();
    options.number = "double";
    const Film wide = render(scene, options);
    int flipped = 0, open = 0, covered = 0;
    for (std::size_t i = 0; i < drawn.window.area(); ++i) {
        if (!is_covered(drawn, i)) continue;
        ++covered;
        const bool marked = marks && drawn.find("undecided")->bits[i] != 0;
        open += marked;
        if (drawn.find("hit.steps")->bits[i] == wide.find("hit.steps")->bits[i] &&
            drawn.find("hit.status")->bits[i] == wide.find("hit.status")->bits[i])
            continue;
        ++flipped;
        if (!marked) return testing::AssertionFailure() << trace << ": pixel " << i;
    }
    if (flipped == 0 || open == covered)
        return testing::AssertionFailure()
               << trace << ": " << flipped << " flipped, " << open << " of " << covered;
    return testing::AssertionSuccess();
}

TEST(Undecided, MarksWhatRoundingAloneMayFlip) {
    EXPECT_TRUE(marks_what_rounding_flips("linear"));
    EXPECT_FALSE(marks_what_rounding_flips("linear", false));
}

/// A GPU may flip more than rounding does, and rounding alone has ranges, too.
TEST(Undecided, RoundingIsLessThanWhatAGpuMay) {
    RenderOptions options;
    options.channels = {"A", "undecided", "K.U", "hit.s"};
    options.window = Window{40, 40, 72, 64};
    const Scene scene = load_scene("rows/linear");
    options.limits = "rounding";
    const Film rounding = render(scene, options);
    options.limits = "gl";
    const Film gl = render(scene, options);
    options.limits = "";
    options.channels = {"A", "undecided"};
    const Film plain = render(scene, options);
    int fewer = 0;
    for (std::size_t i = 0; i < gl.window.area(); ++i) {
        const auto value = [&](const Film& film, const char* name) {
            return film.find(name)->as_float(i);
        };
        const std::uint32_t less = rounding.find("undecided")->bits[i],
                            more = gl.find("undecided")->bits[i];
        EXPECT_EQ(plain.find("undecided")->bits[i], less);
        EXPECT_EQ(less & ~more, 0u) << i;
        fewer += less != more;
        for (const char* name : {"K.U", "hit.s"}) {
            const std::string lo = std::string("gpu.lo.") + name,
                              hi = std::string("gpu.hi.") + name;
            EXPECT_LE(value(rounding, lo.c_str()), value(rounding, name)) << i;
            EXPECT_GE(value(rounding, hi.c_str()), value(rounding, name)) << i;
        }
        EXPECT_GE(value(rounding, "gpu.lo.K.U"), value(gl, "gpu.lo.K.U"));
        EXPECT_LE(value(rounding, "gpu.hi.K.U"), value(gl, "gpu.hi.K.U"));
    }
    EXPECT_GT(fewer, 0);
}

}  // namespace
}  // namespace quadrel::render_tests
