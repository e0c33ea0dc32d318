#include "page/bits.hpp"

#include <zlib.h>

#include <array>
#include <new>
#include <vector>

#include "page/template.hpp"
#include "quadrel/check.hpp"
#include "quadrel/num/math.hpp"

namespace quadrel::page {
namespace {

/// What is written of each word, or of each byte. The numbers are those of data/page/sources.js.
enum class Prediction : unsigned char {
    bytes,  ///< each byte by the one before in its plane
    left,   ///< each word by the one before
    plane,  ///< each word by those on the left, above, and above on the left
    none,
    count
};

/// Small differences of both signs as small numbers.
std::uint32_t folded(std::uint32_t difference) {
    return difference << 1 ^ (difference >> 31 != 0 ? 0xffffffffu : 0);
}

/// The words less what is predicted.
std::vector<std::uint32_t> residuals(const std::vector<std::uint32_t>& words, std::size_t width,
                                     Prediction prediction) {
    if (prediction == Prediction::bytes || prediction == Prediction::none) return words;
    std::vector<std::uint32_t> rest(words.size());
    for (std::size_t i = 0; i < words.size(); ++i) {
        const bool has_left = prediction == Prediction::left ? i > 0 : i % width > 0;
        const bool has_above = prediction == Prediction::plane && i >= width;
        std::uint32_t predicted = has_left ? words[i - 1] : 0;
        if (has_above) predicted += words[i - width] - (has_left ? words[i - width - 1] : 0);
        rest[i] = folded(words[i] - predicted);
    }
    return rest;
}

std::string planes(const std::vector<std::uint32_t>& words, Prediction prediction) {
    std::string bytes;
    bytes.reserve(4 * words.size());
    unsigned last = 0;
    for (int shift = 0; shift < 32; shift += 8)
        for (const std::uint32_t word : words) {
            const unsigned byte = word >> shift & 0xffu;
            bytes += static_cast<char>(prediction == Prediction::bytes ? byte - last : byte);
            last = byte;
        }
    return bytes;
}

/// Bits that bytes take at least, each plane by how often it has each byte.
double entropy(const std::string& bytes) {
    double bits = 0;
    const std::size_t part = bytes.size() / 4;
    for (std::size_t plane = 0; plane < 4; ++plane) {
        std::array<std::size_t, 256> counts{};
        for (std::size_t i = 0; i < part; ++i)
            ++counts[static_cast<unsigned char>(bytes[plane * part + i])];
        for (const std::size_t count : counts)
            if (count > 0)
                bits -= static_cast<double>(count) *
                        log2(static_cast<double>(count) / static_cast<double>(part));
    }
    return bits;
}

std::string deflated(const std::string& bytes) {
    uLongf size = compressBound(bytes.size());
    std::string stream(size, '\0');
    constexpr int level = 9;
    if (compress2(reinterpret_cast<Bytef*>(stream.data()), &size,
                  reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), level) != Z_OK)
        throw std::bad_alloc();
    stream.resize(size);
    return stream;
}

}  // namespace

std::string packed_bits(std::span<const std::uint32_t> bits, std::span<const std::uint32_t> earlier,
                        std::size_t width) {
    QUADREL_CHECK(earlier.empty() || earlier.size() == bits.size(), earlier.size());
    std::vector<std::uint32_t> words(bits.begin(), bits.end());
    for (std::size_t i = 0; i < earlier.size(); ++i) words[i] ^= earlier[i];
    std::string best;
    double least = 0;
    for (unsigned char p = 0; p < static_cast<unsigned char>(Prediction::count); ++p) {
        const auto prediction = static_cast<Prediction>(p);
        if (prediction == Prediction::plane && width == 0) continue;
        const std::string bytes = planes(residuals(words, width, prediction), prediction);
        const double bits_of = entropy(bytes);
        if (!best.empty() && !(bits_of < least)) continue;
        least = bits_of;
        best = std::string(1, static_cast<char>(p));
        for (int shift = 0; shift < 32; shift += 8) best += static_cast<char>(width >> shift);
        best += bytes;
    }
    return base64(deflated(best));
}

std::string packed_text(const std::string& text) { return base64(deflated(text)); }

}  // namespace quadrel::page
