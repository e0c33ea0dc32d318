// Sources: Vulkan specification, "Precision and Operation of SPIR-V Instructions" and required
// limits; Direct3D 11.3 functional specification, 3.1.3, 7.18 and 22.10; OpenGL Shading Language
// 4.60, 4.7.1; WebGPU Shading Language, "Floating Point Accuracy".
#include "render/ranges/limits.hpp"

#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <sstream>
#include <utility>

#include "quadrel/error.hpp"

namespace quadrel {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double float_below_pi = 0x1.921fb4p+1;

/// What the four have in common, and what none states: interpolation, and how precisely fixed-point
/// texels are filtered.
ErrorBudget shared_limits() {
    ErrorBudget budget;
    budget.unit = 0x1p-23;
    budget.division = 3.5;  // 2.5, or a product with 1 / y, which may be made of it
    budget.inverse_root = 2;
    budget.square_root = 4.5;  // 1 / inversesqrt(x)
    budget.normalize = 7;      // v / length(v)
    budget.exp2 = budget.exp = 3;
    budget.exp2_slope = budget.exp_slope = 2;
    budget.log2 = budget.log = 3;
    budget.log2_absolute = 0x1p-21;
    budget.sine = 0x1p-11;
    budget.sine_limit = float_below_pi;
    budget.arctangent = 4096;
    budget.flushes_denormals = true;
    budget.derivatives = DerivativeFreedom::quad;
    budget.filtered = 0x1p-16;
    budget.plane = 0x1p-20;
    budget.snapping = 0x1p-8;  // 8 bits, whichever way they are rounded
    budget.evaluation = 0x1p-23;
    return budget;
}

ErrorBudget vulkan() {
    ErrorBudget budget = shared_limits();
    budget.address = 0x1p-4;  // subTexelPrecisionBits 4
    budget.lod = 0x1p-4;      // mipmapPrecisionBits 4
    budget.lod_freedom = LodFreedom::vulkan;
    return budget;
}

/// Its conformance tests take what Direct3D permits of decoding.
ErrorBudget webgpu() {
    ErrorBudget budget = vulkan();
    budget.srgb = 0.5;
    return budget;
}

ErrorBudget gl() {
    ErrorBudget budget = shared_limits();
    budget.sine = budget.arctangent = infinity;  // "undefined precision"
    budget.address = 0x1p-8;                     // not stated: what implementations have
    budget.lod = 0x1p-4;                         // nor is this
    budget.lod_freedom = LodFreedom::gl;
    return budget;
}

ErrorBudget d3d() {
    ErrorBudget budget = shared_limits();
    budget.division = 1.5;    // x * rcp(y)
    budget.inverse_root = 4;  // 2^-21
    budget.square_root = 1;
    budget.normalize = 5;
    budget.exp2 = budget.exp = 4;  // 2^-21; e^x is 2^(x log2(e)) and log(x) log2(x) log(2)
    budget.exp2_slope = 0;
    budget.exp_slope = 1;
    budget.log2 = 4;
    budget.log = 5;
    budget.sine = 0.0008;
    budget.sine_limit = 314;  // 100 pi
    budget.arctangent = infinity;
    budget.snapping = 0.6 * 0x1p-8;
    budget.address = 0.6 * 0x1p-8;
    budget.lod = 0x1p-8;
    budget.lod_freedom = LodFreedom::d3d;
    budget.srgb = 0.5;
    return budget;
}

/// Float32 as the reference computes it, each operation rounded to nearest and functions within
/// what num/math.hpp states; sums may be taken in any order, products fused with sums.
ErrorBudget rounding() {
    ErrorBudget budget;
    budget.unit = 0x1p-23;
    budget.division = budget.square_root = 0.5;
    budget.inverse_root = 1.01;  // 1 / sqrt(x)
    budget.normalize = 2;        // v * (1 / sqrt(dot))
    budget.exp2 = budget.exp = 1;
    budget.log2 = budget.log = 0.51;
    budget.log2_absolute = 0x1p-24;
    budget.sine = 0x1p-23;
    budget.arctangent = 1;
    budget.evaluation = 0x1p-23;
    budget.lod = 0x1p-18;  // of log2(rho)
    return budget;
}

double* setting(ErrorBudget& budget, const std::string& name) {
    if (name == "plane") return &budget.plane;
    if (name == "snapping") return &budget.snapping;
    if (name == "evaluation") return &budget.evaluation;
    if (name == "filtered") return &budget.filtered;
    if (name == "address") return &budget.address;
    if (name == "lod") return &budget.lod;
    if (name == "srgb") return &budget.srgb;
    return nullptr;
}

void apply_setting(ErrorBudget& budget, const std::string& text) {
    const std::size_t equals = text.find('=');
    double* const place = setting(budget, text.substr(0, equals));
    if (place == nullptr || equals == std::string::npos)
        throw UsageError(
            fmt::format("--limits: found \"{}\", expected plane=, snapping=, evaluation=, "
                        "filtered=, address=, lod= or srgb= and a number, or rho=exact, "
                        "derivatives=exact, derivatives=quad or derivatives=each",
                        text));
    const char* const first = text.data() + equals + 1;
    const char* const last = text.data() + text.size();
    double value = 0;
    const auto [end, error] = std::from_chars(first, last, value);
    if (error != std::errc() || end != last || !(value >= 0 && value <= 1))
        throw UsageError(
            fmt::format("--limits: found \"{}\", expected a number from 0 to 1", text));
    *place = value;
}

/// What is no number: of what the level of detail is made, and along which row and column
/// differences are taken. False if it is neither.
bool apply_choice(ErrorBudget& budget, const std::string& text) {
    constexpr std::pair<const char*, DerivativeFreedom> derivatives[] = {
        {"derivatives=exact", DerivativeFreedom::exact},
        {"derivatives=quad", DerivativeFreedom::quad},
        {"derivatives=each", DerivativeFreedom::each}};
    for (const auto& [name, freedom] : derivatives)
        if (text == name) {
            budget.derivatives = freedom;
            return true;
        }
    if (text != "rho=exact") return false;
    budget.lod_freedom = LodFreedom::exact;
    return true;
}

}  // namespace

ErrorBudget budget_of_limits(const std::string& text) {
    std::istringstream parts(text);
    std::string part;
    std::getline(parts, part, ',');
    ErrorBudget budget;
    if (part == "vulkan")
        budget = vulkan();
    else if (part == "webgpu")
        budget = webgpu();
    else if (part == "gl")
        budget = gl();
    else if (part == "d3d")
        budget = d3d();
    else if (part == limits_of_rounding)
        budget = rounding();
    else
        throw UsageError(fmt::format(
            "--limits: found \"{}\", expected vulkan, d3d, gl or webgpu, or rounding", part));
    if (text.ends_with(',')) apply_setting(budget, "");
    while (std::getline(parts, part, ','))
        if (!apply_choice(budget, part)) apply_setting(budget, part);
    return budget;
}

}  // namespace quadrel
