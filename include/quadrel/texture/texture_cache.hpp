// Textures shared between materials, scenes and renders: one for each content and set of options.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "quadrel/texture/texture.hpp"

namespace quadrel {

class FileStore;

/// Inclusive.
struct ValueRange {
    float low, high;
};

/// A texture as load_image and make_texture are asked for it.
struct TextureRequest {
    std::filesystem::path file;
    TextureOptions options = {};
    NotFinite not_finite = NotFinite::refuse;
    ImageSelection selection = {};
};

/// Finds textures by content hash, swizzle, colour space, format, mip rule and flip. What was asked
/// for is kept until the same request finds the file changed, or clear(). Asked again, a file is
/// looked at (device, inode, size, times), and read only if it may have changed; hashed and decoded
/// from one read, if it is an EXR of up to 64 MB. All functions may be called from several threads.
class TextureCache {
  public:
    TextureCache();
    ~TextureCache();

    /// A texture for each request. Each image is decoded once, and only if a texture of it is
    /// missing: those of small files side by side, others one after the other, so that no two of
    /// these are in memory, each on all threads. Throws InputError as load_image and make_texture
    /// do.
    std::vector<std::shared_ptr<const Texture>> load(std::span<const TextureRequest> requests);
    std::shared_ptr<const Texture> load(const std::filesystem::path& file,
                                        const TextureOptions& options = {},
                                        NotFinite not_finite = NotFinite::refuse,
                                        const ImageSelection& selection = {});
    std::shared_ptr<const Texture> load_cube(const std::array<std::filesystem::path, 6>& faces,
                                             const TextureOptions& options = {},
                                             const std::array<ImageSelection, 6>& selections = {});

    /// What `measure` finds out about textures, by a name that says which and what; measured once
    /// until clear().
    std::optional<ValueRange> range(const std::string& name,
                                    const std::function<std::optional<ValueRange>()>& measure);

    /// Keeps a texture that was made elsewhere, in place of what was kept under this name.
    void keep(const std::string& name, std::shared_ptr<const Texture> texture);
    /// What is kept under a name, or null.
    std::shared_ptr<const Texture> kept(const std::string& name);
    /// Keeps nothing any more. Textures that somebody else holds are still found.
    void clear();

    /// How many textures were not there and had to be made so far.
    std::uint64_t made() const { return made_; }

    /// Files that were hashed and are still to be decoded.
    FileStore& files() { return *files_; }

  private:
    std::shared_ptr<const Texture> find(const std::string& id);
    /// The texture, or the one that another thread has put there first.
    std::shared_ptr<const Texture> add(const std::string& id, std::shared_ptr<const Texture> made);

    std::mutex mutex_;
    std::atomic<std::uint64_t> made_ = 0;
    std::map<std::string, std::weak_ptr<const Texture>> textures_;  ///< by content and options
    std::map<std::string, std::shared_ptr<const Texture>> kept_;    ///< by what was asked for
    std::map<std::string, std::optional<ValueRange>> ranges_;
    std::unique_ptr<FileStore> files_;
};

}  // namespace quadrel
