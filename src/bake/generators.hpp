// The generators, one per kind.
#pragma once

#include "bake/job.hpp"

namespace quadrel {

std::shared_ptr<Texture> bake_max_mip(const BakeJob& job);
std::shared_ptr<Texture> bake_min_max(const BakeJob& job);
std::shared_ptr<Texture> bake_texel_max(const BakeJob& job);
std::shared_ptr<Texture> bake_cone(const BakeJob& job);
std::shared_ptr<Texture> bake_cone_robust(const BakeJob& job);
std::shared_ptr<Texture> bake_cone_quick(const BakeJob& job);
std::shared_ptr<Texture> bake_cone_rabbid(const BakeJob& job);
std::shared_ptr<Texture> bake_cone_cell(const BakeJob& job);
std::shared_ptr<Texture> bake_relaxed_cone(const BakeJob& job);
std::shared_ptr<Texture> bake_relaxed_cone_exact(const BakeJob& job);
std::shared_ptr<Texture> bake_quad_cone(const BakeJob& job);
std::shared_ptr<Texture> bake_aniso_cone(const BakeJob& job);
std::shared_ptr<Texture> bake_distance(const BakeJob& job);
std::shared_ptr<Texture> bake_distance_exact(const BakeJob& job);
std::shared_ptr<Texture> bake_horizon(const BakeJob& job);
std::shared_ptr<Texture> bake_horizon_sampled(const BakeJob& job);
std::shared_ptr<Texture> bake_normal_gather(const BakeJob& job);
std::shared_ptr<Texture> bake_normal_4tap(const BakeJob& job);
std::shared_ptr<Texture> bake_normal_sobel(const BakeJob& job);
std::shared_ptr<Texture> bake_rmq(const BakeJob& job);
std::shared_ptr<Texture> bake_layer_bounds(const BakeJob& job);
std::shared_ptr<Texture> bake_ddm(const BakeJob& job);
std::shared_ptr<Texture> bake_gdm(const BakeJob& job);
std::shared_ptr<Texture> bake_vdm(const BakeJob& job);

}  // namespace quadrel
