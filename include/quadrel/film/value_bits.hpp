// Exact values out of targets that hold no floats: a value's 32 bits in the codes of an image, as
// the snippets of data/snippets pack them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "quadrel/film/comparable.hpp"

namespace quadrel {

/// Where an image has a value's bits, counted from the least significant.
enum class BitLayout : std::int32_t {
    automatic,  ///< by how the image is stored; README of data/snippets
    rgba8,      ///< 0-7 in R, 8-15 in G, 16-23 in B, 24-31 in A
    rgb8,       ///< low and high, side by side or one above the other
    rg16,       ///< 0-15 in R, 16-31 in G
    rgb10a2,    ///< 0-9 in R, 10-19 in G, 20-29 in B, 30-31 in A
    low,        ///< 0-15: in R and G of 8 bits with a check byte in B, or in R of 16 bits
    high        ///< 16-31 likewise
};

const char* bit_layout_name(BitLayout layout);

/// The check byte that goes with 16 bits of a value (bits 0-7 of `half` in R, 8-15 in G): another
/// one for each half, none that a curve leaves alone where R and G are 0 or 255, and by weights
/// that tell the three channels apart: in another order they are right for few values only.
constexpr std::uint32_t check_byte(std::uint32_t half, bool is_high) {
    return (3 * (half & 0xffu) + 7 * (half >> 8) + (is_high ? 165u : 90u)) & 0xffu;
}

/// What one image carries: "LAYOUT:CHANNEL,CHANNEL...=FILE"; `bits` is the automatic layout.
struct CarriedBits {
    BitLayout layout = BitLayout::automatic;
    std::vector<std::string> channels;  ///< of several each has a tile of the image, in this order
    std::filesystem::path file;         ///< empty: the test image

    bool operator==(const CarriedBits&) const = default;
};

/// `option` is for the message. Throws UsageError.
CarriedBits parse_carried_bits(const std::string& option, const std::string& text);

/// An image and what it carries.
struct BitImage {
    CarriedBits carries;
    ComparableImage image;
};

/// The channels that the images carry, in the size of the reference's frame. A channel is float32
/// or uint32 as the reference has it; every NaN becomes canonical_nan. Throws UsageError for
/// channels that the reference lacks, that come twice or by half; InputError, in one line, for
/// images of another size or storage than the layout needs, values that are no codes, check bytes
/// that are not right, and alpha that is 255 wherever it should hold bits.
ComparableImage decode_bits(std::span<const BitImage> images, const Film& reference);

}  // namespace quadrel
