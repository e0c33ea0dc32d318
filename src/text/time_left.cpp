#include "text/time_left.hpp"

#include <fmt/format.h>

namespace quadrel {

std::string time_left(double seconds, double share) {
    if (!(seconds > 2 && share > 0.005 && share < 1)) return "";
    const double left = seconds / share - seconds;
    if (left < 5) return "";
    if (left < 90) return fmt::format("about {:.0f} s left", left);
    return left < 5400 ? fmt::format("about {:.0f} min left", left / 60)
                       : fmt::format("about {:.1f} hours left", left / 3600);
}

}  // namespace quadrel
