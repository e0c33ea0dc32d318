// Floating-point numbers: denormals, NaN, contraction, and how far functions are off.
#include <algorithm>
#include <bit>
#include <limits>

#include "rules/probes/inputs.hpp"

namespace quadrel::rules {
namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

/// No preset of a renderer has its arithmetic: Quadrel's own stands beside it.
Probe number_probe(const std::string& id, const std::string& asks, const std::string& permits,
                   int width, int height) {
    Probe probe{id, asks, permits, {width, height}};
    probe.not_modelled = "Quadrel computes as it always does";
    return probe;
}

/// |value - exact| in ulp of the exact value, of 24 bits.
double ulps(float value, double exact) {
    if (!std::isfinite(exact) || std::fabs(exact) > 3e38) return 0;
    const double size = std::max(std::fabs(exact), 0x1p-126);
    return std::fabs(double(value) - exact) / std::ldexp(1.0, std::ilogb(size) - 23);
}

struct Function {
    const char *id, *glsl, *permits;
    QuadF (*text)(const vec4<QuadF>&);
    double (*exact)(double x, double y);
    float low, high;
    double permitted;  ///< ulp; 0: no bound
};

const Function functions[] = {
    {"division", "asked.x / asked.y", "2.5 ulp in Vulkan; GLSL 4.60, 4.7.1",
     [](const vec4<QuadF>& v) { return v.x / v.y; }, [](double x, double y) { return x / y; },
     0.01f, 100, 2.5},
    {"sqrt", "sqrt(asked.x)", "as 1 / inversesqrt (GLSL 4.60, 4.7.1)",
     [](const vec4<QuadF>& v) { return sqrt(v.x); }, [](double x, double) { return std::sqrt(x); },
     0.01f, 100, 4.5},
    {"inversesqrt", "inversesqrt(asked.x)", "2 ulp (GLSL 4.60, 4.7.1)",
     [](const vec4<QuadF>& v) { return inversesqrt(v.x); },
     [](double x, double) { return 1 / std::sqrt(x); }, 0.01f, 100, 2},
    {"exp2", "exp2(asked.x)", "3 + 2 abs(x) ulp (GLSL 4.60, 4.7.1)",
     [](const vec4<QuadF>& v) { return exp2(v.x); },
     [](double x, double) { return quadrel::exp2(x); }, -10, 10, 23},
    {"log2", "log2(asked.x)", "3 ulp outside of [0.5, 2] (GLSL 4.60, 4.7.1)",
     [](const vec4<QuadF>& v) { return log2(v.x); },
     [](double x, double) { return quadrel::log2(x); }, 2, 100, 3},
    {"sin", "sin(asked.x)", "undefined (GLSL 4.60, 4.7.1); Vulkan: 2^-11",
     [](const vec4<QuadF>& v) { return sin(v.x); },
     [](double x, double) { return quadrel::sin(x); }, 0.1f, 3, 0}};

Probe function_error(const Function& f) {
    Probe probe =
        number_probe(f.id, std::string("the greatest error of ") + f.glsl, f.permits, side, side);
    Random random(7);
    const Asked asked = ask_pixels(side, side, [&](int) {
        return std::array<float, 4>{random.in(f.low, f.high), random.in(f.low, f.high)};
    });
    probe.question.asked = asked;
    probe.question.glsl = std::string("    return vec4(") + f.glsl + ", 0.0, 0.0, 1.0);";
    probe.question.text = [text = f.text](const QuadInput& in) {
        return vec4<QuadF>(text(in.asked), QuadF(0), QuadF(0), QuadF(1));
    };
    const auto worst = [asked, exact = f.exact](const Values& values) {
        double most = 0;
        for (std::size_t i = 0; i < asked.size(); ++i)
            most = std::max(
                most, ulps(answer(values, i), exact(double(asked[i][0]), double(asked[i][1]))));
        return most;
    };
    probe.words = [worst](const Values& values) {
        return fmt::format("{:.2g} ulp", worst(values));
    };
    if (f.permitted > 0)
        probe.legal = [worst, most = f.permitted](const Values& v) { return worst(v) <= most; };
    return probe;
}

Probe contraction() {
    Probe probe = number_probe("contraction", "whether x y - z is rounded once or twice",
                               "either, but for precise (GLSL 4.60, 4.7.1)", side, side);
    Random random(8);
    probe.question.asked = ask_pixels(side, side, [&](int) {
        const float x = random.in(1, 2), y = random.in(1, 2);
        return std::array<float, 4>{x, y, x * y};
    });
    probe.question.glsl = "    return vec4(asked.x * asked.y - asked.z, 0.0, 0.0, 1.0);";
    probe.question.text = [](const QuadInput& in) {
        return vec4<QuadF>(in.asked.x * in.asked.y - in.asked.z, QuadF(0), QuadF(0), QuadF(1));
    };
    probe.words = [](const Values& values) -> std::string {
        for (std::size_t i = 0; i < values.size() / 4; ++i)
            if (answer(values, i) != 0) return "once";
        return "twice";
    };
    return probe;
}

Probe fused() {
    Probe probe = contraction();
    probe.id = "fma";
    probe.asks = "whether fma(x, y, -z) is rounded once or twice";
    probe.permits = "either; once where precise (GLSL 4.60, 8.3)";
    probe.question.version = 40;
    probe.question.glsl = "    return vec4(fma(asked.x, asked.y, -asked.z), 0.0, 0.0, 1.0);";
    return probe;
}

Probe denormals() {
    Probe probe = number_probe("denormals", "whether denormals are kept: in a sum, in a product",
                               "kept, or 0 (GLSL 4.60, 4.7.1)", 2, 2);
    probe.question.asked = ask_pixels(2, 2, [](int) {
        return std::array<float, 4>{1e-39f, 2e-39f, 2e-38f, 0.25f};
    });
    probe.question.glsl = "    return vec4(asked.x + asked.y, asked.z * asked.w, 0.0, 1.0);";
    probe.question.text = [](const QuadInput& in) {
        const auto& a = in.asked;
        return vec4<QuadF>(a.x + a.y, a.z * a.w, QuadF(0), QuadF(1));
    };
    probe.words = [](const Values& values) {
        const auto kept = [](float x) { return x != 0 ? "kept" : "0"; };
        return fmt::format("{}, {}", kept(values[0]), kept(values[1]));
    };
    return probe;
}

/// A question about NaN, which the shader has as asked.x, beside 1 as asked.y: a compiler that knew
/// them could answer by itself.
Probe nan_probe(const std::string& id, const std::string& asks, const std::string& permits,
                const std::string& glsl, vec4<QuadF> (*text)(QuadF nan, QuadF one),
                std::string (*words)(const Values&)) {
    Probe probe = number_probe(id, asks, permits, 2, 2);
    probe.question.asked = ask_pixels(2, 2, [](int) {
        return std::array<float, 4>{not_a_number, 1};
    });
    probe.question.glsl = glsl;
    probe.question.text = [text](const QuadInput& in) { return text(in.asked.x, in.asked.y); };
    probe.words = words;
    return probe;
}

Probe least_of_nan() {
    return nan_probe(
        "min-nan", "min(NaN, 1), min(1, NaN), max(NaN, 1), max(1, NaN)",
        "anything (GLSL 4.60, 8.3)",
        "    return vec4(min(asked.x, asked.y), min(asked.y, asked.x),\n"
        "                max(asked.x, asked.y), max(asked.y, asked.x));",
        [](QuadF nan, QuadF one) {
            return vec4<QuadF>(min(nan, one), min(one, nan), max(nan, one), max(one, nan));
        },
        [](const Values& values) {
            std::string text;
            for (std::size_t i = 0; i < 4; ++i)
                text += (i == 0 ? "" : " ") + std::string(std::isnan(values[i]) ? "NaN" : "1");
            return text;
        });
}

Probe tests_of_nan() {
    return nan_probe(
        "isnan", "isnan(NaN), NaN < 1, NaN != NaN; clamp(NaN, 0, 1)", "anything (GLSL 4.60, 4.7.1)",
        "    float x = asked.x;\n"
        "    return vec4(isnan(x), x < asked.y, x != asked.x + 0.0, clamp(x, 0.0, 1.0));",
        [](QuadF nan, QuadF one) {
            const QuadF yes(1), no(0);
            return vec4<QuadF>(select(is_nan(nan), yes, no), select(nan < one, yes, no),
                               select(!(nan == nan), yes, no), clamp(nan, no, yes));
        },
        [](const Values& values) {
            return fmt::format("{:g} {:g} {:g}; {:g}", values[0], values[1], values[2], values[3]);
        });
}

}  // namespace

std::vector<Probe> number_probes() {
    std::vector<Probe> probes{denormals(), least_of_nan(), tests_of_nan(), contraction(), fused()};
    for (const Function& f : functions) probes.push_back(function_error(f));
    return probes;
}

}  // namespace quadrel::rules
