// The channels that an exported scene's shaders write, and which target of which pass has each.
#pragma once

#include <string>
#include <vector>

#include "export/table.hpp"
#include "quadrel/film/film.hpp"
#include "quadrel/scene/scene.hpp"
#include "render/plan/channel_source.hpp"

namespace quadrel {

struct ExportedChannel {
    std::string name;
    ChannelType type = ChannelType::float32;
    ProgramChannel source;
    std::uint32_t clear = 0;  ///< its bits where nothing is drawn
};

/// All that a shader can tell of a scene: what its stages store, and levels of detail where the
/// language has them.
std::vector<std::string> exportable_channels(const Scene& scene, const std::string& language);

/// Throws UsageError for a channel that no shader writes.
std::vector<ExportedChannel> exported_channels(const Scene& scene,
                                               const std::vector<std::string>& names);

/// Passes of at most so many targets, each of four channels; those of a vector lie in one target.
std::vector<ProgramPass> passes_of(const std::vector<ExportedChannel>& channels, int targets);

/// The channel that a component of a target is of.
const ExportedChannel& channel_of(const std::vector<ExportedChannel>& channels,
                                  const ProgramChannel& source);

/// How many targets at once a language is sure to have.
int targets_at_once(const std::string& language);

}  // namespace quadrel
