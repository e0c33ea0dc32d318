#include "render/stats/touched_texels.hpp"

#include <bit>

namespace quadrel {
namespace {

constexpr int line_floats = 16;  // 64 bytes

/// Texels of a level, all faces.
std::int64_t level_texels(const TextureView& view, int level) {
    return std::int64_t(view.width[level]) * view.height[level] * view.faces;
}

std::size_t words_of(const TextureView& view) {
    const int last = view.levels - 1;
    const std::int64_t texels = view.offset[last] / view.channels + level_texels(view, last);
    return static_cast<std::size_t>((texels + 63) / 64);
}

}  // namespace

TouchedTexels::TouchedTexels(const RenderPlan& plan) : plan_(plan) {
    for (const MaterialTextures& textures : plan.textures)
        for (const auto& owned : textures.owned) {
            if (!owned || marked_.count(owned.get())) continue;
            auto marked = std::make_unique<Marked>();
            marked->words.resize(words_of(owned->view()));
            marked->marks.words = marked->words.data();
            marked_.emplace(owned.get(), std::move(marked));
        }
}

const Texture* TouchedTexels::texture(std::uint32_t material, int slot) const {
    return plan_.textures[material].owned[static_cast<std::size_t>(slot)].get();
}

const TexelMarks* TouchedTexels::marks(std::uint32_t material, int slot) const {
    const auto found = marked_.find(texture(material, slot));
    return found == marked_.end() ? nullptr : &found->second->marks;
}

/// Levels begin at multiples of 64 bytes, and so do textures: a line is a group of neighbouring
/// bits that lies in one word.
TouchedStats TouchedTexels::count(const Texture& texture, int level) const {
    const TextureView& view = texture.view();
    const auto& words = marked_.at(&texture)->words;
    const std::int64_t group = line_floats / view.channels;
    const std::uint64_t mask = (std::uint64_t(1) << group) - 1;
    const std::int64_t first = view.offset[level] / view.channels;
    TouchedStats sum;
    for (std::int64_t texel = first; texel < first + level_texels(view, level); texel += group) {
        const std::uint64_t bits = words[static_cast<std::size_t>(texel / 64)] >> (texel % 64);
        sum.texels += static_cast<std::uint64_t>(std::popcount(bits & mask));
        sum.lines += (bits & mask) != 0 ? 1 : 0;
    }
    return sum;
}

TouchedStats TouchedTexels::count(std::uint32_t material, int slot, int level) const {
    return count(*texture(material, slot), level);
}

TouchedStats TouchedTexels::total() const {
    TouchedStats sum;
    for (const auto& [texture, marked] : marked_)
        for (int level = 0; level < texture->view().levels; ++level) sum += count(*texture, level);
    return sum;
}

}  // namespace quadrel
