#include "render/plan/names.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/scene/setting_words.hpp"

namespace quadrel {

namespace {

template <class Words, class T>
std::string name_in(const Words& words, T value) {
    const auto found = std::ranges::find(words, value, [](const auto& row) { return row.second; });
    return found == std::end(words) ? "" : std::string(found->first);
}

}  // namespace

std::string name_of(Conventions conventions) { return name_in(conventions_words, conventions); }
std::string name_of(Hardware hardware) { return name_in(hardware_words, hardware); }

std::string component_name(Value v, int component, int light) {
    std::string name(info(v).name);
    if (info(v).per_light) name.insert(name.find('.'), fmt::format(".{}", light));
    if (info(v).components == 1) return name;
    if (v == Value::color) return std::string(1, "RGB"[component]);
    if (v == Value::hit_uv) return std::string("hit.") + "UV"[component];
    if (v == Value::oracle_uv) return std::string("oracle.") + "UV"[component];
    if (v == Value::bary) return name + "." + std::to_string(component);
    if (info(v).components == 6)  // the rows of a Jacobian
        return name + (component < 3 ? ".U." : ".V.") + "XYZ"[component % 3];
    const bool color = name.compare(0, 6, "light.") == 0;
    const bool of_texels =
        info(v).components == 2 && v != Value::oracle_cell && v != Value::oracle_place;
    const char* letters = of_texels ? "UV" : color ? "RGB" : "XYZ";
    return name + "." + letters[component];
}

}  // namespace quadrel
