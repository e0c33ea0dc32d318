// Probes put to the current context of OpenGL.
#pragma once

#include "rules/probe.hpp"

namespace quadrel::gl {

using rules::Corner, rules::Probe, rules::ProbeTexture, rules::Question, rules::Triangle,
    rules::Values;

/// What the context answers, bit for bit.
Values ask_gl(const Question& question);

/// Of probes that are no question over triangles, too.
Values answers_of_gl(const Probe& probe);

/// x and y of each of a pixel's samples, in 1/16 pixel. Throws std::runtime_error where there are
/// no targets of so many.
Values seen_sample_positions();

}  // namespace quadrel::gl
