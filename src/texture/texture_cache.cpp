#include "quadrel/texture/texture_cache.hpp"

#include <fstream>
#include <iterator>

#include "quadrel/error.hpp"
#include "text/hash.hpp"

namespace quadrel {

namespace {

std::string file_hash(const std::filesystem::path& file, const std::string& key) {
    std::ifstream in(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    if (!in.is_open() || in.bad()) {
        throw InputError(file.string(), key, "a file that cannot be read", "a readable image");
    }
    return sha256_hex(bytes);
}

}  // namespace

template <class Make>
std::shared_ptr<const Texture> TextureCache::find_or_make(const std::string& key,
                                                          const Make& make) {
    const std::lock_guard lock(mutex_);
    if (auto found = textures_[key].lock()) return found;
    std::shared_ptr<const Texture> made = make();
    textures_[key] = made;
    return made;
}

std::shared_ptr<const Texture> TextureCache::load(const std::filesystem::path& file,
                                                  const TextureOptions& options,
                                                  NotFinite not_finite,
                                                  const ImageSelection& selection) {
    // Who refuses such texels is not given the texture of someone who keeps them.
    const char* const kept = not_finite == NotFinite::count ? " with NaN" : "";
    const std::string id = texture_id(file_hash(file, options.key), options) + kept;
    return find_or_make(id + '\n' + selection.part + '\n' + selection.layer, [&] {
        return make_texture(load_image(file, not_finite, options.key, selection), options);
    });
}

std::shared_ptr<const Texture> TextureCache::load_cube(
    const std::array<std::filesystem::path, 6>& faces, const TextureOptions& options,
    const std::array<ImageSelection, 6>& selections) {
    std::string hashes, parts;
    for (std::size_t i = 0; i < 6; ++i) {
        hashes += file_hash(faces[i], options.key);
        parts += '\n' + selections[i].part + '\n' + selections[i].layer;
    }
    return find_or_make(texture_id(hashes, options) + parts, [&] {
        std::array<Image, 6> images;
        for (std::size_t i = 0; i < 6; ++i)
            images[i] =
                load_image(faces[i], NotFinite::refuse,
                           options.key + ".faces[" + std::to_string(i) + "]", selections[i]);
        return make_cube_texture(images, options);
    });
}

}  // namespace quadrel
