// A value of a batch as the film keeps it: single lanes, or runs of quads as pixel rows.
#pragma once

#include <bit>
#include <cstdint>

#include "quadrel/film/film.hpp"

namespace quadrel {

/// A value's array as film bits: float32 with canonical NaNs, or uint32.
class LaneBits {
  public:
    enum class Element { integer, single, wide };

    /// `negated`: with the opposite sign; not for integers.
    LaneBits(const void* array, Element element, bool negated = false)
        : array_(array), element_(element), sign_(negated ? 0x80000000u : 0u) {}

    std::uint32_t operator()(int lane) const {
        if (element_ == Element::integer) return static_cast<const std::uint32_t*>(array_)[lane];
        const float x = element_ == Element::single
                            ? static_cast<const float*>(array_)[lane]
                            : static_cast<float>(static_cast<const double*>(array_)[lane]);
        return canonical_bits(std::bit_cast<std::uint32_t>(mean(x)) ^ sign_);
    }

    /// The same, resolved over so many equal samples, as film/resolve.hpp does. Not for integers.
    LaneBits resolved(int samples) const {
        LaneBits bits = *this;
        bits.samples_ = samples;
        return bits;
    }

    /// The same of `quads` quads that lie side by side, from lane `first` on: lanes 0 and 1 of each
    /// become the next two pixels of the row `even`, lanes 2 and 3 of the row `odd`.
    void rows(int first, int quads, std::uint32_t* even, std::uint32_t* odd) const;

  private:
    /// Of equal samples, added one after another: it overflows where that does.
    float mean(float x) const {
        float sum = x;
        for (int s = 1; s < samples_; ++s) sum += x;
        return sum * (1.0f / static_cast<float>(samples_));
    }

    const void* array_;
    Element element_;
    std::uint32_t sign_;
    int samples_ = 1;
};

}  // namespace quadrel
