// The list of shading stages; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/shade/blinn_phong.hpp"
#include "quadrel/shade/cook_torrance.hpp"
#include "quadrel/shade/debug.hpp"
#include "quadrel/shade/gg3.hpp"
#include "quadrel/shade/lambert.hpp"
#include "quadrel/shade/layers.hpp"
#include "quadrel/shade/mcguire.hpp"
#include "quadrel/shade/mcguire_published.hpp"
#include "quadrel/shade/metallic_roughness.hpp"
#include "quadrel/shade/phong.hpp"
#include "quadrel/shade/rabbid.hpp"
#include "quadrel/shade/rabbid_published.hpp"
#include "quadrel/shade/texture.hpp"
#include "quadrel/shade/thesis.hpp"
#include "quadrel/shade/thesis_published.hpp"
#include "quadrel/shade/welsh.hpp"
#include "quadrel/shade/welsh_published.hpp"

namespace quadrel {

using ShadeStages =
    StageList<ShadeTexture, ShadeThesis, ShadeThesisPublished, ShadeWelsh, ShadeWelshPublished,
              ShadeMcGuire, ShadeMcGuirePublished, ShadeRabbid, ShadeRabbidPublished, ShadeGg3,
              ShadeDebug, ShadeLambert, ShadePhong, ShadeBlinnPhong, ShadeCookTorrance,
              ShadeMetallicRoughness, ShadeLayers>;

}  // namespace quadrel
