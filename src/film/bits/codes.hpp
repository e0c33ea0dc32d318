// The codes of an image, whatever stores them.
#pragma once

#include "quadrel/film/value_bits.hpp"

namespace quadrel {

/// Channels of an image as integers; messages name the pixel.
class Codes {
  public:
    explicit Codes(const ComparableImage& image) : image_(image) {}

    const ComparableImage& image() const { return image_; }
    bool has(const std::string& channel) const { return image_.film.find(channel) != nullptr; }
    /// Of the first channel; an image has one.
    Storage storage() const { return image_.stored.at(image_.film.planes.front().name); }
    std::string names() const;
    int width() const { return image_.film.window.width(); }
    int height() const { return image_.film.window.height(); }

    /// The code, 0 to 2^bits - 1, of pixel `i`. Throws InputError for a channel that is lacking and
    /// a value that is no code: farther than an eighth of a step from one, a third of halves.
    std::uint32_t at(const std::string& channel, int bits, std::size_t i) const;

    /// Throws InputError: at pixel `i`, where `key` names what is wrong.
    [[noreturn]] void reject(std::size_t i, const std::string& key, const std::string& found,
                             const std::string& expected) const;
    [[noreturn]] void reject(const std::string& found, const std::string& expected) const;

    /// Whether the channel is `code` of 8 bits in every pixel.
    bool is_everywhere(const std::string& channel, std::uint32_t code) const;
    /// Whether every pixel has the check byte of either half.
    bool has_check_bytes() const;

    /// Whether R, G, B and A of 16 bits are codes of 10, 10, 10 and 2 bits throughout, and not all
    /// of B 0 and A opaque, as what carries 16 bits in R and G may have them.
    bool are_of_ten_bits() const;

  private:
    bool are_codes(const char* channel, int bits) const;
    bool is_constant(const char* channel, float value) const;

    const ComparableImage& image_;
};

}  // namespace quadrel
