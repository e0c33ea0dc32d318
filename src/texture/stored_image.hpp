// An image as its file stores it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "quadrel/texture/image.hpp"
#include "texture/oiio_request.hpp"

namespace quadrel {

/// Interleaved values in their native type, row 0 at the top; so they take less memory than floats,
/// and who wants channels by themselves gets them without a copy of all.
class StoredImage {
  public:
    /// `pixels` are width * height * channels values of the type, in the machine's byte order.
    StoredImage(const QuadrelOiioInfo& info, std::vector<unsigned char> pixels)
        : info_(info), pixels_(std::move(pixels)) {}

    int width() const { return info_.width; }
    int height() const { return info_.height; }
    int channels() const { return info_.channels; }
    bool is_luminance() const { return info_.luminance != 0; }
    TexelFormat format() const;  ///< as Image::format

    /// Decodes exactly `count` values, every `step`th from the `first`.
    void decode(std::size_t first, std::size_t step, std::size_t count, float* out) const;

    /// All of it.
    Image decoded() const;

  private:
    QuadrelOiioInfo info_;
    std::vector<unsigned char> pixels_;
};

/// An image other than EXR as its file stores it, for who needs its channels one by one; nothing
/// for those that load_image alone reads. Throws InputError as that does.
std::optional<StoredImage> open_stored_image(const std::filesystem::path& file,
                                             const ImageSelection& selection);

/// The bytes of a value.
std::size_t value_size(QuadrelOiioType type);

}  // namespace quadrel
