// Textures: mip chains of decoded texels, owned. Each level is computed in double from the
// unrounded previous level, rounded to the format that a GPU would store, and decoded to float32
// once: a port that uploads the exported levels holds the very same texels.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "quadrel/texture/image.hpp"
#include "quadrel/texture/view.hpp"

namespace quadrel {

/// How an image becomes a texture.
struct TextureOptions {
    /// What each channel of the texture takes: r g b a, their complements 1-r 1-g 1-b 1-a, or the
    /// constants 0 1; "rgba", "rgb1", "a", "1-r", "gba1". One to four entries; three get a 1
    /// appended. Empty: as stored.
    std::string swizzle;
    bool srgb = false;  ///< r, g and b are sRGB-encoded; filtering happens on linear values
    /// The file's own if absent: unorm8 read as sRGB becomes srgb8, unorm16 float32.
    std::optional<TexelFormat> format;
    MipRule mip_rule = MipRule::box;
    bool flip_v = false;  ///< row 0 of the texture is the image's last row
    std::string key;      ///< where the scene names it, for messages
};

/// A decoded mip chain, at least 64-byte aligned, immutable.
class Texture {
  public:
    /// Zeroed texels for a chain whose sizes and offsets are `layout` (its pointer is ignored).
    /// `id` names content and options.
    Texture(const TextureView& layout, TexelFormat format, std::string id);

    const TextureView& view() const { return view_; }
    TexelFormat format() const { return format_; }
    /// SHA-256 over content and every option that changes texels; what is baked from a texture
    /// hangs on it.
    const std::string& id() const { return id_; }

    float* level_texels(int level, int face);
    const float* level_texels(int level, int face) const;

  private:
    struct Free {
        void operator()(float* texels) const;
    };
    std::unique_ptr<float[], Free> texels_;
    TextureView view_;
    TexelFormat format_;
    std::string id_;
};

/// Throws InputError when the swizzle asks for channels that the image lacks, or the size is out of
/// bounds.
std::shared_ptr<const Texture> make_texture(const Image& image, const TextureOptions& options = {});

/// Faces +X -X +Y -Y +Z -Z, square and of one size, else InputError.
std::shared_ptr<const Texture> make_cube_texture(const std::array<Image, 6>& faces,
                                                 const TextureOptions& options = {});

/// The texture's identity: SHA-256 over content hash(es) and options.
std::string texture_id(const std::string& content_hash, const TextureOptions& options);

/// SHA-256 of size, format and values.
std::string content_hash(const Image& image);

/// One level (of one face) as an image of decoded values.
Image texture_level(const Texture& texture, int level, int face = 0);

}  // namespace quadrel
