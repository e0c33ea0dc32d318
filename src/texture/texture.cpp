#include "quadrel/texture/texture.hpp"

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

#include "quadrel/check.hpp"

namespace quadrel {

namespace {

constexpr std::size_t cache_line = 64, huge_page = std::size_t{2} << 20;

/// Look-ups all over a large map miss the processor's table of pages, and filling it takes a fault
/// a page. A wish: where the system does not grant it, nothing is lost.
void ask_for_huge_pages([[maybe_unused]] void* texels, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
    if (bytes >= huge_page) madvise(texels, bytes / huge_page * huge_page, MADV_HUGEPAGE);
#endif
}

/// Zeros, behind a pointer to what was allocated. Large blocks come from the system as zeros, page
/// by page as they are first written, which may be in many threads.
float* allocate_zeros(std::size_t floats) {
    const std::size_t bytes = floats * sizeof(float);
    const std::size_t alignment = bytes < huge_page ? cache_line : huge_page;
    void* const block = std::calloc(bytes + sizeof(void*) + alignment, 1);
    if (block == nullptr) throw std::bad_alloc();
    const std::uintptr_t first = reinterpret_cast<std::uintptr_t>(block) + sizeof(void*);
    auto* const texels =
        reinterpret_cast<char*>(block) +
        ((first + alignment - 1) / alignment * alignment - reinterpret_cast<std::uintptr_t>(block));
    std::memcpy(texels - sizeof(void*), &block, sizeof(void*));
    ask_for_huge_pages(texels, bytes);
    return reinterpret_cast<float*>(texels);
}

std::size_t total_floats(const TextureView& view) {
    const int last = view.levels - 1;
    return static_cast<std::size_t>(view.offset[last]) +
           static_cast<std::size_t>(view.width[last]) * view.height[last] * view.channels *
               view.faces;
}

}  // namespace

void Texture::Free::operator()(float* texels) const {
    void* block = nullptr;
    std::memcpy(&block, reinterpret_cast<char*>(texels) - sizeof(void*), sizeof(void*));
    std::free(block);
}

Texture::Texture(const TextureView& layout, TexelFormat format, std::string id)
    : view_(layout), format_(format), id_(std::move(id)) {
    texels_.reset(allocate_zeros(total_floats(layout)));
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
