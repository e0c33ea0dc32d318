// What of a stream repeats what came before it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace quadrel {

/// So many bytes as they are, then `length` bytes of `distance` bytes ago; the last one of a block
/// may have no such bytes: length 0.
struct Match {
    std::uint32_t literals;
    std::uint16_t length, distance;
};

constexpr std::size_t longest_match = 258, farthest_match = 32768;

/// Looks a position up by its next four bytes in a table of the last place of each hash, takes what
/// it finds, and where nothing repeats looks at ever fewer positions: bytes of floats are noise for
/// long stretches.
class MatchFinder {
  public:
    MatchFinder();
    /// Forgets the stream before.
    void start();
    /// The block [first, last) of a stream that begins at `in`, blocks in order.
    void find(const std::uint8_t* in, std::size_t first, std::size_t last,
              std::vector<Match>& found);

  private:
    std::vector<std::uint32_t> latest_;  ///< position by hash
};

}  // namespace quadrel
