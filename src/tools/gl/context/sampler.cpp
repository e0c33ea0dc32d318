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

/// Sets each parameter by `set`, which takes a name and a GLint, a float or floats.
template <class Set>
void set_state(const SamplerState& sampler, int levels, const Set& set) {
    set(GL_TEXTURE_WRAP_S, gl_wrap(sampler.wrap_u));
    set(GL_TEXTURE_WRAP_T, gl_wrap(sampler.wrap_v));
    set(GL_TEXTURE_MIN_FILTER, gl_min(sampler, levels));
    set(GL_TEXTURE_MAG_FILTER, sampler.mag == Filter::linear ? GL_LINEAR : GL_NEAREST);
    set(GL_TEXTURE_BORDER_COLOR, sampler.border);
    set(GL_TEXTURE_LOD_BIAS, sampler.lod_bias);
    set(GL_TEXTURE_MIN_LOD, sampler.lod_min);
    set(GL_TEXTURE_MAX_LOD, sampler.lod_max);
}

struct OfTexture {
    GLenum target;
    void operator()(GLenum name, GLint value) const { glTexParameteri(target, name, value); }
    void operator()(GLenum name, float value) const { glTexParameterf(target, name, value); }
    void operator()(GLenum name, const float* values) const {
        glTexParameterfv(target, name, values);
    }
};

struct OfSampler {
    GLuint sampler;
    void operator()(GLenum name, GLint value) const { glSamplerParameteri(sampler, name, value); }
    void operator()(GLenum name, float value) const { glSamplerParameterf(sampler, name, value); }
    void operator()(GLenum name, const float* values) const {
        glSamplerParameterfv(sampler, name, values);
    }
};

}  // namespace

void set_sampler(GLenum target, const SamplerState& sampler, int levels) {
    glTexParameteri(target, GL_TEXTURE_MAX_LEVEL, levels - 1);
    set_state(sampler, levels, OfTexture{target});
}

GLuint make_sampler(const SamplerState& state, int levels) {
    GLuint sampler = 0;
    glGenSamplers(1, &sampler);
    set_state(state, levels, OfSampler{sampler});
    return sampler;
}

}  // namespace quadrel::gl
