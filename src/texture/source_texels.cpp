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
        units_.push_back(codes_ == 0 || is_decoded(c) ? 1.0 : codes_);
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

const double* SourceTexels::row(int y, std::vector<double>& scratch) const {
    const auto width = static_cast<std::size_t>(image_.width);
    scratch.resize(width * swizzle_.size());
    const auto stored = static_cast<std::size_t>(flip_v_ ? image_.height - 1 - y : y);
    const float* const from =
        image_.values.data() + stored * width * static_cast<std::size_t>(image_.channels);
    for (int c = 0; c < channels(); ++c) fill_channel(from, c, scratch.data() + c);
    return scratch.data();
}

void SourceTexels::fill_channel(const float* stored, int c, double* out) const {
    const SwizzleEntry& entry = swizzle_[static_cast<std::size_t>(c)];
    const double one = units_[static_cast<std::size_t>(c)];
    const int count = image_.width, step = image_.channels, out_step = channels();
    const float* const in = stored + (entry.source < 0 ? 0 : entry.source);
    const auto fill = [&](const auto& value) {
        if (entry.complement)
            for (int x = 0; x < count; ++x) out[x * out_step] = one - value(in[x * step]);
        else
            for (int x = 0; x < count; ++x) out[x * out_step] = value(in[x * step]);
    };
    // Stored values of codes lie in [0, 1].
    const auto code = [codes = codes_](double v) { return static_cast<int>(v * codes + 0.5); };
    if (entry.source < 0)
        for (int x = 0; x < count; ++x) out[x * out_step] = entry.constant * one;
    else if (codes_ != 0 && is_decoded(c))
        fill([&](float v) { return decoded_[static_cast<std::size_t>(code(v))]; });
    else if (codes_ != 0)
        fill([&](float v) { return static_cast<double>(code(v)); });
    else if (is_decoded(c))
        fill([](float v) { return srgb_decode(static_cast<double>(v)); });
    else
        fill([](float v) { return static_cast<double>(v); });
}

}  // namespace quadrel
