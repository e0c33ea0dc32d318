// Uses Quadrel as a library: renders a scene that was installed with it, and asks for a derivative.
#include <cstdio>

#include "quadrel/film/film.hpp"
#include "quadrel/render.hpp"
#include "quadrel/scene/load.hpp"
#include "quadrel/testing.hpp"

int main() {
    using namespace quadrel;
    RenderOptions options;
    options.channels = {"R", "G", "B", "A", "hit.U", "hit.V"};
    const Scene scene = load_scene("bricks-45", {"size=[16,16]"});
    const Film film = render(scene, options);
    const bool covered = film.find("A")->as_float(film.index(8, 8)) == 1.0f;

    const auto quad =
        unit::run_quad<Quad<float>>(4, 4, [](const auto& xy) { return xy.x * Quad<float>(0.25f); });
    const bool derived = quad.dFdx_fine(0) == 0.25f;
    std::printf("covered %d derived %d\n", covered, derived);
    return covered && derived ? 0 : 1;
}
