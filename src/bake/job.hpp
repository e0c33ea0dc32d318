// What a generator is given, and what all generators use: rows in parallel with progress, textures
// of any layout.
#pragma once

#include <tbb/parallel_for.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bake/height_plane.hpp"
#include "bake/layout.hpp"
#include "bake/progress.hpp"

namespace quadrel {

struct BakeJob {
    const Texture& source;     ///< all channels of what the plane is made of
    const HeightPlane& plane;  ///< of its first channel
    const SamplerState& sampler;
    const std::map<std::string, double>& parameters;  ///< all that the kind has
    const std::string& id;                            ///< of the result
    Progress& progress;

    double parameter(const char* name) const { return parameters.at(name); }
    int whole(const char* name) const { return static_cast<int>(parameters.at(name)); }

    /// Zeroed texels: levels one after the other, each of `layers` images. Throws InputError when
    /// they are more than a texture may hold.
    std::shared_ptr<Texture> make(int channels, int layers,
                                  const std::vector<LevelSize>& levels) const;

    /// Calls row(j) for 0 <= j < rows, in parallel, as the next `share` of the whole work.
    template <class Row>
    void rows(int count, double share, const Row& row) const {
        tbb::parallel_for(0, count, [&](int j) {
            row(j);
            progress.add(share / count);
        });
    }
};

/// A map of a kind; `progress` is told the whole of the work.
using Generator = std::shared_ptr<Texture> (*)(const BakeJob& job);

}  // namespace quadrel
