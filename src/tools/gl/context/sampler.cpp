#include "gl/context/sampler.hpp"

namespace quadrel::gl {
namespace {

GLint gl_wrap(Wrap wrap) {
    switch (wrap) {
        case Wrap::repeat:
            return GL_REPEAT;
        case Wrap::mirrored_repeat:
            return GL_MIRRORED_REPEAT;
        case Wrap::clamp_to_edge:
            return GL_CLAMP_TO_EDGE;
        case Wrap::mirror_once:
            return GL_MIRROR_CLAMP_TO_EDGE;
        case Wrap::clamp_to_border:
            break;
    }
    return GL_CLAMP_TO_BORDER;
}

GLint gl_min(const SamplerState& sampler, int levels) {
    const bool linear = sampler.min == Filter::linear;
    if (levels == 1 || sampler.mip == MipFilter::none) return linear ? GL_LINEAR : GL_NEAREST;
    if (sampler.mip == MipFilter::nearest)
        return linear ? GL_LINEAR_MIPMAP_NEAREST : GL_NEAREST_MIPMAP_NEAREST;
    return linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_LINEAR;
}

}  // namespace

void set_sampler(GLenum target, const SamplerState& sampler, int levels) {
    glTexParameteri(target, GL_TEXTURE_MAX_LEVEL, levels - 1);
    glTexParameteri(target, GL_TEXTURE_WRAP_S, gl_wrap(sampler.wrap_u));
    glTexParameteri(target, GL_TEXTURE_WRAP_T, gl_wrap(sampler.wrap_v));
    glTexParameteri(target, GL_TEXTURE_MIN_FILTER, gl_min(sampler, levels));
    glTexParameteri(target, GL_TEXTURE_MAG_FILTER,
                    sampler.mag == Filter::linear ? GL_LINEAR : GL_NEAREST);
    glTexParameterfv(target, GL_TEXTURE_BORDER_COLOR, sampler.border);
    glTexParameterf(target, GL_TEXTURE_LOD_BIAS, sampler.lod_bias);
    glTexParameterf(target, GL_TEXTURE_MIN_LOD, sampler.lod_min);
    glTexParameterf(target, GL_TEXTURE_MAX_LOD, sampler.lod_max);
}

}  // namespace quadrel::gl
