// Plain code after lanes.
#pragma once

namespace quadrel::oracle {

/// Kernels of wide lanes may return with upper halves of registers in use. Then every change
/// between plain instructions and those of libm costs some 70 cycles, until this is called.
inline void leave_upper_halves() {
#if defined(__x86_64__)
    static const bool has_them = __builtin_cpu_supports("avx");
    if (has_them) asm volatile("vzeroupper");
#endif
}

}  // namespace quadrel::oracle
