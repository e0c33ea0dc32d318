// Parameters of which each value has a name, in a scene's document.
#pragma once

#include "io/document/json.hpp"

namespace quadrel {

/// Writes their numbers as names, so that one scene has one canonical form. Throws InputError for
/// what is no number where a stage's parameter has no such name.
void name_choices(SceneDocument& document);

}  // namespace quadrel
