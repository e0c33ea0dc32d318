// Bits into bytes as deflate has them: the first bit is the lowest of the first byte.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace quadrel {

/// Writes where there is room: up to 8 bytes further than what it is given comes to.
class BitWriter {
  public:
    static_assert(std::endian::native == std::endian::little, "the lowest byte comes first");

    explicit BitWriter(std::uint8_t* out) : next_(out) {}

    /// `bits` below 2^count. At most 56 bits between two flushes.
    void add(std::uint64_t bits, int count) {
        waiting_ |= bits << count_;
        count_ += count;
    }

    void flush() {
        std::memcpy(next_, &waiting_, sizeof waiting_);
        next_ += count_ >> 3;
        waiting_ >>= count_ & ~7;
        count_ &= 7;
    }

    /// To the next whole byte, where the caller goes on writing at the address that is returned.
    std::uint8_t*& align() {
        flush();
        if (count_ > 0) ++next_;
        waiting_ = 0;
        count_ = 0;
        return next_;
    }

  private:
    std::uint8_t* next_;
    std::uint64_t waiting_ = 0;
    int count_ = 0;
};

}  // namespace quadrel
