#include <fmt/format.h>

#include <algorithm>

#include "export/scene/manifest.hpp"
#include "render/draw/shell.hpp"
#include "render/plan/names.hpp"

namespace quadrel {
namespace {

bool has_shell_table(const ExportContent& content) {
    return std::any_of(content.materials.begin(), content.materials.end(), [](const auto& of) {
        return std::any_of(of.samplers.begin(), of.samplers.end(), [](const ContentSampler& bound) {
            return bound.uniform == "shell_table";
        });
    });
}

std::string files_table(const ExportContent& content) {
    std::string text =
        "| file | holds |\n|---|---|\n| `manifest.json` | all that follows, and all state: the "
        "only index |\n";
    for (const ContentMaterial& material : content.materials) {
        const std::string name = content.scene->materials[material.material].name;
        text += fmt::format("| `{}` `{}` | shaders of the material `{}` |\n",
                            material.vertex_file(content.language),
                            material.fragment_file(content.language), name);
    }
    text +=
        "| `vertices.bin` `indices.bin` | float32 and uint32, little-endian, lists of triangles; "
        "layout in the manifest |\n"
        "| `textures/NAME.LEVEL.bin` | the bytes to upload: rows without gaps, row 0 first (v = "
        "0); "
        "faces and layers one after the other; cube maps are filtered across their edges "
        "(`GL_TEXTURE_CUBE_MAP_SEAMLESS`) |\n"
        "| `textures/NAME.LEVEL.exr` | the same, decoded |\n"
        "| `expected.exr` | what Quadrel draws: every channel that the shaders write |\n";
    if (has_shell_table(content))
        text +=
            "\n`shell_table` holds what faces of shells are made of, eight texels a row, which "
            "`face_row` numbers: row r\n"
            "begins at texel 8 (r mod 128) of line r / 128. Its texels are fetched; they are in "
            "eye "
            "space, and so is a\n"
            "shell's every vertex. Of a `frame-shell` face texels 0 to 2 hold the gradients of its "
            "corners' weights, 3 to 5 those\n"
            "of u, v and s; of a tetrahedron, which shadows go through, 0 to 3 those of its "
            "corners' and their s, 4 and 5\n"
            "their uv, 6 the rows behind its faces, 7 a point of it; of a `frame-prism` face 0 to "
            "2 the corners of the base,\n"
            "3 to 5 of the top, with their uv. What stands in w is named by the shader.\n";
    return text;
}

std::string channels_table(const ExportContent& content) {
    std::string text = "| pass | target | x y z w |\n|---|---|---|\n";
    for (std::size_t p = 0; p < content.passes.size(); ++p)
        for (int t = 0; t < content.passes[p].target_count; ++t) {
            std::string names;
            for (const ProgramChannel& of : content.passes[p].channels[t])
                if (of.kind != ProgramChannel::Kind::none)
                    names += fmt::format(" `{}`", channel_of(content.channels, of).name);
            text += fmt::format("| {} | {} |{} |\n", p, t, names);
        }
    return text;
}

std::string stages_text(const ExportContent& content) {
    std::string text;
    for (const ContentMaterial& material : content.materials) {
        text += fmt::format("- `{}`:", content.scene->materials[material.material].name);
        for (const std::string& stage : material.stages) text += " " + stage;
        text += "\n";
    }
    return text;
}

const char* conventions_text(Conventions conventions) {
    switch (conventions) {
        case Conventions::gl:
            return "Window y is up, clip z in [-w, w]: row 0 of what is read back is the bottom of "
                   "the "
                   "image.";
        case Conventions::vulkan:
            return "Window y and clip y are down, clip z in [0, w]: row 0 of what is read back is "
                   "the "
                   "top of the image.";
        case Conventions::d3d:
            return "Window y is down, clip y up, clip z in [0, w]: row 0 of what is read back is "
                   "the "
                   "top of the image. In OpenGL glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE).";
    }
    return "";
}

/// How the shaders are called, and where their numbers and textures lie.
const char* language_text(const std::string& language) {
    if (language == "wgsl")
        return "The vertex shader's entry point is `main`, pass N is the fragment shader's "
               "`passN`. "
               "All\n"
               "bindings are in group 0: numbers in one buffer at 0, which both shaders read (the "
               "manifest's\n"
               "`webgpu` has the offsets; matrices are floats by rows, without gaps), then "
               "textures "
               "and\n"
               "samplers. Textures of `r32float` and the like with a linear sampler need the "
               "feature\n"
               "`float32-filterable`. `SHADED_VERTICES` is a constant of the pipeline: false takes "
               "the\n"
               "mesh's own vertices and the matrices.\n";
    const char* const passes =
        "The fragment shader has `PASS` defined as the number of the pass (0 if it is not "
        "defined).\n"
        "Entry points are called `main`. ";
    static const std::string glsl = std::string(passes) +
                                    "Matrices are arrays of floats by rows. Uniforms that a "
                                    "shader does not\n"
                                    "have are passed over.\n";
    static const std::string hlsl =
        std::string(passes) +
        "Attributes have the semantic `ATTRIBUTE`, with their location\n"
        "behind it. Registers are left to the compiler, whose reflection tells them: of what is "
        "read,\n"
        "textures are t0, t1, ..., samplers s0, s1, ... in the order of their declaration, "
        "`height_map_sampler`\n"
        "beside `height_map`. Numbers lie in `$Globals` (b0) in their order, by HLSL's rules of "
        "packing: each\n"
        "element of an array begins at a multiple of 16 bytes. Matrices are such arrays, by rows, "
        "and\n"
        "multiply column vectors: element 4 r + c of 16, 3 r + c of 9, stands in row r and column "
        "c.\n"
        "There are no matrix types, so neither `row_major` nor a compiler's default has a say.\n";
    return (language == "hlsl" ? hlsl : glsl).c_str();
}

/// What vertices are made of, and what a port replaces.
std::string vertices_text(const ExportContent& content) {
    const auto is_shell = [&](const ContentMaterial& of) {
        return draws_shell(content.scene->materials[of.material]);
    };
    const auto& all = content.materials;
    std::string text;
    if (content.language != "wgsl" && !std::all_of(all.begin(), all.end(), is_shell))
        text +=
            "`SHADED_VERTICES` (1 where it is not defined) takes each varying from an attribute "
            "that has Quadrel's own\n"
            "value, so that what comes after is judged by itself; 0 makes it of the mesh's own "
            "vertices by the matrices,\n"
            "as a port does.\n";
    if (std::any_of(all.begin(), all.end(), is_shell))
        text +=
            "Shells are for this view alone: their triangles are those that a geometry shader "
            "would emit, in eye space\n"
            "and clip space, whatever `SHADED_VERTICES` says.\n";
    return text;
}

std::string samples_text(const Scene& scene) {
    if (scene.samples == 1) return "";
    return fmt::format(
        "\nA pixel has {} samples. R, G, B and A are means over them, Z is the nearest; of all "
        "other channels a\n"
        "pixel has the value at the lowest sample that something covers. Where samples lie is an\n"
        "implementation's choice, and decides over pixels at edges (`quadrel-gl --probe --only "
        "samples`).\n",
        scene.samples);
}

}  // namespace

std::string folder_readme(const ExportContent& content) {
    const Scene& scene = *content.scene;
    return fmt::format(
        "# {} for a GPU\n\n"
        "The scene `{}` at {}x{}, written by `quadrel export`: shaders in {} out of the texts "
        "that\n"
        "Quadrel computes by, and what it computes. A port, or a GPU, is judged by drawing this "
        "and\n"
        "`quadrel compare expected.exr yours.exr`.\n\n"
        "## Files\n\n{}\n"
        "## To draw\n\n"
        "Each pass draws everything into its targets, 32-bit floats, with a cleared depth buffer. "
        "Draws\n"
        "are in order, with the depth test of the manifest's `state`.\n"
        "{}{}\n{}\n{}\n"
        "Pixels that nothing covers hold the manifest's `clear` values. Whole numbers (`uint`) "
        "are\n"
        "written as floats.\n\n{}\n"
        "What a program that reads the manifest meets: `count` is 0 for a uniform that is no "
        "array; among a\n"
        "target's `channels` `null` is a component that holds none; a number that JSON has not is "
        "a string,\n"
        "`\"inf\"`, `\"-inf\"` or `\"nan\"`, as in `clear`.\n\n"
        "## Stages\n\n{}\n"
        "`expected.exr` was drawn with `hardware: {}`. What a GPU may do differently within its\n"
        "specification, `quadrel render --limits` tells.\n",
        scene.file.stem().string(), scene.file.filename().string(), scene.width, scene.height,
        content.language, files_table(content), language_text(content.language),
        vertices_text(content), conventions_text(scene.conventions), samples_text(scene),
        channels_table(content), stages_text(content), name_of(scene.hardware));
}

}  // namespace quadrel
