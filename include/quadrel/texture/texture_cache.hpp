// Textures shared between materials and scenes: one for each content and set of options.
#pragma once

#include <map>
#include <mutex>

#include "quadrel/texture/texture.hpp"

namespace quadrel {

/// Finds textures by content hash, swizzle, colour space, format, mip rule and flip. A texture
/// lives as long as someone holds it. All functions may be called from several threads.
class TextureCache {
  public:
    /// Reads the file's bytes; decodes them only if no texture with this content and these options
    /// is alive. Throws InputError as load_image and make_texture do.
    std::shared_ptr<const Texture> load(const std::filesystem::path& file,
                                        const TextureOptions& options = {},
                                        NotFinite not_finite = NotFinite::refuse,
                                        const ImageSelection& selection = {});
    std::shared_ptr<const Texture> load_cube(const std::array<std::filesystem::path, 6>& faces,
                                             const TextureOptions& options = {},
                                             const std::array<ImageSelection, 6>& selections = {});

  private:
    template <class Make>
    std::shared_ptr<const Texture> find_or_make(const std::string& key, const Make& make);

    std::mutex mutex_;
    std::map<std::string, std::weak_ptr<const Texture>> textures_;
};

}  // namespace quadrel
