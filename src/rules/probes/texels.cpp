// Texels: weights by format, boundaries, the order of a gather, and coordinates that no float has
// fractions for.
#include <algorithm>
#include <limits>

#include "quadrel/texture/sampler.hpp"
#include "rules/probes/inputs.hpp"

namespace quadrel::rules {
namespace {

/// texture of level 0 at (asked.x, asked.y).
void look_up(Question& question) {
    question.glsl = "    return vec4(textureLod(map0, asked.xy, 0.0).x, 0.0, 0.0, 1.0);";
    question.text = [](const QuadInput& in) {
        const vec2<QuadF> uv(in.asked.x, in.asked.y);
        return vec4<QuadF>(texture_lod(in.maps[0], {}, uv, QuadF(0)).x, QuadF(0), QuadF(0),
                           QuadF(1));
    };
}

Probe weights(const std::string& name, TexelFormat format) {
    Probe probe{"weights-" + name,
                "how finely a linear filter weighs two texels of " + name,
                "left open (OpenGL 4.6, 8.14.3); Vulkan: 4 bits at least, Direct3D 11.3, 7.18.8: 8",
                {fine_side, fine_side}};
    probe.question.asked = ask_pixels(fine_side, fine_side, [](int i) {
        return std::array<float, 4>{0.25f + static_cast<float>(i) / (2 * fine_side * fine_side),
                                    0.5f};
    });
    ProbeTexture map;
    map.format = format;
    map.channels = name.find("RGB") == std::string::npos ? 1 : 4;
    map.width = 2;
    map.levels = {map.channels == 1 ? std::vector<float>{0, 1}
                                    : std::vector<float>{0, 0, 0, 1, 1, 1, 1, 1}};
    map.sampler.wrap_u = map.sampler.wrap_v = Wrap::clamp_to_edge;
    probe.question.maps = {map};
    look_up(probe.question);
    probe.tolerance = 0x1p-16;
    probe.words = bits_words;
    // llvmpipe does so where both wrap modes are repeat or clamp-to-edge.
    if (format == TexelFormat::unorm8)
        probe.not_modelled = "weights and results of 8 bits, for textures of 8 bits alone";
    return probe;
}

/// Three texels: not by powers of two alone does a coordinate become one of texels.
Probe wrap_order() {
    Probe probe{"wrap-order",
                "whether a large coordinate is wrapped before it is scaled, 3 texels",
                "scaled first, of no stated precision (OpenGL 4.6, 8.14.2)",
                {16, 16}};
    Random random(9);
    probe.question.asked = ask_pixels(16, 16, [&](int) {
        return std::array<float, 4>{random.in(-5000, 5000), 0.5f};
    });
    ProbeTexture map;
    map.width = 3;
    map.levels = {{0, 1, 4}};
    probe.question.maps = {map};
    look_up(probe.question);
    probe.tolerance = 0x1p-16;
    probe.words = [asked = probe.question.asked](const Values& values) -> std::string {
        double worst = 0;
        for (std::size_t i = 0; i < asked.size(); ++i) {
            const double u = double(asked[i][0]), texel = 3 * (u - std::floor(u)) - 0.5;
            const double base = std::floor(texel), texels[] = {4, 0, 1, 4, 0};
            const int first = static_cast<int>(base) + 1;
            const double exact =
                texels[first] + (texel - base) * (texels[first + 1] - texels[first]);
            worst = std::max(worst, std::fabs(double(answer(values, i)) - exact));
        }
        return worst < 0x1p-16 ? "wrapped first" : fmt::format("off by up to {:.1g}", worst);
    };
    return probe;
}

/// A row of texels that are their own numbers.
ProbeTexture numbered_texels(int width, Wrap wrap) {
    ProbeTexture map;
    map.width = width;
    map.levels.emplace_back();
    for (int i = 0; i < width; ++i) map.levels[0].push_back(static_cast<float>(i));
    map.sampler.mag = map.sampler.min = Filter::nearest;
    map.sampler.wrap_u = map.sampler.wrap_v = wrap;
    return map;
}

/// Within 1/64 texel of the boundary between texels 3 and 4 of 8.
Probe texel_boundary() {
    constexpr int steps = 256;
    Probe probe{
        "nearest-texel",
        "where one texel gives way to the next, nearest filter",
        "floor(u) of infinite precision (OpenGL 4.6, 8.14.2); Direct3D 11.3, 7.18.8: of 8 bits",
        {steps, 2}};
    probe.question.asked = ask_pixels(steps, 2, [](int i) {
        return std::array<float, 4>{0.5f + static_cast<float>(i % steps - steps / 2) / (1 << 16),
                                    0.5f};
    });
    probe.question.maps = {numbered_texels(8, Wrap::repeat)};
    look_up(probe.question);
    probe.words = [](const Values& values) -> std::string {
        int first = 0;
        while (first < steps && answer(values, static_cast<std::size_t>(first)) == 3) ++first;
        const int early = steps / 2 - first;  // in 1/2^13 texel
        return early == 0 ? "exact" : fmt::format("{:+} / 8192 texel", -early);
    };
    return probe;
}

Probe gather() {
    Probe probe{"gather",
                "the order of textureGather's texels",
                "i0j1 i1j1 i1j0 i0j0 (GLSL 4.60, 8.9.4)",
                {16, 16}};
    probe.question.version = 40;
    Random random(3);
    probe.question.asked = ask_pixels(16, 16, [&](int) {
        return std::array<float, 4>{random.in(-1, 2), random.in(-1, 2)};
    });
    probe.question.asked[0] = {0.5f, 0.5f};
    ProbeTexture map = numbered_texels(16, Wrap::repeat);
    map.width = map.height = 4;
    map.sampler.mag = map.sampler.min = Filter::linear;
    probe.question.maps = {map};
    probe.question.glsl = "    return textureGather(map0, asked.xy);";
    probe.question.text = [](const QuadInput& in) {
        return texture_gather(in.maps[0], {}, vec2<QuadF>(in.asked.x, in.asked.y));
    };
    probe.words = [](const Values& values) {
        return fmt::format("{:g} {:g} {:g} {:g}", values[0], values[1], values[2], values[3]);
    };
    probe.legal = [words = probe.words](const Values& values) {
        return words(values) == "9 10 6 5";
    };
    return probe;
}

/// The texel, of 2, at u by exact arithmetic.
int exact_texel(double u, Wrap wrap) {
    const double index = std::floor(2 * u), period = wrap == Wrap::repeat ? 2 : 4;
    const int within = static_cast<int>(index - period * std::floor(index / period));
    return within < 2 ? within : 3 - within;
}

/// u of both signs: middles of texels, as long as there are such floats.
Probe large_coordinates(const std::string& name, Wrap wrap) {
    constexpr int exponents = 23;
    Probe probe{"wrap-" + name,
                "up to which coordinate the right one of 2 texels is taken, " + name,
                "the formula, of no stated precision (OpenGL 4.6, 8.14.2)",
                {32, exponents}};
    Random random(4);
    probe.question.asked = ask_pixels(32, exponents, [&](int i) {
        const double whole = std::floor(std::ldexp(1 + double(random.in(0, 1)), i / 32 - 1));
        const double u = whole + 0.25 + 0.5 * double(random.bits() % 2);
        return std::array<float, 4>{static_cast<float>((i & 1) != 0 ? -u : u), 0.5f};
    });
    probe.question.maps = {numbered_texels(2, wrap)};
    look_up(probe.question);
    probe.words = [asked = probe.question.asked, wrap](const Values& values) {
        std::size_t right = 0;
        while (right < asked.size() &&
               answer(values, right) == float(exact_texel(double(asked[right][0]), wrap)))
            ++right;
        return fmt::format("to 2^{}", static_cast<int>(right) / 32 - 1);
    };
    return probe;
}

/// At boundaries between texels and between copies: -2, -1.875, ..., 1.875.
Probe boundaries(const std::string& name, Wrap wrap) {
    Probe probe{"boundary-" + name,
                "the texel, of 4, at the boundaries from -1 to 0, " + name,
                "floor, then the wrap mode's formula (OpenGL 4.6, 8.14.2)",
                {32, 1}};
    probe.question.asked = ask_pixels(32, 1, [](int i) {
        return std::array<float, 4>{static_cast<float>(i - 16) / 8, 0.5f};
    });
    probe.question.maps = {numbered_texels(4, wrap)};
    probe.not_modelled = "texels at a boundary are those of the formula";
    look_up(probe.question);
    probe.words = [](const Values& values) {
        return fmt::format("{:g} {:g} {:g} {:g} {:g}", answer(values, 8), answer(values, 10),
                           answer(values, 12), answer(values, 14), answer(values, 16));
    };
    return probe;
}

Probe no_numbers() {
    Probe probe{"coordinates-nan",
                "the texel, of 8, at NaN, inf, -inf: repeat, then clamp to edge",
                "anything (OpenGL 4.6, 2.3.4.1)",
                {4, 1}};
    constexpr float infinity = std::numeric_limits<float>::infinity();
    probe.question.asked = {{std::nanf("")}, {infinity}, {-infinity}, {0}};
    probe.question.maps = {numbered_texels(8, Wrap::repeat),
                           numbered_texels(8, Wrap::clamp_to_edge)};
    probe.question.glsl =
        "    vec2 uv = vec2(asked.x, 0.5);\n"
        "    return vec4(textureLod(map0, uv, 0.0).x, textureLod(map1, uv, 0.0).x, 0.0, 1.0);";
    probe.question.text = [](const QuadInput& in) {
        const vec2<QuadF> uv(in.asked.x, QuadF(0.5f));
        return vec4<QuadF>(texture_lod(in.maps[0], {}, uv, QuadF(0)).x,
                           texture_lod(in.maps[1], {}, uv, QuadF(0)).x, QuadF(0), QuadF(1));
    };
    probe.not_modelled = "a coordinate that is no number becomes 0";
    probe.words = [](const Values& values) {
        return fmt::format("{:g} {:g} {:g}, {:g} {:g} {:g}", answer(values, 0), answer(values, 1),
                           answer(values, 2), answer(values, 0, 1), answer(values, 1, 1),
                           answer(values, 2, 1));
    };
    return probe;
}

/// Of a level that every pixel chooses for itself.
Probe level_sizes() {
    Probe probe{"texture-size",
                "textureSize of levels that differ from pixel to pixel",
                "each pixel's own level's (GLSL 4.60, 8.9.1)",
                {side, side}};
    ProbeTexture map = level_numbers(16);
    const int levels = static_cast<int>(map.levels.size());
    probe.question.asked = ask_pixels(side, side, [&](int i) {
        return std::array<float, 4>{static_cast<float>((i + i / side) % levels)};
    });
    probe.question.maps = {map};
    probe.question.glsl = "    return vec4(vec2(textureSize(map0, int(asked.x))), 0.0, 1.0);";
    probe.question.text = [](const QuadInput& in) {
        vec2<QuadF> size(QuadF(0));
        for (int lane = 0; lane < 4; ++lane) {
            const auto of = texture_size(in.maps[0], to_int(in.asked.x.lane[lane]));
            size.x.lane[lane] = static_cast<float>(of.x);
            size.y.lane[lane] = static_cast<float>(of.y);
        }
        return vec4<QuadF>(size.x, size.y, QuadF(0), QuadF(1));
    };
    probe.not_modelled = "it is no choice, and presets imitate no defects";
    probe.words = [levels](const Values& values) {
        int wrong = 0;
        for (int i = 0; i < side * side; ++i)
            wrong += answer(values, static_cast<std::size_t>(i)) !=
                     static_cast<float>(16 >> (i + i / side) % levels);
        return wrong == 0 ? std::string("each its own")
                          : fmt::format("{} of {} another's", wrong, side * side);
    };
    probe.legal = [words = probe.words](const Values& values) {
        return words(values) == "each its own";
    };
    return probe;
}

}  // namespace

std::vector<Probe> texel_probes() {
    return {weights("R8", TexelFormat::unorm8),
            weights("RGBA8", TexelFormat::unorm8),
            weights("SRGB8_ALPHA8", TexelFormat::srgb8),
            weights("R16", TexelFormat::unorm16),
            weights("R16F", TexelFormat::half),
            weights("R32F", TexelFormat::float32),
            texel_boundary(),
            gather(),
            large_coordinates("repeat", Wrap::repeat),
            large_coordinates("mirrored", Wrap::mirrored_repeat),
            wrap_order(),
            boundaries("repeat", Wrap::repeat),
            boundaries("mirrored", Wrap::mirrored_repeat),
            no_numbers(),
            level_sizes()};
}

}  // namespace quadrel::rules
