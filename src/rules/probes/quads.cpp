// Quads: where they lie, what derivatives are taken between, what helper lanes hold, and whose
// level of detail a look-up has.
#include "quadrel/texture/sampler.hpp"
#include "rules/probes/inputs.hpp"

namespace quadrel::rules {
namespace {

/// Whether `expected(x, y)` is what both derivatives are wherever something was drawn.
template <class Expected>
bool all_are(const Values& values, std::size_t first, const Expected& expected) {
    for (int i = 0; i < side * side; ++i) {
        const auto pixel = static_cast<std::size_t>(i);
        if (answer(values, pixel, 3) == 0) continue;
        const auto [dx, dy] = expected(i % side, i / side);
        if (answer(values, pixel, first) != float(dx) ||
            answer(values, pixel, first + 1) != float(dy))
            return false;
    }
    return true;
}

Probe quads() {
    Probe probe{"quads",
                "which two pixels a derivative is taken between",
                "any neighbours (GLSL 4.60, 8.14.1); every GPU pairs at even window coordinates",
                {side, side}};
    probe.question.glsl =
        "    return vec4((dFdx(pixel.x * pixel.x) - 1.0) * 0.5 - pixel.x,\n"
        "                (dFdy(pixel.y * pixel.y) - 1.0) * 0.5 - pixel.y, 0.0, 1.0);";
    probe.question.text = [](const QuadInput& in) {
        const auto offset = [](const QuadF& slope, const QuadF& p) {
            return (slope - QuadF(1)) * QuadF(0.5f) - p;
        };
        const auto& p = in.pixel;
        return vec4<QuadF>(offset(dFdx(p.x * p.x, in.derivatives), p.x),
                           offset(dFdy(p.y * p.y, in.derivatives), p.y), QuadF(0), QuadF(1));
    };
    add_rectangle(probe.question.triangles, 3, 5, 13, 12, side, side);
    probe.words = [](const Values& values) -> std::string {
        if (all_are(values, 0, [](int x, int y) { return std::pair(-(x & 1), -(y & 1)); }))
            return "even";
        if (all_are(values, 0, [](int x, int y) { return std::pair((x & 1) - 1, (y & 1) - 1); }))
            return "odd";
        return "other";
    };
    return probe;
}

/// fine, or coarse of one row and one column.
std::string mode_words(const Values& values, std::size_t first) {
    if (all_are(values, first, [](int x, int y) { return std::pair(y, x); })) return "fine";
    for (const int row : {0, 1})
        for (const int column : {0, 1})
            if (all_are(values, first,
                        [&](int x, int y) { return std::pair((y & ~1) + row, (x & ~1) + column); }))
                return row + column == 0 ? "coarse"
                                         : fmt::format("coarse: row {}, column {}", row, column);
    return "other";
}

Probe derivatives() {
    Probe probe{"derivatives",
                "dFdx and dFdy of a product: each row's own difference, or one per quad",
                "either (GLSL 4.60, 8.14.1)",
                {side, side}};
    probe.question.glsl =
        "    return vec4(dFdx(pixel.x * pixel.y), dFdy(pixel.x * pixel.y), 0.0, 1.0);";
    probe.question.text = [](const QuadInput& in) {
        const QuadF product = in.pixel.x * in.pixel.y;
        return vec4<QuadF>(dFdx(product, in.derivatives), dFdy(product, in.derivatives), QuadF(0),
                           QuadF(1));
    };
    probe.words = [](const Values& values) { return mode_words(values, 0); };
    probe.legal = [](const Values& values) { return mode_words(values, 0) != "other"; };
    return probe;
}

Probe qualified_derivatives() {
    Probe probe{"derivatives-qualified",
                "the same by dFdxCoarse, dFdyFine",
                "coarse may be any row's and column's, fine is fine (GLSL 4.60, 8.14.1)",
                {side, side}};
    probe.question.version = 45;
    probe.not_modelled = "Quadrel's texts ask for a mode by name, or take the frame's";
    probe.question.glsl =
        "    return vec4(dFdxCoarse(pixel.x * pixel.y), dFdyCoarse(pixel.x * pixel.y), "
        "dFdyFine(pixel.x * pixel.y), 1.0);";
    probe.question.text = [](const QuadInput& in) {
        const QuadF product = in.pixel.x * in.pixel.y;
        return vec4<QuadF>(dFdx_coarse(product), dFdy_coarse(product), dFdy_fine(product),
                           QuadF(1));
    };
    probe.words = [](const Values& values) { return mode_words(values, 0); };
    probe.legal = [](const Values& values) { return mode_words(values, 0) != "other"; };
    return probe;
}

Probe helper_lanes() {
    Probe probe{"helper-lanes",
                "derivatives of a varying where the other pixel is not covered",
                "the varying is extrapolated (OpenGL 4.6, 14.6.1; GLSL 4.60, 7.1.5)",
                {side, side}};
    probe.question.glsl =
        "    return vec4(dFdx(interpolated.x), dFdy(interpolated.x), interpolated.x, 1.0);";
    probe.question.text = [](const QuadInput& in) {
        const QuadF v = in.interpolated.x;
        return vec4<QuadF>(dFdx(v, in.derivatives), dFdy(v, in.derivatives), v, QuadF(1));
    };
    const auto at = [](double x, double y) {
        return corner(x, y, side, side, {static_cast<float>(3 * x + 5 * y)});
    };
    probe.question.triangles = {{at(1.25, 0.75), at(14.5, 3.25), at(5.75, 14.5)}};
    probe.tolerance = 0x1p-10;  // what they hold is asked here, not how exactly
    probe.legal = [](const Values& values) {
        for (std::size_t i = 0; i < values.size() / 4; ++i)
            if (answer(values, i, 3) != 0 && (std::fabs(answer(values, i) - 3) > 1e-3f ||
                                              std::fabs(answer(values, i, 1) - 5) > 1e-3f))
                return false;
        return true;
    };
    probe.words = [legal = probe.legal](const Values& values) -> std::string {
        return legal(values) ? "extrapolated" : "other";
    };
    return probe;
}

/// Whose level the four lanes have.
std::string lane_words(const Values& values) {
    const auto lane = [&](int i) {
        return answer(values, static_cast<std::size_t>((i >> 1) * side + (i & 1)));
    };
    if (lane(0) == lane(1) && lane(0) == lane(2) && lane(0) == lane(3))
        return std::fabs(lane(0) - 1) < 0.1f ? "lane 0's" : "one per quad";
    return "each its own";
}

/// In texels: u is 0 2 in the quad's row 0 and 0 8 in row 1.
Probe quad_lod() {
    Probe probe{"quad-lod",
                "the level of a look-up whose lanes have derivatives of their own",
                "each lane's own, or one for the quad (GLSL 4.60, 8.9; OpenGL 4.6, 8.14.1)",
                {side, side}};
    probe.question.glsl =
        "    vec2 lane = mod(pixel, 2.0);\n"
        "    vec2 uv = vec2(lane.x * (1.0 + 3.0 * lane.y) * 0.03125, 0.5);\n"
        "    return vec4(texture(map0, uv).x, 0.0, 0.0, 1.0);";
    probe.question.text = [](const QuadInput& in) {
        const vec2<QuadF> uv(QuadF(0, 0.03125f, 0, 0.125f), QuadF(0.5f));
        return vec4<QuadF>(texture(in.maps[0], {}, uv, in.derivatives).x, QuadF(0), QuadF(0),
                           QuadF(1));
    };
    probe.question.maps = {level_numbers(64)};
    probe.tolerance = 0x1p-12;
    probe.words = lane_words;
    return probe;
}

/// In texels: 2, 4, 8 and 16.
Probe quad_gradients() {
    Probe probe{"quad-gradients",
                "the level of textureGrad whose lanes have gradients of their own",
                "each lane's own (GLSL 4.60, 8.9.2)",
                {side, side}};
    probe.question.glsl =
        "    vec2 lane = mod(pixel, 2.0);\n"
        "    vec2 gradient = vec2(exp2(1.0 + lane.x + 2.0 * lane.y) / 64.0, 0.0);\n"
        "    return vec4(textureGrad(map0, vec2(0.5), gradient, vec2(0.0)).x, 0.0, 0.0, 1.0);";
    probe.question.text = [](const QuadInput& in) {
        const vec2<QuadF> uv(QuadF(0.5f)), zero(QuadF(0));
        const vec2<QuadF> gradient(QuadF(2, 4, 8, 16) * QuadF(0.015625f), QuadF(0));
        return vec4<QuadF>(texture_grad(in.maps[0], {}, uv, gradient, zero).x, QuadF(0), QuadF(0),
                           QuadF(1));
    };
    probe.question.maps = {level_numbers(64)};
    probe.tolerance = 0x1p-12;
    probe.words = lane_words;
    probe.legal = [](const Values& values) { return lane_words(values) == "each its own"; };
    return probe;
}

}  // namespace

std::vector<Probe> quad_probes() {
    return {quads(),        derivatives(), qualified_derivatives(),
            helper_lanes(), quad_lod(),    quad_gradients()};
}

}  // namespace quadrel::rules
