#include "kernels/rows.hpp"

namespace quadrel {

const KernelTable& scalar_double_kernels() { return kernel_table<Quad<double>>("scalar"); }

}  // namespace quadrel
