// Uses Quadrel as a library: renders a scene that was installed with it, loads a plugin, draws a
// triangle, and asks for a derivative.
#include <cstdio>

#include "quadrel/film/film.hpp"
#include "quadrel/render.hpp"
#include "quadrel/scene/load.hpp"
#include "quadrel/shader.hpp"

using namespace quadrel;

/// Whether the middle of the installed scene is covered, and its colour one of those that `shade`
/// gives.
static bool renders(const char* shade, bool two_tones) {
    RenderOptions options;
    options.channels = {"R", "A", "hit.U"};
    const Scene scene =
        load_scene("bricks-45", {"size=[16,16]", std::string("material.shade=") + shade});
    const Film film = render(scene, options);
    const auto at = [&](const char* name) { return film.find(name)->as_float(film.index(8, 8)); };
    return at("A") == 1.0f && (at("R") == 0.0f || at("R") == 1.0f) == two_tones;
}

int main(int argc, char** argv) {
    using F = Quad<float>;
    const bool plain = renders("shade-thesis", false);
    if (argc > 1) load_plugin(argv[1]);
    const bool plugin = argc < 2 || renders("two-tones", true);

    const std::array<ShaderVertex<1>, 3> half{
        {{{-1, -1, 0, 1}, {0}}, {{1, -1, 0, 1}, {8}}, {{-1, 1, 0, 1}, {0}}}};
    const auto picture = draw_triangle<F>(
        {8, 8}, half, [](const auto& in) { return in.varying(0); }, -1.0f);
    const bool drawn = picture.at(2, 7) == 2.5f && picture.at(7, 0) == -1.0f;

    const auto quad = unit::run_quad<F>(4, 4, [](const auto& xy) { return xy.x * F(0.25f); });
    const bool derived = quad.dFdx_fine(0) == 0.25f;
    std::printf("plain %d plugin %d drawn %d derived %d\n", plain, plugin, drawn, derived);
    return plain && plugin && drawn && derived ? 0 : 1;
}
