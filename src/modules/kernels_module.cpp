// One instruction-set module: every stage over this instruction set's lanes.
#include "kernels/table.hpp"

#define QUADREL_TEXT(x) #x
#define QUADREL_NAME(x) QUADREL_TEXT(x)

namespace quadrel {

// Made by CMake from kernels/table.cpp.in.
const KernelTable& lanes_kernels(const char* isa);

}  // namespace quadrel

extern "C" __attribute__((visibility("default"))) const quadrel::KernelTable*
quadrel_kernel_table() {
    return &quadrel::lanes_kernels(QUADREL_NAME(QUADREL_ISA));
}
