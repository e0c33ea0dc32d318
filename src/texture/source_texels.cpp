#include "texture/source_texels.hpp"

#include <utility>

#include "quadrel/num/srgb.hpp"
#include "texture/texel_format.hpp"

namespace quadrel {

namespace {

int alpha_index(const Image& image) {
    if (image.luminance) return 1;
    return image.channels == 4 ? 3 : -1;
}

}  // namespace

SourceTexels::SourceTexels(const Image& image, std::vector<SwizzleEntry> swizzle, bool srgb,
                           bool flip_v)
    : image_(image),
      swizzle_(std::move(swizzle)),
      srgb_(srgb),
      flip_v_(flip_v),
      codes_(max_code(image.format)) {
    for (int c = 0; c < channels(); ++c) {
        unit_.push_back(codes_ == 0 || is_decoded(c) ? 1.0 : codes_);
    }
    if (!srgb || codes_ == 0) return;
    for (int code = 0; code <= codes_; ++code) {
        decoded_.push_back(srgb_decode(static_cast<double>(code) / codes_));
    }
}

bool SourceTexels::is_decoded(int c) const {
    const int source = swizzle_[static_cast<std::size_t>(c)].source;
    return srgb_ && source >= 0 && source != alpha_index(image_);
}

double SourceTexels::operator()(int x, int y, int c) const {
    const SwizzleEntry& entry = swizzle_[static_cast<std::size_t>(c)];
    const double one = unit(c);
    if (entry.source < 0) return entry.constant * one;
    const std::size_t row = flip_v_ ? image_.height - 1 - y : y;
    const float stored = image_.values[(row * image_.width + x) * image_.channels + entry.source];
    double value = stored;
    if (codes_ != 0) value = static_cast<int>(value * codes_ + 0.5);  // values lie in [0, 1]
    if (is_decoded(c)) {
        value = codes_ != 0 ? decoded_[static_cast<std::size_t>(value)] : srgb_decode(stored);
    }
    return entry.complement ? one - value : value;
}

}  // namespace quadrel
