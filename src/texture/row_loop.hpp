// For loops over rows of texels in files that are compiled for any processor.
#pragma once

/// A function whose loops take the widest vectors that the processor has. Its values must be the
/// same on all of them: comparisons, magnitudes, sums of two. (Which copy runs is chosen while the
/// program starts, before the sanitizers are ready.)
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define QUADREL_ROW_LOOP [[gnu::target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")]]
#else
#define QUADREL_ROW_LOOP
#endif
