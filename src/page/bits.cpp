#include "page/bits.hpp"

#include <zlib.h>

#include <new>

#include "page/template.hpp"
#include "quadrel/check.hpp"

namespace quadrel::page {

std::string packed_bits(std::span<const std::uint32_t> bits,
                        std::span<const std::uint32_t> earlier) {
    QUADREL_CHECK(earlier.empty() || earlier.size() == bits.size(), earlier.size());
    std::string bytes;
    bytes.reserve(4 * bits.size());
    unsigned last = 0;
    for (int shift = 0; shift < 32; shift += 8)
        for (std::size_t i = 0; i < bits.size(); ++i) {
            const std::uint32_t word = bits[i] ^ (earlier.empty() ? 0 : earlier[i]);
            const unsigned byte = word >> shift & 0xffu;
            bytes += static_cast<char>(byte - last);
            last = byte;
        }
    uLongf size = compressBound(bytes.size());
    std::string stream(size, '\0');
    constexpr int level = 6;
    if (compress2(reinterpret_cast<Bytef*>(stream.data()), &size,
                  reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), level) != Z_OK)
        throw std::bad_alloc();
    return base64(std::string_view(stream).substr(0, size));
}

}  // namespace quadrel::page
