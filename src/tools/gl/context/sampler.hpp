// A sampler's state in OpenGL.
#pragma once

#include <epoxy/gl.h>

#include "quadrel/texture/format.hpp"

namespace quadrel::gl {

/// Wrap modes, filters, border colour, bias and range of levels of the texture bound to `target`,
/// whose `levels` are all there.
void set_sampler(GLenum target, const SamplerState& sampler, int levels);

/// A sampler object of that state, for textures of so many levels. The caller deletes it.
GLuint make_sampler(const SamplerState& state, int levels);

}  // namespace quadrel::gl
