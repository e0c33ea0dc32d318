// The commands of glman scene files that are understood: those of "Derivative-Based Relief
// Mapping" (2012), appendix, Parallax.glib.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace quadrel {

enum class GlibVerb {
    background,
    perspective,
    look_at,
    cube_map,
    texture_2d,
    vertex,
    fragment,
    program,
    quad_xy,
    sphere,
    torus,
    teapot,
};

/// A command and what it takes, for messages.
struct GlibCommandText {
    GlibVerb verb;
    std::string_view name, signature;
};

/// The row of a command's name, in any case as in glman; null if it is not known.
const GlibCommandText* find_glib_command(std::string_view name);

std::vector<std::string_view> glib_command_names();

/// Whether the file's name says that it is a glman scene: it ends in ".glib", in any case.
bool is_glib_file(const std::filesystem::path& file);

/// A path as glman's files write it: on Windows, where a backslash separates folders.
std::filesystem::path with_slashes(std::string path);

}  // namespace quadrel
