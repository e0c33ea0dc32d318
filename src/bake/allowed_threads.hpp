// More threads than there are processors, for who asks for them.
#pragma once

#include <tbb/global_control.h>

#include <cstddef>
#include <optional>

namespace quadrel {

/// While it lives, arenas of up to `threads` slots get their workers, whatever the number of
/// processors; 0 changes nothing. To be made before other work of the process is in parallel: TBB
/// then settles how many workers there can be at all (256 or more).
class AllowedThreads {
  public:
    explicit AllowedThreads(int threads) {
        constexpr auto most = tbb::global_control::max_allowed_parallelism;
        const auto wanted = static_cast<std::size_t>(threads);
        if (wanted > tbb::global_control::active_value(most)) control_.emplace(most, wanted);
    }

  private:
    std::optional<tbb::global_control> control_;
};

}  // namespace quadrel
