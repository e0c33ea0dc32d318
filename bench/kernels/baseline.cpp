// Every stage on Quad<float>, built without auto-vectorisation: what the lanes are measured
// against.
#include "kernels/table.hpp"

namespace quadrel {

// Made by CMake from kernels/table.cpp.in.
const KernelTable& baseline_kernels(const char* isa);

}  // namespace quadrel

extern "C" __attribute__((visibility("default"))) const quadrel::KernelTable*
quadrel_kernel_table() {
    return &quadrel::baseline_kernels("baseline");
}
