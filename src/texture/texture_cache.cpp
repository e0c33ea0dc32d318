#include "quadrel/texture/texture_cache.hpp"

#include <algorithm>
#include <utility>

#include "file/file_hash.hpp"
#include "texture/make_texture.hpp"

namespace quadrel {

namespace {

/// Of requests for one image this is equal.
std::string image_id(const TextureRequest& request, const std::string& file) {
    return file + '\n' + request.selection.part + '\n' + request.selection.layer;
}

/// Who refuses texels that are not finite is not given the texture of someone who keeps them.
std::string texture_key(const TextureRequest& request, const std::string& image) {
    const char* const kept = request.not_finite == NotFinite::count ? " with NaN" : "";
    return texture_id(image, request.options) + kept;
}

}  // namespace

std::shared_ptr<const Texture> TextureCache::find(const std::string& id) {
    const std::lock_guard lock(mutex_);
    const auto found = textures_.find(id);
    return found == textures_.end() ? nullptr : found->second.lock();
}

std::shared_ptr<const Texture> TextureCache::add(const std::string& id,
                                                 std::shared_ptr<const Texture> made) {
    const std::lock_guard lock(mutex_);
    std::erase_if(textures_, [](const auto& entry) { return entry.second.expired(); });
    ++made_;
    if (auto found = textures_[id].lock()) return found;
    textures_[id] = made;
    return made;
}

void TextureCache::keep(const std::string& name, std::shared_ptr<const Texture> texture) {
    const std::lock_guard lock(mutex_);
    kept_.insert_or_assign(name, std::move(texture));
}

void TextureCache::clear() {
    const std::lock_guard lock(mutex_);
    kept_.clear();
}

std::vector<std::shared_ptr<const Texture>> TextureCache::load(
    std::span<const TextureRequest> requests) {
    std::vector<std::shared_ptr<const Texture>> textures;
    std::vector<std::string> images, keys;
    for (const TextureRequest& request : requests) {
        images.push_back(image_id(request, file_hash(request.file, request.options.key)));
        keys.push_back(texture_key(request, images.back()));
        textures.push_back(find(keys.back()));
    }
    for (std::size_t i = 0; i < requests.size(); ++i) {
        if (textures[i]) continue;
        const TextureRequest& first = requests[i];
        const Image image =
            load_image(first.file, first.not_finite, first.options.key, first.selection);
        for (std::size_t j = i; j < requests.size(); ++j) {
            if (images[j] != images[i] || requests[j].not_finite != first.not_finite) continue;
            if (!textures[j]) textures[j] = find(keys[j]);
            if (!textures[j])
                textures[j] = add(keys[j], make_texture(image, requests[j].options, images[j]));
        }
    }
    for (std::size_t i = 0; i < requests.size(); ++i)
        keep(texture_key(requests[i], image_id(requests[i], requests[i].file.string())),
             textures[i]);
    return textures;
}

std::shared_ptr<const Texture> TextureCache::load(const std::filesystem::path& file,
                                                  const TextureOptions& options,
                                                  NotFinite not_finite,
                                                  const ImageSelection& selection) {
    const TextureRequest request{file, options, not_finite, selection};
    return load(std::span(&request, 1)).front();
}

std::shared_ptr<const Texture> TextureCache::load_cube(
    const std::array<std::filesystem::path, 6>& faces, const TextureOptions& options,
    const std::array<ImageSelection, 6>& selections) {
    std::array<TextureRequest, 6> requests;
    std::array<std::string, 6> images;
    std::string hashes, names;
    for (std::size_t i = 0; i < 6; ++i) {
        requests[i] = {faces[i], options, NotFinite::refuse, selections[i]};
        images[i] = image_id(requests[i], file_hash(faces[i], options.key));
        hashes += images[i] + '\n';
        names += image_id(requests[i], faces[i].string()) + '\n';
    }
    const std::string key = texture_id(hashes, options);
    auto texture = find(key);
    if (!texture) {
        std::array<Image, 6> loaded;
        for (std::size_t i = 0; i < 6; ++i) {
            const auto same =
                static_cast<std::size_t>(std::ranges::find(images, images[i]) - images.begin());
            loaded[i] = same < i ? loaded[same]
                                 : load_image(faces[i], NotFinite::refuse,
                                              options.key + ".faces[" + std::to_string(i) + "]",
                                              selections[i]);
        }
        texture = add(key, make_cube_texture(loaded, options, hashes));
    }
    keep(texture_id(names, options), texture);
    return texture;
}

}  // namespace quadrel
