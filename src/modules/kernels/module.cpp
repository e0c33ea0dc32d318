// One instruction-set module: every stage over this instruction set's lanes.
#include "quadrel/num/lanes.hpp"

#include "kernels/rows.hpp"

#define QUADREL_TEXT(x) #x
#define QUADREL_NAME(x) QUADREL_TEXT(x)

extern "C" __attribute__((visibility("default"))) const quadrel::KernelTable*
quadrel_kernel_table() {
    return &quadrel::kernel_table<quadrel::Lanes>(QUADREL_NAME(QUADREL_ISA));
}
