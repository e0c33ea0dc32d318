// Every stage on Quad<float>, built without auto-vectorisation: what the lanes are measured
// against.
#include "kernels/rows.hpp"

extern "C" __attribute__((visibility("default"))) const quadrel::KernelTable*
quadrel_kernel_table() {
    return &quadrel::kernel_table<quadrel::Quad<float>>("baseline");
}
