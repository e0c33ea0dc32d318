// Rendering into a film that held something: the same bits, in the same memory.
#include "render/films.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

using RenderInto = std::function<void(Film&, const Scene&, const RenderOptions&)>;

std::vector<const std::uint32_t*> memory_of(const Film& film) {
    std::vector<const std::uint32_t*> memory;
    for (const Plane& plane : film.planes) memory.push_back(plane.bits.data());
    return memory;
}

/// Frames one after another, of other objects, sizes, windows and channels, into one film.
testing::AssertionResult forgets_what_was_there(const RenderInto& into) {
    Scene all = varied_scene(), few = varied_scene(), small = varied_scene(4, Conventions::d3d, 22);
    few.objects.resize(1);
    few.background = {0.75f, 0.5f, 1, 0};
    RenderOptions standard, ids, window;
    ids.channels = {"id", "uv"};
    window.window = Window{3, 2, 20, 19};
    Film film;
    const std::pair<const Scene*, const RenderOptions*> frames[] = {
        {&all, &standard}, {&few, &standard}, {&few, &ids},
        {&small, &window}, {&all, &ids},      {&few, &window}};
    for (const auto& [scene, options] : frames) {
        into(film, *scene, *options);
        if (film != render(*scene, *options))
            return testing::AssertionFailure() << "frame " << scene->objects.size();
    }
    return testing::AssertionSuccess();
}

TEST(FilmMemory, HoldsNothingOfTheFrameBefore) { EXPECT_TRUE(forgets_what_was_there(render_into)); }

TEST(FilmMemory, IsUsedAgain) {
    const Scene scene = varied_scene();
    RenderOptions options;
    Film film;
    render_into(film, scene, options);
    const auto memory = memory_of(film);
    render_into(film, scene, options);
    EXPECT_EQ(memory_of(film), memory);
    options.window = Window{1, 2, 30, 20};
    render_into(film, scene, options);
    EXPECT_EQ(memory_of(film), memory) << "smaller planes fit, too";
}

TEST(FilmMemory, RemainsAreNoticed) {
    EXPECT_FALSE(forgets_what_was_there([](Film& film, const Scene& scene, const auto& options) {
        const Film old = film;
        film = render(scene, options);
        for (std::size_t p = 0; p < std::min(film.planes.size(), old.planes.size()); ++p)
            for (std::size_t i = 0; i < film.planes[p].bits.size(); ++i)
                if (film.planes[p].bits[i] == uncovered_bits(film.planes[p].name) &&
                    i < old.planes[p].bits.size())
                    film.planes[p].bits[i] = old.planes[p].bits[i];
    })) << "background left as it was";
    EXPECT_FALSE(forgets_what_was_there([](Film& film, const Scene& scene, const auto& options) {
        const Film fresh = render(scene, options);
        film.frame = fresh.frame;
        film.window = fresh.window;
        film.planes.resize(std::max(film.planes.size(), fresh.planes.size()));
        std::copy(fresh.planes.begin(), fresh.planes.end(), film.planes.begin());
    })) << "planes left over";
}

}  // namespace
}  // namespace quadrel::render_tests
