// The linker sends calls of _Exit here (CMakeLists.txt): a failed QUADREL_CHECK becomes an abort,
// of which libFuzzer keeps the input.
#include <cstdlib>

#include "quadrel/error.hpp"

extern "C" {
[[noreturn]] void __real__Exit(int code);

[[noreturn]] void __wrap__Exit(int code) {
    if (code == static_cast<int>(quadrel::ExitCode::internal)) std::abort();
    __real__Exit(code);
}
}
