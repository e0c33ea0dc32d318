// Whether a list of stages has one of a name.
#pragma once

#include <string_view>

#include "quadrel/quad/stage_list.hpp"

namespace quadrel {

template <class... S>
bool is_listed(StageList<S...>, std::string_view id) {
    return ((id == S::text.id) || ...);
}

}  // namespace quadrel
