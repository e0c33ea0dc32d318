// The searches of engines, as their shaders have them; see relief/stages.hpp. Presets
// (scene/presets.hpp) name their settings.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/trace/engine/babylon.hpp"
#include "quadrel/relief/trace/engine/bevy.hpp"
#include "quadrel/relief/trace/engine/godot.hpp"
#include "quadrel/relief/trace/engine/jmonkey.hpp"
#include "quadrel/relief/trace/engine/learnopengl.hpp"
#include "quadrel/relief/trace/engine/o3de.hpp"
#include "quadrel/relief/trace/engine/playcanvas.hpp"
#include "quadrel/relief/trace/engine/three_parallax.hpp"
#include "quadrel/relief/trace/engine/three_parallax_uv.hpp"
#include "quadrel/relief/trace/engine/unity_pom.hpp"
#include "quadrel/relief/trace/engine/unreal_bump_offset.hpp"

namespace quadrel {

using EngineStages = StageList<Babylon, Bevy, Godot, JMonkey, LearnOpenGl, O3de, PlayCanvas,
                               ThreeParallax, ThreeParallaxUv, UnityPom, UnrealBumpOffset>;

}  // namespace quadrel
