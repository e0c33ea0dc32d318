// The probes for a page that puts them to a browser's own GPU.
#pragma once

#include <string>

namespace quadrel::rules {

/// What data/page/rules_gl.js draws and data/page/rules.js shows: of each probe its texts, the
/// shader in GLSL ES 3.0, triangles, textures and numbers, and the answers of each preset of
/// `hardware`; or why a browser cannot be asked. Numbers are bits in lists, all of them packed one
/// after the other ("numbers", with their "lengths"), and the rest has the lists' numbers: one for
/// each component, x first; of the answers of all presets but the first, what differs from its
/// bits. JSON, by page::packed_text.
std::string probes_for_page();

}  // namespace quadrel::rules
