#include "llvmpipe/textures.hpp"

#include <algorithm>
#include <stdexcept>

#include "gl/context/sampler.hpp"
#include "scene_maps.hpp"

namespace quadrel::peers {
namespace {

const TextureReference* reference_of(const Scene& scene, const std::string& slot) {
    const auto& textures = scene.materials.at(0).textures;
    const auto found = textures.find(slot);
    return found == textures.end() ? nullptr : &found->second;
}

struct Format {
    GLenum internal, external;
};

Format format_of(int channels) {
    static constexpr Format all[] = {
        {GL_R32F, GL_RED}, {GL_RG32F, GL_RG}, {}, {GL_RGBA32F, GL_RGBA}};
    return all[channels - 1];
}

void upload(GLenum target, int level, const TextureView& view, const float* texels) {
    const Format format = format_of(view.channels);
    glTexImage2D(target, level, static_cast<GLint>(format.internal), view.width[level],
                 view.height[level], 0, format.external, GL_FLOAT, texels);
}

GLuint made(GLenum target, const Texture& texture, const SamplerState& sampler) {
    GLuint name = 0;
    glGenTextures(1, &name);
    glBindTexture(target, name);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    const TextureView& view = texture.view();
    for (int level = 0; level < view.levels; ++level)
        for (int face = 0; face < view.faces; ++face)
            upload(target == GL_TEXTURE_2D
                       ? target
                       : GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face),
                   level, view, texture.level_texels(level, face));
    gl::set_sampler(target, sampler, view.levels);
    return name;
}

/// The greatest of each four texels; both sides are even.
std::vector<float> halved(const std::vector<float>& fine, int side) {
    const int half = side / 2;
    std::vector<float> coarse(static_cast<std::size_t>(half) * static_cast<std::size_t>(half));
    for (int y = 0; y < half; ++y)
        for (int x = 0; x < half; ++x) {
            const float* const texel = &fine[static_cast<std::size_t>(2 * y * side + 2 * x)];
            coarse[static_cast<std::size_t>(y * half + x)] =
                std::max({texel[0], texel[1], texel[side], texel[side + 1]});
        }
    return coarse;
}

}  // namespace

GLuint material_texture(const Scene& scene, const std::string& slot) {
    const TextureReference* const reference = reference_of(scene, slot);
    if (reference == nullptr) return 0;
    return made(GL_TEXTURE_2D, *load_map(scene, *reference), reference->sampler);
}

GLuint environment_texture(const Scene& scene) {
    if (!scene.environment) return 0;
    const Environment& environment = *scene.environment;
    TextureOptions options;
    options.srgb = environment.srgb;
    options.format = environment.format;
    options.mip_rule = environment.mip_rule;
    return made(GL_TEXTURE_CUBE_MAP,
                *scene.texture_cache->load_cube(environment.faces, options, environment.selections),
                environment.sampler);
}

GLuint max_pyramid(const Scene& scene) {
    const auto texture = load_map(scene, *reference_of(scene, "height"));
    int side = texture->view().width[0], level = 0;
    const float* const texels = texture->level_texels(0, 0);
    std::vector<float> heights(texels, texels + side * side);
    GLuint name = 0;
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    for (;; ++level) {
        glTexImage2D(GL_TEXTURE_2D, level, GL_R32F, side, side, 0, GL_RED, GL_FLOAT,
                     heights.data());
        if (side == 1) break;
        heights = halved(heights, side);
        side /= 2;
    }
    SamplerState nearest;
    nearest.min = nearest.mag = Filter::nearest;
    nearest.mip = MipFilter::nearest;
    gl::set_sampler(GL_TEXTURE_2D, nearest, level + 1);
    return name;
}

}  // namespace quadrel::peers
