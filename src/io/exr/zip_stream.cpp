#include "io/exr/zip_stream.hpp"

#include <libdeflate.h>

#include <new>

namespace quadrel {
namespace {

/// Higher ones take longer and gain a hundredth of the size: films are mostly noise in their last
/// bits.
constexpr int level = 1;

std::uint8_t difference(std::uint8_t byte, std::uint8_t before) {
    return static_cast<std::uint8_t>(byte - before + 128);
}

/// Bytes at even places, then those at odd ones, as differences. `out` has room for as many.
void write_differences(std::span<const std::uint8_t> bytes, std::uint8_t* out) {
    const std::uint8_t* const in = bytes.data();
    const std::size_t size = bytes.size(), even = (size + 1) / 2, odd = size / 2;
    out[0] = in[0];
    for (std::size_t i = 1; i < even; ++i) out[i] = difference(in[2 * i], in[2 * i - 2]);
    if (odd > 0) out[even] = difference(in[1], in[2 * even - 2]);
    for (std::size_t i = 1; i < odd; ++i) out[even + i] = difference(in[2 * i + 1], in[2 * i - 1]);
}

}  // namespace

void ZipStream::Free::operator()(libdeflate_compressor* compressor) const {
    libdeflate_free_compressor(compressor);
}

ZipStream::ZipStream() : compressor_(libdeflate_alloc_compressor(level)) {
    if (!compressor_) throw std::bad_alloc();
}

std::span<const std::uint8_t> ZipStream::compress(std::span<const std::uint8_t> bytes) {
    if (bytes.empty()) return {};
    differences_.resize(bytes.size());
    write_differences(bytes, differences_.data());
    stream_.resize(bytes.size());
    const std::size_t size = libdeflate_zlib_compress(
        compressor_.get(), differences_.data(), bytes.size(), stream_.data(), bytes.size() - 1);
    return {stream_.data(), size};
}

}  // namespace quadrel
