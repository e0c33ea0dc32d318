// A question's shaders in GLSL, the same text for every version.
#pragma once

#include <string>

#include "rules/ask/question.hpp"

namespace quadrel::rules {

/// `head`: "#version", and what has to stand behind it. Attributes are `position` and `corner`.
std::string vertex_text(const std::string& head);

/// Writes the bits of answers into a target of four unsigned integers, and reads those of what is
/// asked from the texture `numbers`, whose texels are pixels.
std::string fragment_text(const Question& question, const std::string& head);

}  // namespace quadrel::rules
