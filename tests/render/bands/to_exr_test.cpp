// Files that are written while their image is drawn: the very bytes of drawing first and writing
// then, for whatever is drawn.
#include "quadrel/stats.hpp"
#include "render/bands/joined.hpp"

namespace quadrel::render_tests {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;
using testing_films::file_bytes;
using testing_films::TemporaryFolder;

using ToExr = std::function<void(const std::filesystem::path&, const Scene&, const RenderOptions&,
                                 ExrCompression)>;

void film_to_exr(const std::filesystem::path& file, const Scene& scene, const Film& film,
                 const RenderOptions& options, ExrCompression compression) {
    const auto named = render_attributes(scene, options);
    write_exr(file, film, Attributes(named.begin(), named.end()), {compression, options.threads});
}

/// `film` is what `render` gives.
AssertionResult writes_these_bytes(const ToExr& to_exr, const Scene& scene, const Film& film,
                                   RenderOptions options, ExrCompression compression) {
    const TemporaryFolder folder;
    film_to_exr(folder / "expected.exr", scene, film, options, compression);
    const std::string expected = file_bytes(folder / "expected.exr");
    // Who draws does not know how it will be packed: one thread beside two once.
    const int least = compression == ExrCompression::zip ? 1 : 2;
    for (int threads = least; threads <= 2; ++threads) {
        options.threads = threads;
        to_exr(folder / "found.exr", scene, options, compression);
        if (file_bytes(folder / "found.exr") != expected)
            return AssertionFailure()
                   << scene.height << " rows, " << scene.samples << " samples, tiles of "
                   << options.tile << ", compression " << static_cast<int>(compression) << ", "
                   << threads << " threads";
    }
    return AssertionSuccess();
}

/// Several bands each, the first and last of which are not whole; windows that begin and end within
/// tiles and quads; both directions of rows.
AssertionResult writes_what_is_drawn(const ToExr& to_exr) {
    RenderOptions standard, window, narrow, large;
    window.window = Window{3, 7, 30, 148};
    window.channels = {"uv", "N", "id", "hit.steps"};
    narrow.window = Window{20, 65, 21, 66};
    narrow.tile = 6;
    large.tile = 100;
    large.channels = {"depth", "R", "quad"};
    const auto all = [&](const Scene& scene, const RenderOptions& options) {
        const Film film = render(scene, options);
        for (const auto& [name, compression] : exr_compressions)
            if (auto result = writes_these_bytes(to_exr, scene, film, options, compression);
                !result)
                return result;
        return AssertionSuccess();
    };
    for (const auto conventions : {Conventions::gl, Conventions::vulkan})
        for (const RenderOptions* options : {&standard, &window, &narrow, &large})
            if (auto result = all(varied_scene(1, conventions, 37, 151), *options); !result)
                return result;
    for (const RenderOptions* options : {&standard, &window})
        if (auto result = all(varied_scene(4, Conventions::gl, 37, 151), *options); !result)
            return result;
    return all(varied_scene(1, Conventions::d3d, 31, 1), standard);
}

TEST(RenderToExr, WritesTheBytesOfDrawingAndThenWriting) {
    EXPECT_TRUE(writes_what_is_drawn(render_to_exr));
}

/// render_to_exr with an error in its film.
template <class Change>
ToExr with_error(const Change& change) {
    return [change](const auto& file, const Scene& scene, const RenderOptions& options,
                    ExrCompression compression) {
        Film film = joined_bands(scene, options);
        change(film);
        film_to_exr(file, scene, film, options, compression);
    };
}

TEST(RenderToExr, ErrorsAreNoticed) {
    ASSERT_TRUE(writes_what_is_drawn(with_error([](Film&) {})));
    EXPECT_FALSE(writes_what_is_drawn(with_error([](Film& film) {
        if (film.window.height() <= 64) return;
        for (Plane& plane : film.planes) {
            const auto row = plane.bits.begin() + 63 * film.window.width();
            std::copy_n(row, film.window.width(), row + film.window.width());
        }
    }))) << "a row of another band";
    EXPECT_FALSE(writes_what_is_drawn(with_error([](Film& film) {
        film.planes.back().bits.back() ^= 1;
    }))) << "one bit";
    EXPECT_FALSE(writes_what_is_drawn([](const auto& file, const Scene& scene,
                                         const RenderOptions& options, ExrCompression) {
        render_to_exr(file, scene, options, ExrCompression::zip);
    })) << "another compression";
}

/// What does not depend on the machine. Look-ups of stages are those that were made, which may
/// differ.
std::string counts_of(RenderStats stats) {
    for (PhaseTime* phase : {&stats.plan, &stats.load, &stats.draw, &stats.mark}) *phase = {};
    for (StageStats& stage : stats.stages) {
        stage.wall_ms = stage.cpu_ms = 0;
        stage.fetches = 0;
    }
    stats.peak_memory_kib = 0;
    stats.maxima = {};  // made by the first render of a scene
    return to_json(stats);
}

TEST(RenderToExr, CountsAsARenderDoes) {
    const TemporaryFolder folder;
    const Scene scene = varied_scene(4, Conventions::gl, 37, 151);
    for (const int tile : {64, 6}) {
        RenderOptions options;
        options.tile = tile;
        options.touched = true;
        RenderStats drawn, written;
        RenderSummary drawn_summary, written_summary;
        options.stats = &drawn;
        options.summary = &drawn_summary;
        render(scene, options);
        options.stats = &written;
        options.summary = &written_summary;
        render_to_exr(folder / "a.exr", scene, options);
        EXPECT_EQ(counts_of(drawn), counts_of(written));
        EXPECT_EQ(drawn_summary.covered, written_summary.covered);
        EXPECT_EQ(drawn_summary.pixels, written_summary.pixels);
    }
}

TEST(RenderToExr, NothingIsLeftOfWhatFails) {
    const TemporaryFolder folder;
    const Scene scene = varied_scene(1, Conventions::gl, 37, 400);
    RenderOptions options;
    options.progress = [](double done) {
        if (done > 0.5) throw std::out_of_range("enough");
    };
    EXPECT_THROW(render_to_exr(folder / "a.exr", scene, options), std::out_of_range);
    EXPECT_EQ(folder.count(), 0u);
}

}  // namespace
}  // namespace quadrel::render_tests
