// The searches of engines, as their shaders have them; see relief/stages.hpp. Presets
// (scene/presets.hpp) name their settings.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/trace/babylon.hpp"
#include "quadrel/relief/trace/bevy.hpp"
#include "quadrel/relief/trace/godot.hpp"
#include "quadrel/relief/trace/learnopengl.hpp"
#include "quadrel/relief/trace/o3de.hpp"
#include "quadrel/relief/trace/playcanvas.hpp"
#include "quadrel/relief/trace/three_parallax.hpp"
#include "quadrel/relief/trace/three_parallax_uv.hpp"
#include "quadrel/relief/trace/unity_pom.hpp"
#include "quadrel/relief/trace/unreal_bump_offset.hpp"

namespace quadrel {

using EngineStages = StageList<Babylon, Bevy, Godot, LearnOpenGl, O3de, PlayCanvas, ThreeParallax,
                               ThreeParallaxUv, UnityPom, UnrealBumpOffset>;

}  // namespace quadrel
