#include "quadrel/texture/texture_cache.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "file/file_store.hpp"
#include "quadrel/error.hpp"
#include "text/first_error.hpp"
#include "texture/image_bytes.hpp"
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

/// The image of the file that has been found to have this hash.
Image load_hashed(const TextureRequest& request, const std::string& hash, const std::string& key,
                  FileStore& files) {
    const FileStore::Contents contents = files.take(request.file, request.options.key);
    if (contents.hash != hash)
        throw InputError(request.file.string(), key, "a file that changes while it is read",
                         "one that stays as it is");
    return load_image(*contents.bytes, request.not_finite, key, request.selection);
}

/// A half makes infinity of a large number, which who refuses infinite texels refuses, too.
void check_range(const Image& image, const TextureRequest& request) {
    if (request.options.format != TexelFormat::half || request.not_finite == NotFinite::count)
        return;
    constexpr float overflow = 65520;  // halfway from the largest half to what would be the next
    const auto& values = image.values;
    const auto first = std::find_if(values.begin(), values.end(),
                                    [](float x) { return !(std::abs(x) < overflow); });
    if (first == values.end()) return;
    const std::int64_t index = first - values.begin(), texel = index / image.channels;
    throw InputError(
        image.file.string(), request.options.key,
        fmt::format("{:g} in channel {} of the texel in column {}, row {}, which the "
                    "format half makes infinite",
                    *first, index % image.channels, texel % image.width, texel / image.width),
        "less than 65520, or the format float");
}

/// Whether several such files may be decoded at a time: what they come to is small.
bool is_small(const std::filesystem::path& file) {
    constexpr std::uintmax_t most = std::uintmax_t(4) << 20;
    std::error_code error;
    return std::filesystem::file_size(file, error) <= most && !error;
}

/// Calls work(i) for all i below `count`, those first, and side by side, whose file is small.
/// Throws what would have been thrown first in order.
template <class File, class Work>
void small_ones_together(std::size_t count, const File& file, const Work& work) {
    std::vector<std::size_t> small, large;
    for (std::size_t i = 0; i < count; ++i) (is_small(file(i)) ? small : large).push_back(i);
    FirstError error;
    tbb::parallel_for(std::size_t(0), small.size(),
                      [&](std::size_t i) { error.run(small[i], [&] { work(small[i]); }); });
    for (const std::size_t i : large) error.run(i, [&] { work(i); });
    error.rethrow();
}

/// The first of all that are equal.
template <class T>
std::size_t first_like(const T& all, std::size_t i) {
    return static_cast<std::size_t>(std::find(all.begin(), all.end(), all[i]) - all.begin());
}

}  // namespace

TextureCache::TextureCache() : files_(std::make_unique<FileStore>()) {}
TextureCache::~TextureCache() = default;

std::optional<ValueRange> TextureCache::range(
    const std::string& name, const std::function<std::optional<ValueRange>()>& measure) {
    {
        const std::lock_guard lock(mutex_);
        if (const auto found = ranges_.find(name); found != ranges_.end()) return found->second;
    }
    const auto measured = measure();
    const std::lock_guard lock(mutex_);
    return ranges_.emplace(name, measured).first->second;
}

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

std::shared_ptr<const Texture> TextureCache::kept(const std::string& name) {
    const std::lock_guard lock(mutex_);
    const auto found = kept_.find(name);
    return found == kept_.end() ? nullptr : found->second;
}

void TextureCache::clear() {
    const std::lock_guard lock(mutex_);
    kept_.clear();
    ranges_.clear();
    files_->forget();
}

std::vector<std::shared_ptr<const Texture>> TextureCache::load(
    std::span<const TextureRequest> requests) {
    std::vector<std::shared_ptr<const Texture>> textures;
    std::vector<std::string> hashes, images, keys;
    for (const TextureRequest& request : requests) {
        hashes.push_back(files_->file_hash(request.file, request.options.key));
        images.push_back(image_id(request, hashes.back()));
        keys.push_back(texture_key(request, images.back()));
        textures.push_back(find(keys.back()));
    }
    const auto is_one_image = [&](std::size_t i, std::size_t j) {
        return images[i] == images[j] && requests[i].not_finite == requests[j].not_finite;
    };
    // The first request for each image of which a texture is missing.
    std::vector<std::size_t> firsts;
    for (std::size_t i = 0; i < requests.size(); ++i)
        if (!textures[i] && std::none_of(firsts.begin(), firsts.end(),
                                         [&](std::size_t first) { return is_one_image(first, i); }))
            firsts.push_back(i);
    const auto make = [&](std::size_t n) {
        const std::size_t first = firsts[n];
        const Image image =
            load_hashed(requests[first], hashes[first], requests[first].options.key, *files_);
        for (std::size_t j = first; j < requests.size(); ++j) {
            if (!is_one_image(first, j)) continue;
            if (!textures[j]) textures[j] = find(keys[j]);
            if (textures[j]) continue;
            check_range(image, requests[j]);
            textures[j] = add(keys[j], make_texture(image, requests[j].options, images[j]));
        }
    };
    small_ones_together(
        firsts.size(), [&](std::size_t n) { return requests[firsts[n]].file; }, make);
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
    std::array<std::string, 6> file_hashes, images;
    std::string hashes, names;
    for (std::size_t i = 0; i < 6; ++i) {
        requests[i] = {faces[i], options, NotFinite::refuse, selections[i]};
        file_hashes[i] = files_->file_hash(faces[i], options.key);
        images[i] = image_id(requests[i], file_hashes[i]);
        hashes += images[i] + '\n';
        names += image_id(requests[i], faces[i].string()) + '\n';
    }
    const std::string key = texture_id(hashes, options);
    auto texture = find(key);
    if (!texture) {
        std::array<Image, 6> loaded;
        small_ones_together(
            6, [&](std::size_t i) { return faces[i]; },
            [&](std::size_t i) {
                if (first_like(images, i) == i)
                    loaded[i] =
                        load_hashed(requests[i], file_hashes[i],
                                    options.key + ".faces[" + std::to_string(i) + "]", *files_);
            });
        for (std::size_t i = 0; i < 6; ++i)
            if (const std::size_t first = first_like(images, i); first != i)
                loaded[i] = loaded[first];
        texture = add(key, make_cube_texture(loaded, options, hashes));
    }
    keep(texture_id(names, options), texture);
    return texture;
}

}  // namespace quadrel
