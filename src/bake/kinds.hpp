// What is known about each kind besides its public description.
#pragma once

#include "bake/job.hpp"
#include "quadrel/bake.hpp"

namespace quadrel {

/// What a generator takes.
enum class Heights { any, finite };

struct BakeKindRow {
    BakeKindInfo info;
    Generator generate;
    int version;  ///< raised whenever a generator gives other values than before
    Heights heights;
    double (*seconds)(double texels);  ///< at most, on one core; `texels` stored
};

/// In the order of the enumeration.
const std::vector<BakeKindRow>& bake_rows();
const BakeKindRow& bake_row(BakeKind kind);

}  // namespace quadrel
