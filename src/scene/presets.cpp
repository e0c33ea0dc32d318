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
                         std::map<std::string, ParameterValue> parameters = {}) {
        presets.push_back({name, summary, engine.map, engine.source, engine.frame, engine.trace,
                           std::move(parameters)});
    };
    const Engine godot{"godot, scene/resources/material.cpp at 0059d788 (4.x)", red_height,
                       "frame-vertex", "godot"};
    add(godot, "godot-simple", "Godot, StandardMaterial3D: heightmap_enabled", {{"deep", "off"}});
    add(godot, "godot-deep", "Godot, StandardMaterial3D: heightmap_deep_parallax",
        {{"deep", "on"}});

    const Engine bevy{"bevy_pbr, parallax_mapping.wesl at 4805ca79 (0.20.0-dev)", red_depth,
                      "frame-vertex", "bevy"};
    add(bevy, "bevy-occlusion", "Bevy, StandardMaterial: ParallaxMappingMethod::Occlusion",
        {{"relief", "occlusion"}});
    add(bevy, "bevy-relief", "Bevy, StandardMaterial: ParallaxMappingMethod::Relief",
        {{"relief", "relief"}});

    const Engine three{"three.js, examples/jsm/shaders/ParallaxShader.js at 05578ec7 (to r131)",
                       red_depth, "frame-cot", "three-parallax"};
    add(three, "three-basic", "three.js, ParallaxShader: basic", {{"mode", "basic"}});
    add(three, "three-steep", "three.js, ParallaxShader: steep", {{"mode", "steep"}});
    add(three, "three-occlusion", "three.js, ParallaxShader: occlusion", {{"mode", "occlusion"}});
    add(three, "three-relief", "three.js, ParallaxShader: relief", {{"mode", "relief"}});
    const Engine three_nodes{"three.js, src/nodes/accessors/AccessorsUtils.js at 085048b0",
                             red_depth, "frame-vertex", "three-parallax-uv"};
    add(three_nodes, "three-parallax-uv", "three.js, shading language: parallaxUV");

    const Engine babylon{"Babylon.js, ShadersInclude/bumpFragmentFunctions.fx at 769119fa",
                         alpha_height, "frame-cot@published", "babylon"};
    add(babylon, "babylon-parallax", "Babylon.js, StandardMaterial, PBRMaterial: useParallax",
        {{"parallax_occlusion", "off"}});
    add(babylon, "babylon-occlusion", "Babylon.js, the same: useParallaxOcclusion",
        {{"parallax_occlusion", "on"}});

    const Engine o3de{"o3de, ShaderLib/Atom/Features/ParallaxMapping.azsli at 354a2acc", red_height,
                      "frame-vertex", "o3de"};
    add(o3de, "o3de-basic", "O3DE: Basic", {{"algorithm", "basic"}});
    add(o3de, "o3de-steep", "O3DE: Steep", {{"algorithm", "steep"}});
    add(o3de, "o3de-occlusion", "O3DE: POM", {{"algorithm", "occlusion"}});
    add(o3de, "o3de-relief", "O3DE: Relief", {{"algorithm", "relief"}});
    add(o3de, "o3de-contact", "O3DE: Contact", {{"algorithm", "contact"}});

    const Engine playcanvas{"playcanvas/engine, chunks/standard/frag/parallax.js (2.22)",
                            red_height, "frame-vertex", "playcanvas"};
    add(playcanvas, "playcanvas-offset", "PlayCanvas, StandardMaterial: parallaxMode offset",
        {{"mode", "offset"}});
    add(playcanvas, "playcanvas-occlusion", "PlayCanvas, the same: parallaxMode occlusion",
        {{"mode", "occlusion"}});

    const Engine jmonkey{"jMonkeyEngine, Common/ShaderLib/Parallax.glsllib at 7277b5d8", red_height,
                         "frame-vertex", "jmonkey"};
    add(jmonkey, "jmonkey-classic", "jMonkeyEngine, Lighting, PBRLighting: ParallaxMap",
        {{"steep", 0}});
    add(jmonkey, "jmonkey-steep", "jMonkeyEngine, the same: SteepParallax", {{"steep", 1}});

    const Engine unity_offset{"Unity, UnityCG.cginc and ParallaxMapping.hlsl at 467b5fea",
                              green_height, "frame-vertex", "offset-limit-042@published"};
    add(unity_offset, "unity-standard", "Unity, Standard and URP Lit: height map");
    const Engine unity_pom{"Unity, PerPixelDisplacement.hlsl at c8df1d81", red_height,
                           "frame-vertex", "unity-pom"};
    add(unity_pom, "unity-shader-graph", "Unity, Shader Graph: Parallax Occlusion Mapping node",
        {{"mode", "shader-graph"}});
    add(unity_pom, "unity-hdrp", "Unity, HDRP Lit: pixel displacement",
        {{"mode", "hdrp"}, {"scale", 0.02}, {"lod_threshold", 5}});

    const Engine unreal{"Unreal Engine, UMaterialExpressionBumpOffset (API reference, 5.4)",
                        "height as the graph supplies it", "frame-vertex", "unreal-bump-offset"};
    add(unreal, "unreal-bump-offset", "Unreal Engine: BumpOffset");

    const Engine tutorial{"Learn OpenGL, 5.3.parallax_mapping.fs at 7dc79cd5", red_depth,
                          "frame-vertex", "learnopengl"};
    add(tutorial, "learnopengl", "Learn OpenGL: parallax occlusion mapping");
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
        material.surface = {"normal-map", {{"green", "down"}}, key};
}

}  // namespace quadrel
