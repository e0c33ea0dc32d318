// Lists of stages, as the registry and the kernels take them.
#pragma once

namespace quadrel {

template <class... Stages>
struct StageList {};

}  // namespace quadrel
