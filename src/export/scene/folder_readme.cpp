#include <fmt/format.h>

#include "export/scene/manifest.hpp"
#include "render/plan/names.hpp"

namespace quadrel {
namespace {

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
        "Each pass draws everything into its targets, 32-bit floats, with a cleared depth buffer; "
        "the\n"
        "fragment shader has `PASS` defined as the number of the pass (0 if it is not defined). "
        "Entry\n"
        "points are called `main`. Matrices are arrays of floats by rows. Draws are in order, with "
        "the\n"
        "depth test of the manifest's `state`. Uniforms that a shader does not have are passed "
        "over.\n"
        "{}\n"
        "Pixels that nothing covers hold the manifest's `clear` values. Whole numbers (`uint`) "
        "are\n"
        "written as floats.\n\n{}\n"
        "## Stages\n\n{}\n"
        "`expected.exr` was drawn with `hardware: {}`. What a GPU may do differently within its\n"
        "specification, `quadrel render --limits` tells.\n",
        scene.file.stem().string(), scene.file.filename().string(), scene.width, scene.height,
        content.language, files_table(content), conventions_text(scene.conventions),
        channels_table(content), stages_text(content), name_of(scene.hardware));
}

}  // namespace quadrel
