// Prefix codes of limited length for symbols of known counts.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace quadrel {

/// A code word, its first bit the lowest: bits, and how many they are; 0 for symbols that do not
/// occur.
struct CodeWord {
    std::uint16_t bits = 0;
    std::uint8_t length = 0;
};

/// Huffman's code with no word longer than `longest` bits (then nearly his), numbered as deflate
/// (RFC 1951, 3.2.2) wants it. At least two symbols get words, so that the code is complete.
/// `counts`: 2 to 512 symbols, no more than 2^longest.
std::vector<CodeWord> huffman_code(std::span<const std::uint32_t> counts, int longest);

}  // namespace quadrel
