#include "quadrel/scene/default_stage.hpp"

namespace quadrel {

std::string default_stage(std::string_view room, HeightSource heights) {
    if (room == "shade") return "shade-thesis";
    if (heights == HeightSource::layers) {
        if (room == "trace") return "multilayer";
        if (room == "surface") return "h2n-layers";
        if (room == "shadow") return "shadow-layers";
    }
    if (heights != HeightSource::none) {
        if (room == "frame") return "frame-gram";
        if (room == "trace") return "linear";
        if (room == "surface") return heights == HeightSource::noise ? "h2n-patch" : "h2n-thesis";
        if (room == "shadow") return "shadow-march-thesis";
    }
    return std::string(room) + "-none";
}

}  // namespace quadrel
