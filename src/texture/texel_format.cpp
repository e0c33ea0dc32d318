#include "texture/texel_format.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <vector>

#include "quadrel/num/srgb.hpp"

namespace quadrel {

int max_code(TexelFormat format) {
    switch (format) {
        case TexelFormat::unorm8:
        case TexelFormat::srgb8:
            return 255;
        case TexelFormat::unorm16:
            return 65535;
        case TexelFormat::half:
        case TexelFormat::float32:
            break;
    }
    return 0;
}

std::string_view format_name(TexelFormat format) {
    return std::find_if(std::begin(named_formats), std::end(named_formats),
                        [&](const auto& named) { return named.second == format; })
        ->first;
}

double round_to_half(double x) {
    constexpr double overflow = 65520;  // halfway from the largest half to what would be the next
    if (!std::isfinite(x) || x == 0) return x;
    if (std::fabs(x) >= overflow) return std::copysign(std::numeric_limits<double>::infinity(), x);
    constexpr std::uint64_t exponent_bits = std::uint64_t(0x7ff) << 52;
    constexpr std::uint64_t min_exponent = std::uint64_t(1023 - 14) << 52;
    const std::uint64_t exponent =
        std::max(std::bit_cast<std::uint64_t>(x) & exponent_bits, min_exponent);
    // A number whose last bit is worth what the half's is, 10 places below the exponent.
    const double shift = std::bit_cast<double>(exponent + (std::uint64_t(52 - 10) << 52));
    return std::copysign((std::fabs(x) + shift) - shift, x);
}

namespace {

/// NaN gives 0.
int round_code(double scaled, int max) {
    const double above = scaled > 0 ? scaled + 0.5 : 0;
    return static_cast<int>(scaled >= max ? max : above);
}

/// By division: the product with the reciprocal misses 126 of 256 codes.
template <int max>
float decode_unorm(int code) {
    return static_cast<float>(code) / static_cast<float>(max);
}

/// What codes of 8 bits are worth: linear, and sRGB.
struct DecodedBytes {
    std::array<float, 256> unorm{}, srgb{};
    DecodedBytes() {
        for (int i = 0; i < 256; ++i) {
            const auto code = static_cast<std::size_t>(i);
            unorm[code] = decode_unorm<255>(i);
            srgb[code] = static_cast<float>(srgb_decode(i / 255.0));
        }
    }
};

const DecodedBytes& decoded_bytes() {
    static const DecodedBytes table;
    return table;
}

/// Where one sRGB code gives way to the next, and for each run of doubles that begin with the same
/// bits, how many thresholds lie at or below the first.
class SrgbEncoder {
  public:
    SrgbEncoder() {
        for (int i = 0; i < 255; ++i)
            thresholds_[static_cast<std::size_t>(i)] = srgb_decode((i + 0.5) / 255);
        const std::uint64_t first = run_of(thresholds_.front());
        for (std::uint64_t run = first; run <= run_of(thresholds_.back()); ++run)
            below_.push_back(static_cast<std::uint8_t>(
                std::upper_bound(thresholds_.begin(), thresholds_.end(),
                                 std::bit_cast<double>(run << ignored_bits)) -
                thresholds_.begin()));
    }

    int encode(double linear) const {
        if (!(linear >= thresholds_.front())) return 0;
        if (linear >= thresholds_.back()) return 255;
        std::size_t code = below_[run_of(linear) - run_of(thresholds_.front())];
        while (linear >= thresholds_[code]) ++code;
        return static_cast<int>(code);
    }

  private:
    static constexpr int ignored_bits = 52 - 7;  // 128 runs an octave: two thresholds at most
    static std::uint64_t run_of(double positive) {
        return std::bit_cast<std::uint64_t>(positive) >> ignored_bits;
    }
    std::array<double, 255> thresholds_{};  ///< linear values: decoded half codes
    std::vector<std::uint8_t> below_;
};

const SrgbEncoder& srgb_encoder() {
    static const SrgbEncoder encoder;
    return encoder;
}

/// `store` is given values in multiples of 1.
template <class Store>
void store_all(const double* values, float* out, int count, int step, double unit,
               const Store& store) {
    if (unit == 1)
        for (int i = 0; i < count; ++i) out[i * step] = store(values[i * step]);
    else
        for (int i = 0; i < count; ++i) out[i * step] = store(values[i * step] / unit);
}

/// `value * max / unit` in this order, which is exact where values are codes.
template <int max, class Decode>
void store_codes(const double* values, float* out, int count, int step, double unit,
                 const Decode& decode) {
    if (unit == 1)
        for (int i = 0; i < count; ++i)
            out[i * step] = decode(round_code(values[i * step] * max, max));
    else
        for (int i = 0; i < count; ++i)
            out[i * step] = decode(round_code(values[i * step] * max / unit, max));
}

}  // namespace

int encode_unorm(double value, double unit, int max) { return round_code(value * max / unit, max); }

int encode_srgb8(double linear) { return srgb_encoder().encode(linear); }

void store_and_decode(const double* values, float* out, int count, int step, double unit,
                      TexelFormat format, bool is_alpha) {
    const auto unorm8 = [&table = decoded_bytes().unorm](int code) {
        return table[static_cast<std::size_t>(code)];
    };
    const auto srgb8 = [&encoder = srgb_encoder(), &table = decoded_bytes().srgb](double linear) {
        return table[static_cast<std::size_t>(encoder.encode(linear))];
    };
    if (format == TexelFormat::float32)
        store_all(values, out, count, step, unit, [](double x) { return static_cast<float>(x); });
    else if (format == TexelFormat::half)
        store_all(values, out, count, step, unit,
                  [](double x) { return static_cast<float>(round_to_half(x)); });
    else if (format == TexelFormat::unorm16)
        store_codes<65535>(values, out, count, step, unit, decode_unorm<65535>);
    else if (format == TexelFormat::srgb8 && !is_alpha)
        store_all(values, out, count, step, unit, srgb8);
    else
        store_codes<255>(values, out, count, step, unit, unorm8);
}

float store_and_decode(double value, double unit, TexelFormat format, bool is_alpha) {
    float stored = 0;
    store_and_decode(&value, &stored, 1, 1, unit, format, is_alpha);
    return stored;
}

}  // namespace quadrel
