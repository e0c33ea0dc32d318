// The one program that a glman scene file can name here: the relief mapping shaders of
// "Derivative-Based Relief Mapping" (2012), Parallax.vert and Parallax.frag, as published.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>

#include "io/glib/arguments.hpp"

namespace quadrel {

/// A sampler of Parallax.frag and the map of a material that stands for it.
struct GlibSampler {
    std::string_view uniform;
    std::string_view map;      ///< "color", "height", ...; "environment" is the cube
    std::string_view swizzle;  ///< of the texture; empty: as stored
};

/// Texels reach the published stages in the order A R G B, as the listing's note on 32-bit bitmaps
/// has it. For the colour map that is what its .gba means; the gloss and emissive maps carry three
/// channels, which the listing takes by .r .g .b: the swizzle puts the file's there.
inline constexpr std::array<GlibSampler, 5> glib_samplers{
    {{"Environment_Map", "environment", ""},
     {"Color_Map", "color", ""},
     {"Emissive_Map", "emissive", "gb0r"},
     {"Gloss_Map", "gloss", "gb0r"},
     {"Normal_Map", "height", "alpha-or-first"}}};

/// The texture unit that a sampler reads.
struct GlibBinding {
    int unit = 0;
    TextPosition at;
};

/// A Program command.
struct GlibProgram {
    TextPosition at;
    std::map<std::string_view, GlibBinding> samplers;  ///< by uniform, those that are given
    std::optional<GlibNumber> depth;                   ///< MaxParallaxOffset
};

/// Reads what follows Vertex, Fragment or Program; throws InputError for another shader than the
/// thesis'.
void read_glib_shader(GlibArguments& arguments, std::string_view file_name);
GlibProgram read_glib_program(GlibArguments& arguments);

}  // namespace quadrel
