// The headers alone: a derivative, without a library. Compiles with warnings, which are not
// Quadrel's to make errors of.
#include <cstdio>

#include "quadrel/plugin.hpp"
#include "quadrel/testing.hpp"

int main() {
    using namespace quadrel;
    int warned_about;
    const auto quad = unit::run_quad<Quad<double>>(
        4, 4, [](const auto& xy) { return xy * xy.x * Quad<double>(0.25); });
    const bool derived = quad.dFdx_fine(0) == vec2<double>(2.5, 1.125);
    std::printf("derived %d\n", derived);
    return derived ? 0 : 1;
}
