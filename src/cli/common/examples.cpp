#include "cli/common/examples.hpp"

#include <CLI/CLI.hpp>
#include <string>

namespace quadrel::cli {
namespace {

constexpr Example all[] = {
    {"render", "bricks-45 -o bricks.exr --preview bricks.png", "an installed scene, and a picture"},
    {"render", "scene.json -D material.relief.trace=cone-cell --channels R,G,B,hit,N",
     "another search, and where its rays end"},
    {"render", "bricks-45 --size 48x48 --integrate 64 -o truth.exr",
     "each pixel the mean over its area, for judging mip levels"},
    {"render", "bricks-45 --inject hit.uv=gpu.exr --channels N,R,G,B -o later.exr",
     "normals and colour from a GPU's own hits"},
    {"render", "bricks-45 --size 65536x65536 --task 3/64 -o part-3.exr",
     "one part of a frame that many machines draw"},
    {"compare", "bricks.exr port.exr --abs 1e-4 --heatmap difference.png",
     "allow a small error, and show where there is more"},
    {"compare", "bricks.exr port.png --channels R,G,B --encode srgb8 --ulp 1",
     "against a picture of 8 bits, a code apart at most"},
    {"compare", "bricks-45 port.exr --against oracle",
     "how far what a port drew of a scene is from the truth"},
    {"compare", "shot.png bricks.exr --decode bits:hit.U",
     "a screenshot that carries a float's bits, exactly"},
    {"compare", "ranges.exr port.exr --legal --heatmap verdicts.png",
     "by what the reference says that a value may be"},
    {"list", "algorithms cone", "stages whose texts have the word cone"},
    {"list", "scenes --json", "for programs"},
    {"info", "bricks.exr", "channels with their ranges, attributes, hash"},
    {"info", "bricks-45 --json", "what an installed scene is made of"},
    {"explain", "material.relief.depth hit.status", "a key of scenes and a channel"},
    {"explain", "linear 75", "a stage and an exit code"},
    {"probe", "bricks-45 --pixel 200,300", "all that one pixel's quad goes through"},
    {"probe", "scene.json --pixel 0,0 --number double --json", "in double, for programs"},
    {"errors", "bricks-45 --window 200,200,264,264",
     "late, early and missed hits, and how far they are off"},
    {"errors", "scene.json -D material.relief.steps=32 --json", "of fewer steps, for programs"},
    {"sheet", "bricks-45 stones-45 -o walls.png --size 200x200", "two scenes side by side"},
    {"sheet", "bricks-45 --each material.relief.steps=8,32,128 -o steps.png",
     "one scene with three values of a key"},
    {"mips", "wall.png --srgb -o wall", "wall.0.exr, wall.1.exr, ..., filtered as light"},
    {"mips", "heights.exr --format unorm16 --rule area -o heights", "as a port uploads them"},
    {"bake", "heights.exr --kind cone-cell -o cones.exr", "into a file and into the cache"},
    {"bake", "heights.png --kind relaxed-cone --packed relaxed.png --packing gg3",
     "in the channels of its source, 8 bits each"},
    {"bake", "--kind depth-layers --mesh fence.obj --size 512x512 -o fence.exr",
     "sorted depths of a closed mesh, to look behind it"},
    {"sweep", "plan.json -o sweep", "run time against error, as a page, CSV, JSON and SVG"},
    {"sweep", "plan.json -o part2 --task 2/8", "the second of eight jobs"},
    {"sweep", "--merge part1 part2 -o sweep", "what the jobs have measured, as one"},
    {"advise", "scene.json --error 0.5texel --angles 0..75",
     "what is exact enough, cheapest first"},
    {"advise", "scene.json --error 1texel --angles 0..60 --budget 24",
     "with at most 24 look-ups per fragment"},
    {"export", "thesis-quad --size 8x8 -o thesis-quad-gl",
     "shaders, buffers, textures, and what they should draw"},
    {"export", "scene.json --language hlsl -D conventions=d3d -o scene-hlsl", "for Direct3D"},
    {"export", "bricks-45 --size 256x256 --page judge.html",
     "a page that judges the GPU it is opened on"},
    {"export", "--stage trace/linear -D steps=64 -o linear.glsl", "a search as a GLSL function"},
    {"export", "--list", "which stages are written, and why others are not"},
    {"export", "--snippets --language hlsl", "functions that pack a float into RGBA8"},
    {"export", "--pattern 640x480 -o pattern.exr",
     "what a screenshot must come back as if no bit gets lost"},
    {"view", "bricks.exr -o view.html", "a page to look at every value, in any browser"},
    {"view", "bricks.exr port.exr --channels R,G,B,hit,N -o view.html",
     "two images side by side, and where they differ"},
    {"join", "part-*.exr -o bricks.exr", "what render --task has drawn, as one image"},
    {"join", "part-1.exr part-2.exr -o bricks.exr --compression piz", "likewise, of two parts"},
    {"man", "render", "to be read by `quadrel man render | man -l -`"},
    {"man", "-o man", "all pages, as man looks for them: `man -M man quadrel`"},
    {"completion", "bash", "to be read by `source <(quadrel completion bash)`"},
    {"completion", "words -- render bricks", "what a shell is told of a line"},
};

}  // namespace

std::span<const Example> examples() { return all; }

void add_examples(CLI::App& program) {
    for (CLI::App* verb : program.get_subcommands(nullptr)) {
        std::string text = verb->get_footer();
        text += text.empty() ? "Examples:" : "\n\nExamples:";
        for (const Example& example : all)
            if (verb->get_name() == example.verb)
                text += "\n  " + program.get_name() + " " + example.verb + " " + example.arguments +
                        "\n      " + example.meaning;
        verb->footer(text);
    }
}

}  // namespace quadrel::cli
