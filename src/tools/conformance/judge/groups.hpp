// Channels by their place in the data flow, so that each stage is judged by what came before it.
#pragma once

#include <string>
#include <vector>

#include "quadrel/film/film.hpp"
#include "quadrel/scene/scene.hpp"

namespace quadrel::conformance {

enum class GroupKind {
    coverage,
    geometry,
    derivatives,
    level,
    frame,
    hit,
    normal,
    shadow,
    occlusion,
    color
};

struct Group {
    GroupKind kind;
    std::string name;
    std::vector<std::string> channels;  ///< full names, of which both films have planes
};

/// The groups of the channels that both films of the scene have, without those that have none. A
/// frame that a search turns is part of the hit: channels have what is left in the end. Throws
/// std::logic_error for a channel that belongs nowhere.
std::vector<Group> groups_of(const Scene& scene, const Film& reference, const Film& found);

/// Those of the channels that stages store, so that they can be injected; each once.
std::vector<std::string> injectable(const std::vector<std::string>& channels);

}  // namespace quadrel::conformance
