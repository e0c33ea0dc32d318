#include "export/stages/stage_text.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <map>

#include "export/print/fold/carried_vectors.hpp"
#include "export/print/fold/fold.hpp"
#include "export/print/wrapped_line.hpp"
#include "export/print/writer.hpp"
#include "export/stages/named_parameters.hpp"
#include "export/stages/plain_maps.hpp"
#include "export/stages/vertex_part.hpp"
#include "export/stages/vertex_transforms.hpp"

namespace quadrel::recorded {
namespace {

std::string function_name(const StageText& text) {
    return as_word(std::string(text.room) + "_" + text.id);
}

std::string comment(const std::string& text) { return wrapped_line("// " + text) + "\n"; }

std::string seat_text(float seat) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", static_cast<double>(seat));
    return text;
}

std::string size_text(int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
}

std::string wrap_text(const PlainScene& plain) {
    static const char* const words[] = {"repeat", "mirrored-repeat", "clamp-to-edge",
                                        "clamp-to-border", "mirror-once"};
    const std::string u = words[static_cast<int>(plain.wrap_u)];
    const std::string v = words[static_cast<int>(plain.wrap_v)];
    return u == v ? u : u + " along u and " + v + " along v";
}

/// What a uniform is, and what it is to be set to where that is not its default.
std::string comment_with_value(const Parameter& of) {
    const std::string value = shortest_number(of.value);
    return of.comment.ends_with(" default " + value) ? of.comment : of.comment + ", here " + value;
}

void rename_symbol(Graph& graph, const std::string& from, const std::string& to) {
    for (const auto& node : graph.nodes)
        if (node->kind == Node::Kind::symbol && node->text == from) node->text = to;
}

/// Parameters as uniforms of their names, those in `apart` behind the function's.
void make_uniforms(Graph& graph, const std::string& function, const std::set<std::string>& apart) {
    for (const Parameter& of : graph.parameters) {
        const std::string name = apart.count(of.name) != 0 ? function + "_" + of.name : of.name;
        if (name != of.name) rename_symbol(graph, of.name, name);
        graph.uniforms.push_back(
            {name, of.type == Type::integer ? "int" : "float", 0, comment_with_value(of)});
    }
    graph.parameters.clear();
}

/// What a function is to be.
struct Wanted {
    std::string name, prefix;         ///< prefix: of its helpers' names
    std::vector<std::string> inputs;  ///< in their order
    std::set<std::string> outputs;    ///< all if empty
};

struct Printed {
    std::string helpers, function;
    std::vector<Named> inputs;
};

/// Folds the recording and prints it. No name is one of `taken`.
Printed print_function(Graph& graph, const Wanted& wanted, std::vector<std::string> taken,
                       const Dialect& dialect) {
    Folder(graph).run();
    const Helpers helpers(graph, wanted.outputs, wanted.prefix);
    Printed printed;
    for (const auto& helper : helpers.all()) {
        const Locals locals(helper->graph, {});
        printed.helpers += Writer(helper->graph, locals, dialect).helper(*helper) + "\n";
        taken.push_back(helper->name);
    }
    const Locals locals(graph, wanted.outputs);
    Writer writer(graph, locals, dialect);
    printed.function = writer.function(wanted.name, wanted.inputs, taken);
    printed.inputs = writer.inputs();
    return printed;
}

/// Of what is computed at the vertices of the stage whose function has that name: what is `read`.
VertexFunction vertex_function(Graph& vertex, const std::string& stage, const std::string& prefix,
                               const std::set<std::string>& read, std::vector<std::string> taken,
                               const Dialect& dialect) {
    for (const std::string& name : transform_names()) taken.push_back(name);
    VertexFunction result;
    result.name = "vertex_" + stage;
    const Printed printed = print_function(
        vertex,
        {result.name,
         prefix + "_vertex",
         {vertex_attribute::position, vertex_attribute::normal, vertex_attribute::tangent,
          vertex_attribute::binormal, vertex_attribute::uv},
         read},
        taken, dialect);
    result.text = printed.helpers + printed.function;
    result.inputs = printed.inputs;
    result.outputs = vertex.outputs;
    result.uniforms = vertex.uniforms;
    for (const Named& of : result.outputs)
        result.varyings.push_back({prefix + "_" + of.name, of.type});
    return result;
}

}  // namespace

std::string as_word(const std::string& text) {
    std::string word;
    for (const char c : text) {
        const bool is_letter = std::isalnum(static_cast<unsigned char>(c)) != 0;
        if (is_letter || (!word.empty() && word.back() != '_')) word += is_letter ? c : '_';
    }
    return word;
}

