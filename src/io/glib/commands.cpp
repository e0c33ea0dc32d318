#include "io/glib/commands.hpp"

#include <algorithm>

namespace quadrel {
namespace {

constexpr GlibCommandText commands[] = {
    {GlibVerb::background, "Background", "red green blue"},
    {GlibVerb::perspective, "Perspective", "field-of-view"},
    {GlibVerb::look_at, "LookAt", "eye-x -y -z  target-x -y -z  up-x -y -z"},
    {GlibVerb::cube_map, "CubeMap", "unit  +x -x  +y -y  +z -z"},
    {GlibVerb::texture_2d, "Texture2D", "unit file"},
    {GlibVerb::vertex, "Vertex", "file"},
    {GlibVerb::fragment, "Fragment", "file"},
    {GlibVerb::program, "Program", "name parameters"},
    {GlibVerb::quad_xy, "QuadXY", "z size columns rows"},
    {GlibVerb::sphere, "Sphere", "radius slices stacks"},
    {GlibVerb::torus, "Torus", "inner-radius outer-radius sides rings"},
    {GlibVerb::teapot, "Teapot", ""},
};

// ASCII only: what a letter is must not depend on the locale.
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool equal_in_any_case(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return lower(x) == lower(y); });
}

}  // namespace

const GlibCommandText* find_glib_command(std::string_view name) {
    for (const GlibCommandText& command : commands)
        if (equal_in_any_case(command.name, name)) return &command;
    return nullptr;
}

std::vector<std::string_view> glib_command_names() {
    std::vector<std::string_view> names;
    for (const GlibCommandText& command : commands) names.push_back(command.name);
    return names;
}

bool is_glib_file(const std::filesystem::path& file) {
    return equal_in_any_case(file.extension().string(), ".glib");
}

std::filesystem::path with_slashes(std::string path) {
    std::replace(path.begin(), path.end(), '\\', '/');
    return path;
}

}  // namespace quadrel
