#include "quadrel/texture/texture.hpp"

#include <cstring>
#include <new>
#include <utility>

#include "quadrel/check.hpp"

namespace quadrel {

namespace {

constexpr std::align_val_t alignment{64};

std::size_t total_floats(const TextureView& view) {
    const int last = view.levels - 1;
    return static_cast<std::size_t>(view.offset[last]) +
           static_cast<std::size_t>(view.width[last]) * view.height[last] * view.channels *
               view.faces;
}

}  // namespace

void Texture::Free::operator()(float* texels) const { ::operator delete[](texels, alignment); }

Texture::Texture(const TextureView& layout, TexelFormat format, std::string id)
    : view_(layout), format_(format), id_(std::move(id)) {
    const std::size_t floats = total_floats(layout);
    texels_.reset(static_cast<float*>(::operator new[](floats * sizeof(float), alignment)));
    std::memset(texels_.get(), 0, floats * sizeof(float));
    view_.texels = texels_.get();
}

const float* Texture::level_texels(int level, int face) const {
    QUADREL_CHECK_OP(<, level, view_.levels);
    QUADREL_CHECK_OP(<, face, view_.faces);
    const std::size_t face_floats =
        static_cast<std::size_t>(view_.width[level]) * view_.height[level] * view_.channels;
    return texels_.get() + view_.offset[level] + face * face_floats;
}

float* Texture::level_texels(int level, int face) {
    return const_cast<float*>(std::as_const(*this).level_texels(level, face));
}

Image texture_level(const Texture& texture, int level, int face) {
    const TextureView& view = texture.view();
    Image image;
    image.width = view.width[level];
    image.height = view.height[level];
    image.channels = view.channels;
    image.format = TexelFormat::float32;
    const float* from = texture.level_texels(level, face);
    image.values.assign(
        from, from + static_cast<std::size_t>(image.width) * image.height * image.channels);
    return image;
}

}  // namespace quadrel
