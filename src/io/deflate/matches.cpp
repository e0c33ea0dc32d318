#include "io/deflate/matches.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace quadrel {
namespace {

constexpr int hash_bits = 15;

template <class T>
T load(const std::uint8_t* from) {
    T value;
    std::memcpy(&value, from, sizeof value);
    return value;
}

std::size_t hash_of(std::uint32_t bytes) { return bytes * 2654435761u >> (32 - hash_bits); }

/// How many bytes are equal, at most `most`.
std::size_t equal_bytes(const std::uint8_t* a, const std::uint8_t* b, std::size_t most) {
    std::size_t n = 0;
    for (; n + 8 <= most; n += 8) {
        const std::uint64_t difference = load<std::uint64_t>(a + n) ^ load<std::uint64_t>(b + n);
        if (difference != 0) return n + static_cast<std::size_t>(std::countr_zero(difference) / 8);
    }
    while (n < most && a[n] == b[n]) ++n;
    return n;
}

}  // namespace

MatchFinder::MatchFinder() : latest_(std::size_t(1) << hash_bits) {}

void MatchFinder::start() { std::fill(latest_.begin(), latest_.end(), 0); }

void MatchFinder::find(const std::uint8_t* in, std::size_t first, std::size_t last,
                       std::vector<Match>& found) {
    constexpr std::size_t shortest = 4;
    constexpr unsigned patience = 5;  // look-ups in vain, as a power of two, before a longer step
    found.clear();
    std::size_t at = first, literals = first, misses = 0;
    while (at + shortest <= last) {
        const auto bytes = load<std::uint32_t>(in + at);
        std::uint32_t& latest = latest_[hash_of(bytes)];
        const std::size_t before =
            latest;  // 0 where there is none, which is a position like others
        latest = static_cast<std::uint32_t>(at);
        if (at - before - 1 >= farthest_match || load<std::uint32_t>(in + before) != bytes) {
            at += 1 + (misses++ >> patience);
            continue;
        }
        const std::size_t most = std::min(longest_match, last - at);
        const std::size_t length =
            shortest + equal_bytes(in + at + shortest, in + before + shortest, most - shortest);
        found.push_back({static_cast<std::uint32_t>(at - literals),
                         static_cast<std::uint16_t>(length),
                         static_cast<std::uint16_t>(at - before)});
        at += length;
        literals = at;
        misses = 0;
    }
    found.push_back({static_cast<std::uint32_t>(last - literals), 0, 0});
}

}  // namespace quadrel
