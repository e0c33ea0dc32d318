// A glman scene file as a scene of our own format.
#pragma once

#include <filesystem>
#include <string_view>

#include "io/document/json.hpp"

namespace quadrel {

/// The scene that `text` describes, as if it had been written in JSON: data/scenes/README.md tells
/// what each command becomes. Positions are those of the words in `text`. Throws InputError for
/// anything that glman's file should not have or that is not understood.
SceneDocument parse_glib_text(std::string_view text, const std::filesystem::path& file);

}  // namespace quadrel
