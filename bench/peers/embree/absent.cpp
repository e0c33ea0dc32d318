// In place of the others where Embree was not found.
#include "embree/embree.hpp"

namespace quadrel::peers {

std::unique_ptr<EmbreeWall> build_embree_wall(const Scene&, int, std::string& why) {
    why = "built without Embree 3 (libembree-dev)";
    return nullptr;
}

}  // namespace quadrel::peers
