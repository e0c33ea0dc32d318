#include "quadrel/texture/texture.hpp"

#include <sys/mman.h>

#include <cstring>
#include <new>
#include <utility>

#include "quadrel/check.hpp"

namespace quadrel {

namespace {

constexpr std::size_t alignment = 64, huge_page = std::size_t{2} << 20;

/// Of the texels of a whole texture, that of huge pages where it has some.
std::align_val_t alignment_of(std::size_t bytes) {
    return std::align_val_t{bytes < huge_page ? alignment : huge_page};
}

/// Look-ups all over a large map miss the processor's table of pages, and filling it takes a fault
/// a page. A wish: where the system does not grant it, nothing is lost.
void ask_for_huge_pages([[maybe_unused]] void* texels, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
    if (bytes >= huge_page) madvise(texels, bytes / huge_page * huge_page, MADV_HUGEPAGE);
#endif
}

std::size_t total_floats(const TextureView& view) {
    const int last = view.levels - 1;
    return static_cast<std::size_t>(view.offset[last]) +
           static_cast<std::size_t>(view.width[last]) * view.height[last] * view.channels *
               view.faces;
}

}  // namespace

void Texture::Free::operator()(float* texels) const {
    ::operator delete[](texels, alignment_of(bytes));
}

Texture::Texture(const TextureView& layout, TexelFormat format, std::string id)
    : view_(layout), format_(format), id_(std::move(id)) {
    const std::size_t bytes = total_floats(layout) * sizeof(float);
    texels_ = {static_cast<float*>(::operator new[](bytes, alignment_of(bytes))), Free{bytes}};
    ask_for_huge_pages(texels_.get(), bytes);
    std::memset(texels_.get(), 0, bytes);
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
