// Scripts by which shells ask the program for what may stand next.
#pragma once

#include <span>

namespace quadrel::cli {

struct ShellScript {
    const char* shell;
    const char* text;
};

/// For bash, zsh and fish, in this order.
std::span<const ShellScript> shell_scripts();

}  // namespace quadrel::cli