FunctionText write_stage(const RecordedStage& stage, const ShaderScene& scene, const void* params,
                         const std::set<std::string>& outputs, const Dialect& dialect,
                         const std::string& suffix, ParametersAs parameters_as,
                         const std::set<std::string>& apart) {
    FunctionText result;
    result.name = function_name(*stage.text) + suffix;
    const NamedParameters parameters(stage, scene, params);
    Graph graph, vertex;
    parameters.record(graph);
    const std::string written_in = parameters.written_in(graph);
    if (parameters_as == ParametersAs::uniforms) make_uniforms(graph, result.name, apart);
    take_vertex_part(graph, vertex, parameters.names());
    std::set<std::string> varyings;
    for (const Named& of : vertex.outputs) varyings.insert(of.name);
    const std::string prefix = as_word(stage.text->id) + suffix;
    join_carried_vectors(graph, outputs);
    const Printed printed = print_function(graph, {result.name, prefix, stage.inputs(), outputs},
                                           parameters.names(), dialect);
    result.inputs = printed.inputs;
    result.outputs = graph.outputs;
    result.uniforms = graph.uniforms;
    result.parameters = graph.parameters;
    result.text = printed.helpers +
                  comment(std::string(stage.text->id) + ": " + stage.text->summary) +
                  comment(std::string("Source: ") + stage.text->source);
    if (!written_in.empty()) result.text += comment("Written for " + written_in + ".");
    result.text += printed.function;
    std::set<std::string> read;
    for (Named& input : result.inputs) {
        if (varyings.count(input.name) == 0) continue;
        read.insert(input.name);
        input.name = prefix + "_" + input.name;
    }
    if (read.empty()) return result;
    result.vertex = vertex_function(vertex, result.name, prefix, read, parameters.names(), dialect);
    result.vertex->text = comment(std::string(stage.text->id) +
                                  ", at the vertices: what its fragments read "
                                  "interpolated.") +
                          result.vertex->text;
    return result;
}

std::set<std::string> differing_uniforms(const std::vector<FunctionText>& functions) {
    std::map<std::string, Uniform> known;
    std::set<std::string> differing;
    const auto compare = [&](const std::vector<Uniform>& uniforms) {
        for (const Uniform& of : uniforms) {
            const Uniform& first = known.emplace(of.name, of).first->second;
            if (first.type != of.type || first.count != of.count || first.comment != of.comment)
                differing.insert(of.name);
        }
    };
    for (const FunctionText& function : functions) {
        compare(function.uniforms);
        if (function.vertex) compare(function.vertex->uniforms);
    }
    return differing;
}

std::vector<std::string> assumptions(const RecordedStage& stage, const FunctionText& function,
                                     const PlainScene& plain, int light) {
    const std::string room = stage.text->room;
    std::vector<std::string> all;
    if (room == "trace")
        all.push_back("For a relief whose seat is " + seat_text(plain.seat) +
                      ": uv is where the ray passes that height.");
    if (room == "trace" || room == "shadow" || room == "occlusion" || room == "surface")
        all.push_back("Where it goes by texels: maps of " + std::to_string(plain.side) + "^2, " +
                      wrap_text(plain) + " (--side, --wrap).");
    for (const TextureSlot slot : {TextureSlot::horizon, TextureSlot::horizon_sampled,
                                   TextureSlot::distance, TextureSlot::distance_exact})
        for (const Uniform& uniform : function.uniforms)
            if (uniform.name == map_name(slot))
                all.push_back("Written for a " + uniform.name +
                              " of one layer, and bakes have more: a scene that is exported as "
                              "a whole has the function for its own.");
    for (const TextureSlot slot : {TextureSlot::ddm, TextureSlot::gdm, TextureSlot::vdm})
        for (const Uniform& uniform : function.uniforms)
            if (uniform.name == map_name(slot)) {
                const TextureView table = plain_view(slot, plain.side);
                all.push_back(
                    "Written for a " + uniform.name + " of " +
                    size_text(table.width[1], table.height[1]) + " columns, " +
                    size_text(table.width[0] / table.width[1], table.height[0] / table.height[1]) +
                    " directions and " + std::to_string(table.faces) +
                    " slices, and bakes have others: a scene that is exported as a "
                    "whole has the function for its own.");
            }
    for (const Uniform& uniform : function.uniforms)
        if (uniform.name == "light0_position")
            all.emplace_back(
                "Light 0 is directional: light0_position is the direction to it. The others are "
                "points.");
    if (room == "shadow") all.push_back("Of light " + std::to_string(light) + " (--light).");
    return all;
}

void add_uniforms(std::vector<Uniform>& all, const std::vector<Uniform>& more) {
    for (const Uniform& uniform : more)
        if (std::none_of(all.begin(), all.end(),
                         [&](const Uniform& of) { return of.name == uniform.name; }))
            all.push_back(uniform);
}

std::string whole_file(const std::string& functions, const std::vector<Uniform>& uniforms,
                       const Dialect& dialect, const std::vector<std::string>& comments) {
    std::string file = dialect.first_lines(functions);
    std::set<std::string> said;
    for (const std::string& text : comments)
        if (said.insert(text).second) file += comment(text);
    const std::string text = transform_functions(functions, dialect) + functions;
    for (const std::string& part : {dialect.prelude(text), dialect.uniforms(uniforms, text), text})
        if (!part.empty()) file += (file.empty() || part[0] == '\n' ? "" : "\n") + part;
    return file;
}

}  // namespace quadrel::recorded
