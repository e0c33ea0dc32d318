#include "io/deflate/deflate.hpp"

#include <algorithm>
#include <cstring>

#include "io/deflate/block_code.hpp"

namespace quadrel {
namespace {

/// Bytes that share a code: fewer, and codes take more room than they spare; more, and they suit
/// all bytes alike. Stored as they are they may be 65535.
constexpr std::size_t block_bytes = 49152;

/// Before and after each block, and the two checks of the whole.
constexpr std::size_t block_extra = 8, stream_extra = 16;

/// RFC 1950, 8.2, in steps short enough that sums cannot overflow.
std::uint32_t adler32(std::span<const std::uint8_t> bytes) {
    constexpr std::uint32_t modulus = 65521;
    constexpr std::size_t step = 2048;
    std::uint32_t a = 1, b = 0;
    while (!bytes.empty()) {
        const auto n = static_cast<std::uint32_t>(std::min(step, bytes.size()));
        std::uint32_t sum = 0, weighted = 0;
        for (std::uint32_t i = 0; i < n; ++i) {
            sum += bytes[i];
            weighted += (n - i) * bytes[i];
        }
        b = (b + n * a + weighted) % modulus;
        a = (a + sum) % modulus;
        bytes = bytes.subspan(n);
    }
    return b << 16 | a;
}

void store_block(std::span<const std::uint8_t> bytes, BitWriter& out) {
    out.add(0, 2);  // stored
    std::uint8_t*& to = out.align();
    const auto size = static_cast<std::uint16_t>(bytes.size());
    const std::uint16_t both[] = {size, static_cast<std::uint16_t>(~size)};
    std::memcpy(to, both, sizeof both);
    std::memcpy(to + sizeof both, bytes.data(), bytes.size());
    to += sizeof both + bytes.size();
}

void write_matches(const std::uint8_t* bytes, const std::vector<Match>& matches,
                   const BlockCode& code, BitWriter& out) {
    for (const Match& match : matches) {
        const std::uint8_t* const end = bytes + match.literals;
        for (; end - bytes >= 4; bytes += 4) {
            for (int i = 0; i < 4; ++i) code.add_literal(bytes[i], out);
            out.flush();
        }
        for (; bytes < end; ++bytes) code.add_literal(*bytes, out);
        out.flush();
        if (match.length == 0) continue;
        code.add_match(match, out);
        out.flush();
        bytes += match.length;
    }
}

}  // namespace

void Deflate::write_block(std::span<const std::uint8_t> bytes, std::size_t first, std::size_t last,
                          BitWriter& out) {
    finder_.find(bytes.data(), first, last, matches_);
    const BlockCode code(bytes.data() + first, matches_);
    out.add(last == bytes.size() ? 1 : 0, 1);  // the last one
    if (code.size_in_bits() >= 8 * (last - first))
        return store_block(bytes.subspan(first, last - first), out);
    out.add(2, 2);  // codes of its own
    code.write_lengths(out);
    write_matches(bytes.data() + first, matches_, code, out);
    code.add_end(out);
    out.flush();
}

std::span<const std::uint8_t> Deflate::compress(std::span<const std::uint8_t> bytes) {
    const std::size_t most =
        bytes.size() + (bytes.size() / block_bytes + 1) * block_extra + stream_extra;
    if (stream_.size() < most) stream_.resize(most);
    finder_.start();
    BitWriter out(stream_.data());
    out.add(0x0178, 16);  // deflate, with distances up to 32768
    std::size_t first = 0;
    do {
        const std::size_t last = std::min(first + block_bytes, bytes.size());
        write_block(bytes, first, last, out);
        first = last;
    } while (first < bytes.size());
    std::uint8_t*& end = out.align();
    const std::uint32_t check = adler32(bytes);
    for (int i = 3; i >= 0; --i) *end++ = static_cast<std::uint8_t>(check >> 8 * i);
    return {stream_.data(), static_cast<std::size_t>(end - stream_.data())};
}

}  // namespace quadrel
