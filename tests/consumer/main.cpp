// Uses Quadrel as a library: renders a scene that was installed with it, loads a plugin, draws a
// triangle, samples a texture of its own, shades a triangle with it, and asks for a derivative.
#include <cstdio>

#include "quadrel/compare.hpp"
#include "quadrel/error_pictures.hpp"
#include "quadrel/errors.hpp"
#include "quadrel/film/film.hpp"
#include "quadrel/film/preview.hpp"
#include "quadrel/prepare.hpp"
#include "quadrel/probe.hpp"
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

/// Four texels with a mip level of their mean, 0.5.
static std::shared_ptr<const Texture> checks() {
    Image image;
    image.width = image.height = 2;
    image.channels = 1;
    image.values = {0, 1, 1, 0};
    return make_texture(image);
}

/// A texture of one's own on plain floats and on quads, the level as a literal.
static bool samples() {
    const auto texels = checks();
    SamplerState sampler;
    sampler.mag = sampler.min = Filter::nearest;
    const SampledTexture t{texels->view(), sampler};
    const vec4<float> one = texture_lod<float>(t, {}, {0.75f, 0.25f}, 0.0f);
    const auto four = texture_lod(t, {}, vec2<Quad<float>>(0.75f, 0.25f), 1.0f);
    return one == vec4<float>(1, 0, 0, 1) && unit::lane_of(four, 3).x == 0.5f;
}

/// shade_triangle over a raster state of one's own: at a pixel a texel, and at half the size, where
/// the derivatives select the coarser level.
static bool shades() {
    using F = Quad<float>;
    const auto texels = checks();
    const SampledTexture t{texels->view(), {}};
    const std::array<ShaderVertex<2>, 3> triangle{
        {{{-1, -1, 0, 1}, {0, 0}}, {{3, -1, 0, 1}, {2, 0}}, {{-1, 3, 0, 1}, {0, 2}}}};
    const auto first = [&](int size) {
        const RasterState state = raster_state({size, size}, hardware_model(Hardware::exact));
        const auto quads = shade_triangle<F>(
            state, triangle, [&](const auto& in) { return texture(t, {}, in.varying2(0)).x; });
        return quads.at(0).covered(0) ? quads.at(0).result[0] : -1.0f;
    };
    return first(2) == 0 && first(1) == 0.5f;
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
    const bool sampled = samples(), shaded = shades();
    std::printf("plain %d plugin %d drawn %d derived %d sampled %d shaded %d\n", plain, plugin,
                drawn, derived, sampled, shaded);
    return plain && plugin && drawn && derived && sampled && shaded ? 0 : 1;
}
