// Levels of detail: the formula, its logarithm, how finely levels are told apart, and where one
// gives way to the next.
#include <algorithm>
#include <limits>
#include <set>

#include "quadrel/texture/sampler.hpp"
#include "rules/probes/formulas.hpp"
#include "rules/probes/inputs.hpp"

namespace quadrel::rules {
namespace {

constexpr int sweep_side = 32, map_size = 64;  // of the frame, and of the texture
constexpr double coarsest = 6;                 // its coarsest level
constexpr const char* permitted_levels =
    "between the greatest component and the sum of both axes' (OpenGL 4.6, "
    "8.14.1); the logarithm's error is left open";

/// textureGrad of the gradients that are asked for, in texels.
void look_by_gradients(Question& question) {
    question.glsl =
        "    vec4 g = asked / 64.0;\n"
        "    return vec4(textureGrad(map0, vec2(0.5), g.xy, g.zw).x, 0.0, 0.0, 1.0);";
    question.text = [](const QuadInput& in) {
        const vec4<QuadF> g = in.asked * QuadF(0.015625f);
        const vec2<QuadF> uv(QuadF(0.5f));
        return vec4<QuadF>(
            texture_grad(in.maps[0], {}, uv, vec2<QuadF>(g.x, g.y), vec2<QuadF>(g.z, g.w)).x,
            QuadF(0), QuadF(0), QuadF(1));
    };
}

/// texture() of a coordinate that goes so many texels along u within each quad.
void look_along_u(Question& question) {
    question.glsl =
        "    vec2 uv = vec2(mod(pixel.x, 2.0) * asked.x / 64.0, 0.5);\n"
        "    return vec4(texture(map0, uv).x, 0.0, 0.0, 1.0);";
    question.text = [](const QuadInput& in) {
        const vec2<QuadF> uv(QuadF(0, 1, 0, 1) * in.asked.x * QuadF(0.015625f), QuadF(0.5f));
        return vec4<QuadF>(texture(in.maps[0], {}, uv, in.derivatives).x, QuadF(0), QuadF(0),
                           QuadF(1));
    };
}

Probe formula_probe(const std::string& id, const std::string& asks, const Asked& asked) {
    Probe probe{id, asks, permitted_levels, {sweep_side, sweep_side}};
    probe.question.asked = asked;
    probe.question.maps = {level_numbers(map_size)};
    look_by_gradients(probe.question);
    probe.tolerance = 0x1p-12;
    probe.words = [asked](const Values& values) {
        return formula_words(asked, values, 0, 0, coarsest);
    };
    probe.legal = [asked](const Values& values) {
        return within_permitted_levels(asked, values, 0, 0, coarsest, 0.0625);
    };
    return probe;
}

/// From a quarter of a texel to 128, along u.
Asked sweep() {
    return ask_quads(sweep_side, sweep_side, [](int i) {
        return std::array<float, 4>{
            static_cast<float>(quadrel::exp2(-2 + 9.0 * i / (sweep_side * sweep_side / 4))), 0, 0,
            0};
    });
}

Asked random_gradients() {
    Random random(2);
    Asked quads;
    for (int i = 0; i < sweep_side * sweep_side / 4; ++i) {
        const float size_here = static_cast<float>(quadrel::exp2(double(random.in(0.5f, 5))));
        std::array<float, 4> g{};
        for (float& component : g) component = size_here * random.in(-1, 1);
        quads.push_back(g);
    }
    return ask_quads(sweep_side, sweep_side,
                     [&](int i) { return quads[static_cast<std::size_t>(i)]; });
}

Probe implicit_level() {
    Probe probe = formula_probe("lod-implicit",
                                "the level of texture() along one axis, by derivatives", sweep());
    look_along_u(probe.question);
    return probe;
}

/// `texture_query_lod`'s y, or its x.
Probe queried_level(bool accessed) {
    const Asked asked = sweep();
    Probe probe{accessed ? "lod-query-level" : "lod-query",
                accessed ? "textureQueryLod's first number, the level accessed, up to past the last"
                         : "textureQueryLod's second number along one axis",
                accessed ? "within the levels that there are (GLSL 4.60, 8.9.1)" : permitted_levels,
                {sweep_side, sweep_side}};
    probe.question.version = 40;
    probe.question.asked = asked;
    probe.question.maps = {level_numbers(map_size)};
    probe.question.glsl = std::string(
                              "    vec2 uv = vec2(mod(pixel.x, 2.0) * asked.x / 64.0, 0.5);\n"
                              "    return vec4(textureQueryLod(map0, uv).") +
                          (accessed ? "x" : "y") + ", 0.0, 0.0, 1.0);";
    probe.question.text = [accessed](const QuadInput& in) {
        const vec2<QuadF> uv(QuadF(0, 1, 0, 1) * in.asked.x * QuadF(0.015625f), QuadF(0.5f));
        const Gradients<QuadF> g = implicit_gradients(in.maps[0], uv, in.derivatives);
        const vec2<QuadF> lod = texture_query_lod(in.maps[0], uv, g.x, g.y);
        return vec4<QuadF>(accessed ? lod.x : lod.y, QuadF(0), QuadF(0), QuadF(1));
    };
    probe.tolerance = 0x1p-12;
    if (accessed) {
        probe.not_modelled = "it does not change what is sampled";
        probe.words = [](const Values& values) {
            float most = 0;
            for (std::size_t i = 0; i < values.size() / 4; ++i)
                most = std::max(most, answer(values, i));
            return fmt::format("up to {:g}", std::round(most * 100) / 100);
        };
        probe.legal = [](const Values& values) {
            for (std::size_t i = 0; i < values.size() / 4; ++i)
                if (answer(values, i) > float(coarsest)) return false;
            return true;
        };
        return probe;
    }
    probe.words = [asked](const Values& values) {
        return formula_words(asked, values, 0, -2, coarsest + 1);
    };
    probe.legal = [asked](const Values& values) {
        return within_permitted_levels(asked, values, 0, 0, coarsest + 1, 0.0625);
    };
    return probe;
}

/// Levels 0 and 1 are 0 and 1: what comes out is the weight.
Probe level_weight() {
    Probe probe{
        "lod-bits",
        "how finely a level given to textureLod weighs two levels",
        "left open (OpenGL 4.6, 8.14.3); Vulkan: 4 bits at least, Direct3D 11.3, 7.18.10: 8",
        {fine_side, fine_side}};
    probe.question.asked = ask_pixels(fine_side, fine_side, [](int i) {
        return std::array<float, 4>{static_cast<float>(i) / (fine_side * fine_side)};
    });
    probe.question.maps = {level_numbers(4)};
    probe.question.glsl = "    return vec4(textureLod(map0, vec2(0.5), asked.x).x, 0.0, 0.0, 1.0);";
    probe.question.text = [](const QuadInput& in) {
        return vec4<QuadF>(texture_lod(in.maps[0], {}, vec2<QuadF>(QuadF(0.5f)), in.asked.x).x,
                           QuadF(0), QuadF(0), QuadF(1));
    };
    probe.tolerance = 0x1p-12;
    probe.words = bits_words;
    return probe;
}

Probe nearest_level() {
    Probe probe{"nearest-level",
                "the level that is taken at 0.5, 1.5, 2.5, 3.5, and around them",
                "ceil(lod + 0.5) - 1, halves down (OpenGL 4.6, 8.14.3); Vulkan: preferred, or "
                "halves up",
                {16, 4}};
    probe.question.asked = ask_pixels(16, 4, [](int i) {
        const float half = static_cast<float>(i / 16) + 0.5f;
        const float near[] = {half, std::nextafter(half, 9.0f), std::nextafter(half, 0.0f)};
        const int place = i % 16;
        return std::array<float, 4>{place < 3 ? near[place]
                                              : half + static_cast<float>(place - 9) / 512};
    });
    SamplerState sampler;
    sampler.mip = MipFilter::nearest;
    probe.question.maps = {level_numbers(map_size, sampler)};
    probe.question.glsl = "    return vec4(textureLod(map0, vec2(0.5), asked.x).x, 0.0, 0.0, 1.0);";
    probe.question.text = [](const QuadInput& in) {
        return vec4<QuadF>(texture_lod(in.maps[0], {}, vec2<QuadF>(QuadF(0.5f)), in.asked.x).x,
                           QuadF(0), QuadF(0), QuadF(1));
    };
    probe.words = [](const Values& values) {
        return fmt::format("{:g} {:g} {:g} {:g}", answer(values, 0), answer(values, 16),
                           answer(values, 32), answer(values, 48));
    };
    probe.legal = [](const Values& values) {
        for (std::size_t row = 0; row < 4; ++row) {
            const float here = answer(values, 16 * row), low = static_cast<float>(row);
            if (here != low && here != low + 1) return false;
        }
        return true;
    };
    return probe;
}

/// From 1 to 16 texels a pixel, 64 gradients for each doubling.
Asked fine_sweep() {
    return ask_quads(sweep_side, sweep_side, [](int i) {
        return std::array<float, 4>{static_cast<float>(quadrel::exp2((i + 0.5) / 64)), 0, 0, 0};
    });
}

/// Where levels give way: "0.50 1.50 2.50", by log2 of the gradient.
std::string steps_words(const Asked& asked, const Values& values) {
    std::string text;
    for (float level = 0; level < 4; ++level) {
        double last = -1;
        for (std::size_t i = 0; i < asked.size(); ++i)
            if (answer(values, i) <= level)
                last = std::max(last, quadrel::log2(double(asked[i][0])));
        text += (level == 0 ? "" : " ") +
                (last < 0 ? std::string("-") : fmt::format("{:.2f}", last + 1.0 / 128));
    }
    return text;
}

Probe nearest_by_gradient(bool implicit) {
    const Asked asked = fine_sweep();
    Probe probe{implicit ? "nearest-implicit" : "nearest-gradient",
                std::string("log2 of the gradient at which nearest levels step, by ") +
                    (implicit ? "derivatives" : "textureGrad"),
                "0.5 1.5 2.5 3.5, as exact as the level of detail (OpenGL 4.6, 8.14.3)",
                {sweep_side, sweep_side}};
    SamplerState sampler;
    sampler.mip = MipFilter::nearest;
    probe.question.asked = asked;
    probe.question.maps = {level_numbers(map_size, sampler)};
    if (implicit)
        look_along_u(probe.question);
    else
        look_by_gradients(probe.question);
    probe.words = [asked](const Values& values) { return steps_words(asked, values); };
    return probe;
}

/// Magnified: nearest, so 0 or 1 of two texels; minified: between.
Probe filter_switch() {
    Probe probe{"filter-switch",
                "the level up to which the magnification filter applies",
                "0 (OpenGL 4.6, 8.15; before 4.6 0.5 where a linear one meets nearest levels)",
                {64, 2}};
    probe.question.asked = ask_pixels(
        64, 2, [](int i) { return std::array<float, 4>{static_cast<float>(i - 32) / 64}; });
    ProbeTexture map;
    map.width = 2;
    map.levels = {{0, 1}, {0.25f}};
    map.sampler.mag = Filter::linear;
    map.sampler.min = Filter::nearest;
    map.sampler.mip = MipFilter::nearest;
    map.sampler.wrap_u = map.sampler.wrap_v = Wrap::clamp_to_edge;
    probe.question.maps = {map};
    probe.question.glsl =
        "    return vec4(textureLod(map0, vec2(0.4375, 0.5), asked.x).x, 0.0, 0.0, 1.0);";
    probe.question.text = [](const QuadInput& in) {
        const vec2<QuadF> uv(QuadF(0.4375f), QuadF(0.5f));
        return vec4<QuadF>(texture_lod(in.maps[0], {}, uv, in.asked.x).x, QuadF(0), QuadF(0),
                           QuadF(1));
    };
    probe.words = [](const Values& values) {
        int last = -1;
        for (int i = 0; i < 128; ++i)
            if (answer(values, static_cast<std::size_t>(i)) == 0.375f) last = i;
        return last < 0 ? std::string("never") : fmt::format("{:g}", (last - 32) / 64.0);
    };
    probe.legal = [words = probe.words](const Values& values) {
        return words(values) == "0" || words(values) == "0.5";
    };
    return probe;
}

}  // namespace

std::vector<Probe> level_probes() {
    return {formula_probe("lod-axis", "the level of textureGrad along one axis", sweep()),
            formula_probe("lod-formula", "the level of textureGrad of random gradients",
                          random_gradients()),
            implicit_level(),
            queried_level(false),
            queried_level(true),
            level_weight(),
            nearest_level(),
            nearest_by_gradient(false),
            nearest_by_gradient(true),
            filter_switch()};
}

}  // namespace quadrel::rules
