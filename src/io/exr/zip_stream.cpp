#include "io/exr/zip_stream.hpp"

#include <libdeflate.h>

#include <new>

namespace quadrel {
namespace {

/// Higher ones take longer and gain a hundredth of the size: films are mostly noise in their last
/// bits.
constexpr int level = 1;

}  // namespace

void ZipStream::Free::operator()(libdeflate_compressor* compressor) const {
    libdeflate_free_compressor(compressor);
}

ZipStream::ZipStream() : compressor_(libdeflate_alloc_compressor(level)) {
    if (!compressor_) throw std::bad_alloc();
}

std::span<const std::uint8_t> ZipStream::compress(std::span<const std::uint8_t> bytes) {
    if (bytes.empty()) return {};
    if (stream_.size() < bytes.size()) stream_.resize(bytes.size());
    const std::size_t size = libdeflate_zlib_compress(compressor_.get(), bytes.data(), bytes.size(),
                                                      stream_.data(), bytes.size() - 1);
    return {stream_.data(), size};
}

}  // namespace quadrel
