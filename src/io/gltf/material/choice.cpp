#include "io/gltf/material/choice.hpp"

#include <fmt/format.h>

#include "text/suggest.hpp"

namespace quadrel {
namespace {

int material_count(const GltfFile& file) {
    const auto found = file.json.find("materials");
    return found == file.json.end() ? 0 : static_cast<int>(found->size());
}

int material_of_number(const GltfFile& file, int number) {
    const int count = material_count(file);
    if (number < -1 || number >= count)
        file.fail("materials", fmt::format("no number {}", number),
                  fmt::format("-1 to {}, as many as there are", count - 1));
    return number;
}

int material_of_name(const GltfFile& file, const std::string& name) {
    std::vector<std::string> names;
    int found = -1, equal = 0;
    for (int i = 0; i < material_count(file); ++i) {
        names.push_back(gltf_material_name(file, i));
        if (names.back() != name) continue;
        if (equal++ == 0) found = i;
    }
    if (equal == 0) file.fail("materials", "none named \"" + name + "\"", one_of(name, names));
    if (equal > 1)
        file.fail("materials", fmt::format("{} named \"{}\"", equal, name),
                  fmt::format("one, or its number; the first is {}", found));
    return found;
}

}  // namespace

int gltf_material(const GltfFile& file, const MaterialChoice& choice) {
    if (const int* const number = std::get_if<int>(&choice))
        return material_of_number(file, *number);
    return material_of_name(file, std::get<std::string>(choice));
}

std::string gltf_material_name(const GltfFile& file, int material) {
    if (material < 0) return "no material";
    const auto& described = file.json["materials"].at(static_cast<std::size_t>(material));
    const auto name = described.find("name");
    if (name != described.end() && name->is_string() && !name->get<std::string>().empty())
        return name->get<std::string>();
    return fmt::format("materials[{}]", material);
}

}  // namespace quadrel
