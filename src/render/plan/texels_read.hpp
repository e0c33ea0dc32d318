// Which textures have but a part of their texels read, so that nothing else is made.
#pragma once

#include "render/plan/plan.hpp"

namespace quadrel {

/// Of a material's slots. Faces of an environment, and slots that stages from outside may read as
/// they like, are in neither set.
struct TexelsRead {
    /// No planned stage can read a coarser level, whatever is drawn: the sampler takes none, or
    /// only stages read the map that say that they read texels of level 0.
    SlotSet finest_level;
    /// Only stages read the map that say that they read its first channel alone, and the scene has
    /// not said which channels it shall have.
    SlotSet first_channel;
};

/// `plans`: all that run of the material.
TexelsRead texels_read(const Material& material, const std::vector<const MaterialPlan*>& plans);

}  // namespace quadrel
