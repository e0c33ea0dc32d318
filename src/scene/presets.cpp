#include "quadrel/scene/presets.hpp"

#include <algorithm>

namespace quadrel {
namespace {

constexpr const char* red_height = "height in red";
constexpr const char* green_height = "height in green: swizzle g";
constexpr const char* alpha_height = "height in the normal map's alpha: swizzle a";
constexpr const char* red_depth = "depth in red, white is deep: swizzle 1-r";

std::vector<Preset> make_presets() {
    std::vector<Preset> presets;
    // Presets of one engine: those that are added next differ by name, meaning and parameters.
    struct Engine {
        const char *source, *map, *frame, *trace;
    };
    const auto add = [&](const Engine& engine, const char* name, const char* summary,
                         std::map<std::string, double> parameters = {}) {
        presets.push_back({name, summary, engine.map, engine.source, engine.frame, engine.trace,
                           std::move(parameters)});
    };
    const Engine unity_standard{"UnityCG.cginc, UnityStandardInput.cginc (built-in shaders)",
                                green_height, "frame-vertex", "offset-limit-042@published"};
    add(unity_standard, "unity-standard", "Unity, Standard and URP Lit: height map");

    const Engine unreal{"UMaterialExpressionBumpOffset (API reference, 5.4)",
                        "height as the graph supplies it", "frame-vertex", "unreal-bump-offset"};
    add(unreal, "unreal-bump-offset", "Unreal Engine: BumpOffset");
    return presets;
}

}  // namespace

std::span<const Preset> all_presets() {
    static const std::vector<Preset> presets = make_presets();
    return presets;
}

const Preset* find_preset(std::string_view name) {
    const auto found = std::ranges::find(all_presets(), name, &Preset::name);
    return found == all_presets().end() ? nullptr : &*found;
}

void apply_preset(const Preset& preset, const std::string& key, Material& material) {
    material.frame = {preset.frame, {}, key};
    material.trace = {preset.trace, preset.parameters, key};
    material.shadow = {"none", {}, key};
    if (material.textures.contains("normal"))
        material.surface = {"normal-map", {{"green", -1}}, key};
}

}  // namespace quadrel
