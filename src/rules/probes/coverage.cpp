// Coverage: who owns what lies on an edge, how finely vertices are placed, where samples are, and
// how varyings get from the vertices to the pixels.
#include <algorithm>

#include "rules/probes/inputs.hpp"
#include "rules/probes/samples.hpp"

namespace quadrel::rules {
namespace {

/// A shader that says where it was run.
void ask_where(Question& question) {
    question.glsl = "    return vec4(1.0);";
    question.text = [](const QuadInput&) { return vec4<QuadF>(QuadF(1)); };
}

constexpr int fan_side = 32;

/// How many of the triangles of a picture each have drawn a pixel.
int times_drawn(const Values& values, int side, int x, int y) {
    const auto frame = static_cast<std::size_t>(4 * side * side);
    int count = 0;
    for (std::size_t first = 0; first < values.size(); first += frame)
        count += values[first + static_cast<std::size_t>(4 * (y * side + x))] != 0;
    return count;
}

/// Triangles around a point within [4, 28]^2, whose corners lie on pixel centres, on edges of
/// pixels, or anywhere on the grid of 1/256.
std::vector<Triangle> random_fan(Random& random) {
    const auto at = [&](double low, double high) {
        const double steps[] = {0.5, 1, 1.0 / 256};
        const double step = steps[random.bits() % 3];
        return std::floor((low + (high - low) * double(random.in(0, 1))) / step) * step;
    };
    std::vector<std::array<double, 2>> rim;
    for (const auto& [x, y] :
         std::initializer_list<std::pair<int, int>>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        rim.push_back({4.0 + 24 * x, 4.0 + 24 * y});
        if (x == y)
            rim.push_back({at(6, 26), 4.0 + 24 * y});
        else
            rim.push_back({4.0 + 24 * x, at(6, 26)});
    }
    std::vector<Triangle> fan;
    const double x = at(8, 24), y = at(8, 24);
    // The rim runs along the lower side, up the right one, back along the upper, down the left.
    std::sort(rim.begin(), rim.end(), [](const auto& a, const auto& b) {
        const auto turn = [](const std::array<double, 2>& p) {
            const double u = p[0] - 16, v = p[1] - 16, size = std::fabs(u) + std::fabs(v);
            return v < 0 ? u / size : 2 - u / size;
        };
        return turn(a) < turn(b);
    });
    for (std::size_t i = 0; i < rim.size(); ++i) {
        const auto &a = rim[i], &b = rim[(i + 1) % rim.size()];
        fan.push_back({corner(a[0], a[1], fan_side, fan_side),
                       corner(b[0], b[1], fan_side, fan_side), corner(x, y, fan_side, fan_side)});
    }
    return fan;
}

Probe fans() {
    constexpr int fans = 4;
    Probe probe{"fill-fans",
                "random fans: how often each pixel within one is drawn",
                "once, where triangles share an edge (OpenGL 4.6, 14.6.1)",
                {fan_side, fan_side}};
    ask_where(probe.question);
    probe.question.apart = true;
    Random random(1);
    for (int i = 0; i < fans; ++i)
        for (const Triangle& triangle : random_fan(random))
            probe.question.triangles.push_back(triangle);
    probe.words = [](const Values& values) {
        const std::size_t size = values.size() / fans;
        int holes = 0, twice = 0;
        for (std::size_t fan = 0; fan < fans; ++fan) {
            const Values one(values.begin() + static_cast<std::ptrdiff_t>(fan * size),
                             values.begin() + static_cast<std::ptrdiff_t>((fan + 1) * size));
            for (int y = 4; y < 28; ++y)
                for (int x = 4; x < 28; ++x) {
                    const int times = times_drawn(one, fan_side, x, y);
                    holes += times == 0;
                    twice += times > 1;
                }
        }
        return holes + twice == 0 ? std::string("once")
                                  : fmt::format("{} not, {} more than once", holes, twice);
    };
    probe.legal = [words = probe.words](const Values& values) { return words(values) == "once"; };
    return probe;
}

/// [2.5, 5.5] x [2.5, 5.5]: its edges run through pixel centres.
Probe edges() {
    Probe probe{"fill-edges",
                "which edges of a rectangle own the pixel centres on them",
                "any, each consistently (OpenGL 4.6, 14.6.1); Direct3D 11.3, 3.4.2.1: top and left",
                {8, 8}};
    ask_where(probe.question);
    add_rectangle(probe.question.triangles, 2.5, 2.5, 5.5, 5.5, 8, 8);
    probe.words = [](const Values& values) {
        const auto drawn = [&](int x, int y) {
            return answer(values, static_cast<std::size_t>(8 * y + x)) != 0;
        };
        std::string owners;
        const auto add = [&](bool owns, const char* name) {
            if (owns) owners += (owners.empty() ? "" : ", ") + std::string(name);
        };
        add(drawn(2, 3), "left");
        add(drawn(5, 3), "right");
        add(drawn(3, 2), "bottom");
        add(drawn(3, 5), "top");
        return owners.empty() ? std::string("none") : owners;
    };
    probe.legal = [](const Values& values) {
        const auto drawn = [&](std::size_t x, std::size_t y) {
            return answer(values, 8 * y + x) != 0;
        };
        return drawn(2, 3) != drawn(5, 3) && drawn(3, 2) != drawn(3, 5);
    };
    return probe;
}

constexpr int snap_steps = 256;  // of the sweep below, in 1/2048 pixel

/// Row k: a rectangle whose left edge is (k - 128) / 2048 right of a pixel centre.
Probe snapping() {
    Probe probe{
        "snapping",
        "how far an edge passes a pixel centre before the pixel is lost",
        "SUBPIXEL_BITS, at least 4 (OpenGL 4.6, the tables of limits); Direct3D 11.3, 3.4.1: 8",
        {8, snap_steps}};
    ask_where(probe.question);
    for (int k = 0; k < snap_steps; ++k)
        add_rectangle(probe.question.triangles, 2.5 + (k - snap_steps / 2) / 2048.0, k, 6, k + 1, 8,
                      snap_steps);
    const auto reach = [](const Values& values) {
        int last = 0;
        while (last < snap_steps && answer(values, static_cast<std::size_t>(8 * last + 2)) != 0)
            ++last;
        return last - 1 - snap_steps / 2;  // the last that covers, in 1/2048 pixel
    };
    probe.words = [reach](const Values& values) -> std::string {
        const int last = reach(values);
        for (int bits = 10; bits >= 1; --bits) {
            const int half = 1 << (10 - bits);  // a half of the grid's unit
            if (last == half) return fmt::format("{} bits, half to even", bits);
            if (last == half - 1) return fmt::format("{} bits, half up", bits);
        }
        return last < 0 ? "finer than 1/2048" : fmt::format("{}/2048 pixel", last);
    };
    probe.legal = [reach](const Values& values) {
        return reach(values) >= -64 && reach(values) <= 64;
    };
    return probe;
}

/// How far answers are off where both sides have drawn, relative to the largest.
std::string relative_words(const Values& seen, const Values& exact) {
    double worst = 0, largest = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        if (seen[i | 3] == 0 || exact[i | 3] == 0) continue;
        worst = std::max(worst, std::fabs(double(seen[i]) - double(exact[i])));
        largest = std::max(largest, std::fabs(double(exact[i])));
    }
    if (worst == 0) return "exact";
    return fmt::format("2^{:.1f}", quadrel::log2(worst / largest));
}

Probe interpolation() {
    Probe probe{"interpolation",
                "a perspective-correct varying against its exact value, relative to the largest",
                "no bound is stated (OpenGL 4.6, 14.6.1)",
                {32, 32}};
    probe.question.glsl = "    return vec4(interpolated.xy, 0.0, 1.0);";
    probe.question.text = [](const QuadInput& in) {
        return vec4<QuadF>(in.interpolated.x, in.interpolated.y, QuadF(0), QuadF(1));
    };
    const auto at = [](float x, float y, float w, float u, float v) {
        return Corner{{x * w, y * w, 0, w}, {u, v}};
    };
    probe.question.triangles = {{at(-0.9f, -0.8f, 1.1f, 0, 0), at(0.95f, -0.7f, 2.3f, 1, 0.125f),
                                 at(-0.1f, 0.93f, 4.7f, 0.3f, 0.9f)}};
    const Values exact = ask_quadrel(probe.question, hardware_model(Hardware::exact));
    probe.words = [exact](const Values& values) { return relative_words(values, exact); };
    return probe;
}

}  // namespace

std::vector<Probe> coverage_probes() {
    return {fans(), edges(), snapping(), sample_positions_probe(), interpolation()};
}

}  // namespace quadrel::rules
