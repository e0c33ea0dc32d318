#include "kernels/rows.hpp"

namespace quadrel {

const KernelTable& scalar_float_kernels() { return kernel_table<Quad<float>>("scalar"); }

}  // namespace quadrel
