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

/// The other way round. The two chains of sums run side by side: where the odd places begin is the
/// sum over the even ones.
void sum_differences(std::span<const std::uint8_t> differences, std::uint8_t* out) {
    const std::uint8_t* const in = differences.data();
    const std::size_t size = differences.size(), even = (size + 1) / 2, odd = size / 2;
    const auto after = [](std::uint8_t before, std::uint8_t step) {
        return static_cast<std::uint8_t>(before + step - 128);
    };
    std::uint8_t last_even = in[0];
    for (std::size_t i = 1; i < even; ++i) last_even = after(last_even, in[i]);
    std::uint8_t a = 128, b = last_even;
    for (std::size_t i = 0; i < odd; ++i) {
        out[2 * i] = a = after(a, in[i]);
        out[2 * i + 1] = b = after(b, in[even + i]);
    }
    if (even > odd) out[size - 1] = last_even;
}

struct FreeDecompressor {
    void operator()(libdeflate_decompressor* decompressor) const {
        libdeflate_free_decompressor(decompressor);
    }
};

/// One thread's.
struct Unzipper {
    std::unique_ptr<libdeflate_decompressor, FreeDecompressor> decompressor{
        libdeflate_alloc_decompressor()};
    std::vector<std::uint8_t> differences;
};

}  // namespace

bool unzip(std::span<const std::uint8_t> stream, std::span<std::uint8_t> bytes) {
    thread_local Unzipper unzipper;
    if (!unzipper.decompressor) throw std::bad_alloc();
    if (bytes.empty()) return false;
    unzipper.differences.resize(bytes.size());
    // Without room for the true length it takes no other than the expected one.
    const libdeflate_result result =
        libdeflate_zlib_decompress(unzipper.decompressor.get(), stream.data(), stream.size(),
                                   unzipper.differences.data(), bytes.size(), nullptr);
    if (result != LIBDEFLATE_SUCCESS) return false;
    sum_differences(unzipper.differences, bytes.data());
    return true;
}

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
