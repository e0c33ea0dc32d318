// The stages that a scene's document names, and where their parameters stand.
#pragma once

#include <string>

#include "io/document/json.hpp"

namespace quadrel {

/// The member of that key; null where there is none, or no object.
const Json* member_of(const Json* object, const std::string& key);

/// The text of a string, else empty.
std::string text_of(const Json* value);

/// The id that `owner`, a material or its relief, names for a room; empty: the default stage.
std::string named_stage(const Json* owner, const std::string& room);

}  // namespace quadrel
