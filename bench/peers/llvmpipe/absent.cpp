// In place of the others where EGL or libepoxy was not found.
#include "llvmpipe/llvmpipe.hpp"

namespace quadrel::peers {

std::unique_ptr<Llvmpipe> open_llvmpipe(int, std::string& why) {
    why = "built without EGL (libegl-dev, libepoxy-dev)";
    return nullptr;
}

}  // namespace quadrel::peers
