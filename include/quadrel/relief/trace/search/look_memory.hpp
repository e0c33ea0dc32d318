// What a thread remembers of whether looking ahead has paid. No result depends on it: a look only
// spares steps that would have found nothing.
#pragma once

#include <algorithm>

#include "quadrel/texture/height_maxima.hpp"

namespace quadrel {

/// Of one search in one height map, packet after packet. Where looks have cost more than they
/// spared, over so many packets that a map's hills and hollows even out, most of the next packets
/// make every step, and one now and then tries again.
class LookMemory {
  public:
    /// Whether a packet should look ahead.
    bool looks(const HeightMaxima* maxima) {
        if (maxima_ != maxima) *this = LookMemory(maxima);
        return idle_ == 0 || --idle_ == 0;
    }

    /// What a packet that looked ahead has gained, less than 0 if it lost; in any unit of which a
    /// packet's plain search takes some hundred.
    void learn(int gain) {
        balance_ = std::clamp(balance_ + gain, -most, most);
        const bool lost = balance_ < 0 && gain < 0;
        pause_ = lost ? std::min(2 * pause_, longest_pause) : shortest_pause;
        idle_ = lost ? pause_ : 0;
    }

    constexpr LookMemory() = default;

  private:
    explicit LookMemory(const HeightMaxima* maxima) : maxima_(maxima) {}

    static constexpr int most = 16384, shortest_pause = 4, longest_pause = 128;

    const HeightMaxima* maxima_ = nullptr;
    int balance_ = 0, pause_ = shortest_pause;
    int idle_ = 0;  ///< packets that make every step, the last of which tries again
};

/// This thread's, of a search of this type.
template <class Search>
LookMemory& look_memory() {
    static thread_local LookMemory memory;
    return memory;
}

}  // namespace quadrel
