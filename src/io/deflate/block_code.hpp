// The two codes of a block of deflate: of literals and lengths, and of distances.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "io/deflate/bit_writer.hpp"
#include "io/deflate/huffman_code.hpp"
#include "io/deflate/matches.hpp"

namespace quadrel {

/// A number as RFC 1951, 3.2.5, writes it: a symbol, then bits that tell which of those that share
/// it.
struct Coded {
    std::uint32_t symbol;
    std::uint32_t extra;
    int extra_bits;
};

/// Of a length from 3 to 258: symbols 257 to 285.
inline Coded coded_length(std::uint32_t length) {
    const std::uint32_t x = length - 3;
    if (length == longest_match) return {285, 0, 0};
    if (x < 8) return {257 + x, 0, 0};
    const int bits = std::bit_width(x) - 3;
    const auto group = static_cast<std::uint32_t>(bits + 1);
    return {257 + 4 * group + (x >> bits & 3), x & ((1u << bits) - 1), bits};
}

/// Of a distance from 1 to 32768: symbols 0 to 29.
inline Coded coded_distance(std::uint32_t distance) {
    const std::uint32_t x = distance - 1;
    if (x < 4) return {x, 0, 0};
    const int bits = std::bit_width(x) - 2;
    const auto group = static_cast<std::uint32_t>(bits + 1);
    return {2 * group + (x >> bits & 1), x & ((1u << bits) - 1), bits};
}

class BlockCode {
  public:
    /// For what the matches make of the bytes.
    BlockCode(const std::uint8_t* bytes, const std::vector<Match>& matches);

    /// Of the whole block, its codes included.
    std::uint64_t size_in_bits() const { return bits_; }

    void write_lengths(BitWriter& out) const;
    /// 14 bits at most.
    void add_literal(std::uint8_t byte, BitWriter& out) const { add(literals_[byte], out); }
    void add_end(BitWriter& out) const { add(literals_[end_symbol], out); }
    /// 48 bits at most.
    void add_match(const Match& match, BitWriter& out) const {
        const Coded length = coded_length(match.length), distance = coded_distance(match.distance);
        add(literals_[length.symbol], out);
        out.add(length.extra, length.extra_bits);
        add(distances_[distance.symbol], out);
        out.add(distance.extra, distance.extra_bits);
    }

  private:
    static constexpr std::size_t end_symbol = 256;

    /// A length, or how often one is repeated (RFC 1951, 3.2.7).
    struct LengthSymbol {
        std::uint8_t symbol, extra, extra_bits;
    };

    static void add(const CodeWord& word, BitWriter& out) { out.add(word.bits, word.length); }
    void list_lengths();

    std::vector<CodeWord> literals_, distances_, lengths_;
    std::vector<LengthSymbol> listed_;  ///< the lengths of both codes' words
    std::size_t literal_words_ = 0, distance_words_ = 0, length_words_ = 0;
    std::uint64_t bits_ = 0;
};

}  // namespace quadrel
