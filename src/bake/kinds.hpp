// What is known about each kind besides its public description.
#pragma once

#include "bake/job.hpp"
#include "quadrel/bake/bake.hpp"

namespace quadrel {

/// What a generator takes: heights in the first channel, or depth layers in all of them.
enum class Heights { any, finite, layers };

struct BakeKindRow {
    BakeKindInfo info;
    Generator generate;
    Heights heights;
    double (*seconds)(double texels);  ///< on one core where heights are easy; `texels` stored
};

/// In the order of the enumeration.
const std::vector<BakeKindRow>& bake_rows();
const BakeKindRow& bake_row(BakeKind kind);

/// All parameters of a kind: as given, or their standard values. Throws UsageError for parameters
/// that it has not or that are out of range.
std::map<std::string, double> complete_parameters(const BakeKindInfo& kind,
                                                  const BakeOptions& options);

/// SHA-256 over all that a kind reads of its source: height_id, or every channel of layers.
std::string source_id(const Texture& source, BakeKind kind);

/// baked_id() of heights with that name.
std::string baked_id_of(const std::string& heights, BakeKind kind, const SamplerState& sampler,
                        const BakeOptions& options);
/// bake() of a map that is to have that id.
std::shared_ptr<const Texture> bake_as(const std::string& id, const Texture& height, BakeKind kind,
                                       const SamplerState& sampler, const BakeOptions& options);

}  // namespace quadrel
