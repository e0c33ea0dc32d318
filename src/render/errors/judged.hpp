// Whether there was anything to judge.
#pragma once

#include "quadrel/errors.hpp"

namespace quadrel {

/// Throws InputError, with the reason, where no pixel was judged: figures of nothing would look
/// like those of a scene without errors.
void require_judged(const ErrorSummary& summary, const Scene& scene);

}  // namespace quadrel
