// Whether a stage from outside can be planned among the others.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "quadrel/relief/registry.hpp"

namespace quadrel {

/// What is wrong with a stage, for a message.
struct StageFault {
    std::string stage;  ///< its id
    std::string found, expected;
};

/// The first fault of a row beside the stages that there are: an id that is taken or unreadable, a
/// room that scenes do not choose from, values or textures that do not exist, inputs that come only
/// later in the data flow, outputs that its room does not store, parameters without sense.
std::optional<StageFault> find_fault(const StageRow& row, std::span<const StageInfo> others);

}  // namespace quadrel
