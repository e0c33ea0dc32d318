// The number of threads that a caller asks for, as TBB understands it.
#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <optional>

namespace quadrel {

/// While it lives, arenas of up to `threads` slots get their workers, whatever the number of
/// processors; 0 or less changes nothing. To be made before other work of the process is in
/// parallel: TBB then settles how many workers there can be at all (256 or more).
class AllowedThreads {
  public:
    explicit AllowedThreads(int threads) {
        constexpr auto most = tbb::global_control::max_allowed_parallelism;
        const auto wanted = static_cast<std::size_t>(std::max(threads, 0));
        if (wanted > tbb::global_control::active_value(most)) control_.emplace(most, wanted);
    }

  private:
    std::optional<tbb::global_control> control_;
};

/// Where `threads` threads work; 0 or less: as many as the process may use. No more than there can
/// be: TBB would complain.
inline tbb::task_arena arena_of(int threads) {
    constexpr auto most = tbb::global_control::max_allowed_parallelism;
    if (threads <= 0) return tbb::task_arena(tbb::task_arena::automatic);
    return tbb::task_arena(
        std::min(threads, static_cast<int>(tbb::global_control::active_value(most))));
}

}  // namespace quadrel
