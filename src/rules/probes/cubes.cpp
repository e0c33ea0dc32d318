// Cube maps: which face, over the edges, and at the corners.
#include "quadrel/texture/cube.hpp"
#include "rules/probes/inputs.hpp"

namespace quadrel::rules {
namespace {

/// Faces of 2 x 2 texels, no two alike.
ProbeTexture numbered_cube(Filter filter) {
    ProbeTexture map;
    map.cube = true;
    map.width = map.height = 2;
    map.levels.emplace_back();
    for (int i = 0; i < 24; ++i) map.levels[0].push_back(static_cast<float>(i));
    map.sampler.mag = map.sampler.min = filter;
    return map;
}

Probe cube_probe(const std::string& id, const std::string& asks, const std::string& permits,
                 Filter filter, int width, int height) {
    Probe probe{id, asks, permits, {width, height}};
    probe.question.maps = {numbered_cube(filter)};
    probe.question.glsl = "    return vec4(textureLod(map0, asked.xyz, 0.0).x, 0.0, 0.0, 1.0);";
    probe.question.text = [](const QuadInput& in) {
        const vec3<QuadF> direction(in.asked.x, in.asked.y, in.asked.z);
        return vec4<QuadF>(texture_cube_lod(in.maps[0], {}, direction, QuadF(0)).x, QuadF(0),
                           QuadF(0), QuadF(1));
    };
    return probe;
}

std::array<float, 4> turned(const std::array<float, 3>& v, int axis) {
    const auto at = [&](int i) { return v[static_cast<std::size_t>((i + axis) % 3)]; };
    return {at(0), at(1), at(2), 0};
}

/// The texel of a 2 x 2 face that is nearest to a corner of the cube, by the table of OpenGL 4.6,
/// 8.13: s and t of each face.
int corner_texel(int face, const std::array<float, 4>& v) {
    const float x = v[0], y = v[1], z = v[2];
    const float s[] = {-z, z, x, x, x, -x}, t[] = {-y, -y, z, -z, -y, -y};
    return 4 * face + 2 * (t[face] > 0) + (s[face] > 0);
}

/// The mean of the three texels that meet there.
double corner_mean(const std::array<float, 4>& v) {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis)
        sum += corner_texel(2 * axis + (v[static_cast<std::size_t>(axis)] < 0), v);
    return sum / 3;
}

/// Both sides of an edge between faces, a 2^-20 apart, pixel beside pixel.
Probe seams() {
    Probe probe =
        cube_probe("cube-seams", "both sides of an edge between faces, linear filter",
                   "alike: filtered across (OpenGL 4.6, 8.13.1, TEXTURE_CUBE_MAP_SEAMLESS)",
                   Filter::linear, 32, 12);
    Random random(5);
    std::array<float, 3> direction{};
    probe.question.asked = ask_pixels(32, 12, [&](int i) {
        const bool second = (i & 1) != 0;
        const auto sign = [&] { return (random.bits() & 1) != 0 ? 1.0f : -1.0f; };
        if (!second) direction = {sign(), sign(), random.in(-0.9f, 0.9f)};
        std::array<float, 3> side = direction;
        side[second ? 1 : 0] *= 1 + 0x1p-20f;
        return turned(side, i / 32);
    });
    const auto worst = [](const Values& values) {
        double most = 0;
        for (std::size_t i = 0; i + 1 < values.size() / 4; i += 2)
            most = std::fmax(most,
                             std::fabs(double(answer(values, i)) - double(answer(values, i + 1))));
        return most;
    };
    probe.tolerance = 0x1p-10;
    probe.words = [worst](const Values& values) -> std::string {
        return worst(values) < 1e-3 ? "seamless" : fmt::format("jumps by {:.2g}", worst(values));
    };
    probe.legal = [worst](const Values& values) { return worst(values) < 1e-3; };
    return probe;
}

/// By the eight corners, a little off the ties between faces: 2^-12 off in a first row, then
/// further.
Probe corners() {
    Probe probe = cube_probe("cube-corners", "by a corner, where three texels meet, linear filter",
                             "their mean, recommended (OpenGL 4.6, 8.13.1)", Filter::linear, 8, 8);
    Random random(6);
    probe.question.asked = ask_pixels(8, 8, [&](int i) {
        const auto sign = [&](int bit) { return ((i >> bit) & 1) != 0 ? 1.0f : -1.0f; };
        const float off = i < 8 ? 0x1p-12f : 0.125f * random.in(0x1p-6f, 1);
        return turned({sign(0), sign(1) * (1 - off), sign(2) * (1 - 2 * off)}, i % 3);
    });
    probe.tolerance = 0x1p-10;
    probe.words = [asked = probe.question.asked](const Values& values) -> std::string {
        for (std::size_t i = 0; i < 8; ++i)
            if (std::fabs(double(answer(values, i)) - corner_mean(asked[i])) > 0.01) return "other";
        return "mean of three";
    };
    return probe;
}

/// Directions that belong to two or three faces alike.
Probe ties() {
    Probe probe =
        cube_probe("cube-ties", "the face of directions between faces: x = y, x = z, y = z, all",
                   "any of them (OpenGL 4.6, 8.13)", Filter::nearest, 4, 1);
    probe.question.asked = {{1, 1, 0.25f}, {1, 0.25f, 1}, {0.25f, 1, 1}, {1, 1, 1}};
    probe.not_modelled = "ties go to Z, Y, X, as Vulkan prefers";
    probe.words = [](const Values& values) {
        std::string faces;
        for (std::size_t i = 0; i < 4; ++i) {
            const int face = to_int(answer(values, i)) / 4;
            faces +=
                (i == 0 ? "" : " ") + std::string(1, face < 0 || face > 5 ? '?' : "XXYYZZ"[face]);
        }
        return faces;
    };
    return probe;
}

}  // namespace

std::vector<Probe> cube_probes() { return {seams(), corners(), ties()}; }

}  // namespace quadrel::rules
