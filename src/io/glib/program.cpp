#include "io/glib/program.hpp"

#include <algorithm>

#include "io/glib/commands.hpp"
#include "text/suggest.hpp"

namespace quadrel {
namespace {

constexpr std::string_view depth_uniform = "MaxParallaxOffset";

std::vector<std::string_view> known_uniforms() {
    std::vector<std::string_view> names;
    for (const GlibSampler& sampler : glib_samplers) names.push_back(sampler.uniform);
    names.push_back(depth_uniform);
    return names;
}

const GlibSampler* find_sampler(std::string_view uniform) {
    const auto* const found =
        std::find_if(glib_samplers.begin(), glib_samplers.end(),
                     [&](const GlibSampler& sampler) { return sampler.uniform == uniform; });
    return found == glib_samplers.end() ? nullptr : found;
}

[[noreturn]] void reject_uniform(const GlibArguments& arguments, const GlibWord& name) {
    if (find_glib_command(name.text))
        arguments.fail(name.at, "the command " + quoted(name.text),
                       "a parameter, since the line before ends in a backslash");
    arguments.fail(name.at, quoted(name.text),
                   "a parameter of Parallax: " + one_of(name.text, known_uniforms()));
}

void read_depth(GlibArguments& arguments, const GlibWord& name, GlibProgram& program) {
    if (program.depth) arguments.fail(name.at, name.text + " a second time", "each parameter once");
    program.depth = arguments.number_or_slider("the depth of the relief");
    if (program.depth->value < 0)
        arguments.fail(program.depth->at, "a depth below 0", "a number >= 0");
}

void read_parameter(GlibArguments& arguments, GlibProgram& program) {
    const GlibWord& name = arguments.word("a parameter");
    if (name.text == depth_uniform) return read_depth(arguments, name, program);
    const GlibSampler* const sampler = find_sampler(name.text);
    if (!sampler) reject_uniform(arguments, name);
    const GlibBinding binding{arguments.unit(), name.at};
    if (!program.samplers.emplace(sampler->uniform, binding).second)
        arguments.fail(name.at, name.text + " a second time", "each parameter once");
}

}  // namespace

void read_glib_shader(GlibArguments& arguments, std::string_view file_name) {
    const std::string expected = std::string(file_name) +
                                 " of \"Derivative-Based Relief Mapping\", which Quadrel knows; "
                                 "GLSL is not run";
    const GlibWord& word = arguments.word(expected);
    if (with_slashes(word.text).filename() != file_name)
        arguments.fail(word.at, quoted(word.text), expected);
}

GlibProgram read_glib_program(GlibArguments& arguments) {
    read_glib_shader(arguments, "Parallax");
    GlibProgram program{arguments.name().at, {}, {}};
    while (arguments.has_more()) read_parameter(arguments, program);
    return program;
}

}  // namespace quadrel
