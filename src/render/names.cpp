#include "render/names.hpp"

#include <fmt/format.h>

namespace quadrel {

const char* name_of(Conventions conventions) {
    switch (conventions) {
        case Conventions::gl:
            return "gl";
        case Conventions::vulkan:
            return "vulkan";
        case Conventions::d3d:
            return "d3d";
    }
    return "";
}

const char* name_of(Hardware hardware) {
    switch (hardware) {
        case Hardware::exact:
            return "exact";
        case Hardware::d3d:
            return "d3d";
        case Hardware::vulkan_min:
            return "vulkan-min";
        case Hardware::llvmpipe:
            return "llvmpipe";
        case Hardware::swiftshader:
            return "swiftshader";
    }
    return "";
}

std::string component_name(Value v, int component, int light) {
    std::string name(info(v).name);
    if (info(v).per_light) name.insert(name.find('.'), fmt::format(".{}", light));
    if (info(v).components == 1) return name;
    if (v == Value::color) return std::string(1, "RGB"[component]);
    if (v == Value::hit_uv) return std::string("hit.") + "UV"[component];
    if (v == Value::bary) return name + "." + std::to_string(component);
    if (info(v).components == 6)  // the rows of a Jacobian
        return name + (component < 3 ? ".U." : ".V.") + "XYZ"[component % 3];
    const bool color = name.compare(0, 6, "light.") == 0;
    const char* letters = info(v).components == 2 ? "UV" : color ? "RGB" : "XYZ";
    return name + "." + letters[component];
}

}  // namespace quadrel
