// The generators, one a kind.
#pragma once

#include "bake/job.hpp"

namespace quadrel {

std::shared_ptr<Texture> bake_max_mip(const BakeJob& job);
std::shared_ptr<Texture> bake_min_max(const BakeJob& job);
std::shared_ptr<Texture> bake_texel_max(const BakeJob& job);

}  // namespace quadrel
