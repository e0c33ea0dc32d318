// The stages that run on ranges: those that find their way by comparing numbers, those that walk by
// cones and distances, those that read tables by direction, and, by what they are known to find,
// those that walk over cells and levels to the first hit. Four do not: qdm@published, whose first
// quotient is 0 / 0, of which a minimum may make anything, and those whose rays bend over curved
// surfaces, prism-free and curved-quadric, published or not: their ranges take long and say little.
#pragma once

#include "quadrel/relief/range_normals.hpp"
#include "quadrel/relief/range_words.hpp"
#include "quadrel/relief/shadow/range_horizon.hpp"
#include "quadrel/relief/shadow/range_layers.hpp"
#include "quadrel/relief/shadow/range_rising.hpp"
#include "quadrel/relief/shell/range_prism.hpp"
#include "quadrel/relief/stages.hpp"
#include "quadrel/relief/trace/cone/range_cone_robust_exact.hpp"
#include "quadrel/relief/trace/cone/range_cone_walk.hpp"
#include "quadrel/relief/trace/cone/range_sphere_3d.hpp"
#include "quadrel/relief/trace/layer/range_solids.hpp"
#include "quadrel/relief/trace/march/range_step_bounds.hpp"
#include "quadrel/relief/trace/oracle/range_traces.hpp"
#include "quadrel/relief/trace/search/range_first_hit.hpp"
#include "quadrel/relief/trace/table/range_prewarp.hpp"
#include "quadrel/relief/trace/table/range_table.hpp"
#include "quadrel/shade/stages.hpp"

namespace quadrel {

using RangeStages = StageList<
    // quad, frame
    Interpolate, Differentiate, LevelOfDetail, DepthConstant, DepthGraded, FrameNone, FrameThesis,
    FrameGram, FrameFace, FrameVertex, FrameVertexPublished, FrameMikkt, FrameCot,
    FrameCotPublished, FrameInverseTbn, FrameInverseTbnPublished, FrameImpostor, FrameShell,
    // trace
    TraceNone, Parallax, ParallaxBias, ParallaxBiasPublished, OffsetLimit, OffsetLimitPublished,
    OffsetLimit042, OffsetLimit042Published, OffsetLimitFixed, OffsetLimitRabbidPublished,
    ParallaxSlopeNz, ParallaxSlopeNv, ParallaxIter, Linear, LinearThesis, HeightOutward,
    HeightOutwardPublished, Steep, SteepPublished, SteepConstantXy, SteepConstantXyPublished,
    SteepAdaptive, SteepAdaptiveRabbid, SteepQuality, SteepMipC, SteepMipI, Pom, PomDxsdk,
    RabbidPom, ReliefBinary, ReliefGg3, RabbidRelief, ThesisLinearBinary,
    ThesisLinearBinaryPublished, Secant, Interval, Contact, ThesisSphere, Babylon, Bevy, Godot,
    JMonkey, LearnOpenGl, O3de, PlayCanvas, ThreeParallax, ThreeParallaxUv, UnityPom,
    UnrealBumpOffset, SteepMaxmip, ConeStep, ConeQuad, ConeAniso, ConeHybrid, ConeRobust,
    RelaxedCone, RelaxedConeExact, RelaxedConePublished, ConeRobustExactOnRanges, ConeGg3,
    ConeDummerExact, ConeRabbid, ConeRabbidFloat, Sphere3dOnRanges, Sphere3dPublished,
    FirstHitOnRanges<TexelExact>, FirstHitOnRanges<MaxMip>, FirstHitOnRanges<ConeCell>,
    FirstHitOnRanges<RmqLeap>, FirstHitOnRanges<Ddm>, FirstHitOnRanges<Qdm, oracle::Surface::block>,
    FirstHitOnRanges<Pyramid, oracle::Surface::block>, OracleOnRanges<oracle::Surface::bilinear>,
    OracleOnRanges<oracle::Surface::block>, OracleOnRanges<oracle::Surface::tri_main>,
    OracleOnRanges<oracle::Surface::tri_anti>, OracleOnRanges<oracle::Surface::tri_min>, Gdm, Vdm,
    ReliefPrewarpOnRanges, DualDepth, DualDepthPublished, LayersOnRanges<DualDepthExact, 1>,
    Multilayer, MultilayerPublished, LayersOnRanges<MultilayerExact, 2>, TrueImpostor,
    PrismExactOnRanges, PrismPom,
    // hit, surface
    ClipUv, ClipPath, Displace, FragDepth, FragDepthPublished, SurfaceNone, H2nThesis,
    H2nThesisPublished, H2nGather, H2nGatherPublished, H2n4Tap, H2n4TapPublished, H2nSobel,
    H2nSobelPublished, H2nPatchOnRanges, H2nLayers, H2nImpostor, BumpBlinn, BumpNoise,
    BumpNoisePublished, NormalMap, NormalMapFlightGear, NormalSmoothMcGuire, NormalMcGuirePublished,
    NormalWelshPublished, NormalLayers, NormalLayersPublished,
    // shadow, occlusion
    ShadowNone, ShadowMarchThesis, ShadowMarchThesisPublished, ShadowMarchMcguire,
    ShadowMarchMcguirePublished, ShadowRelief, ShadowSoftPom, ShadowSoftPomPublished,
    ShadowSoftRiccardi, ShadowCone, ShadowExactOnRanges, ShadowOracleOnRanges, Horizon,
    ShadowLayers, ShadowLayersExactOnRanges, OcclusionNone, AoHorizon, AoOracleOnRanges,
    // shade
    ShadeTexture, ShadeThesis, ShadeThesisPublished, ShadeWelsh, ShadeWelshPublished, ShadeMcGuire,
    ShadeMcGuirePublished, ShadeRabbid, ShadeRabbidPublished, ShadeGg3, ShadeLambert, ShadePhong,
    ShadeBlinnPhong, ShadeCookTorrance, ShadeMetallicRoughness, ShadeLayers, ShadeDebug>;

}  // namespace quadrel
