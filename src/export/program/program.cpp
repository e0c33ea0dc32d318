#include "export/program/program.hpp"

#include <algorithm>
#include <initializer_list>
#include <map>
#include <set>

#include "export/print/wrapped_line.hpp"
#include "export/program/entry_point.hpp"
#include "export/program/matrices.hpp"
#include "export/program/stage_calls.hpp"
#include "export/program/targets.hpp"
#include "export/program/vertex_text.hpp"
#include "export/stages/plain_maps.hpp"

namespace quadrel::recorded {
namespace {

bool is_sampler(const Uniform& uniform) { return uniform.type.rfind("sampler", 0) == 0; }

/// Calls of the functions, one after the other, with a variable for each value: a local where
/// functions have outputs, else one of the whole shader.
class Statements {
  public:
    explicit Statements(const Dialect& dialect) : dialect_(dialect) {}

    void declare(const std::string& name, Type type, const std::string& value) {
        declared_[name] = type;
        all_.push_back(dialect_.has_outputs() ? dialect_.variable(type, name, value)
                                              : name + " = " + value + ";");
    }

    void call(const FunctionText& function) {
        if (dialect_.has_outputs())
            call_with_outputs(function);
        else
            call_for_result(function);
    }

    const std::vector<std::string>& all() const { return all_; }
    const ValueTypes& declared() const { return declared_; }

  private:
    static std::string arguments(std::initializer_list<const std::vector<Named>*> lists) {
        std::string text;
        for (const auto* list : lists)
            for (const Named& of : *list) text += (text.empty() ? "" : ", ") + of.name;
        return "(" + text + ")";
    }

    void call_with_outputs(const FunctionText& function) {
        std::map<Type, std::string> names;
        for (const Named& output : function.outputs)
            if (declared_.emplace(output.name, output.type).second)
                names[output.type] += (names[output.type].empty() ? "" : ", ") + output.name;
        for (const auto& [type, list] : names)
            all_.push_back(dialect_.type(type) + " " + list + ";");
        all_.push_back(function.name + arguments({&function.inputs, &function.outputs}) + ";");
    }

    void call_for_result(const FunctionText& function) {
        const std::string result = function.name + "_values";
        all_.push_back("let " + result + " = " + function.name + arguments({&function.inputs}) +
                       ";");
        for (const Named& output : function.outputs) {
            declared_.emplace(output.name, output.type);
            all_.push_back(output.name + " = " + result + "." + output.name + ";");
        }
    }

    const Dialect& dialect_;
    ValueTypes declared_;
    std::vector<std::string> all_;
};

/// Values that no stage gives, but for varyings: axes of objects, the rasterizer's, and what reads
/// as 0.
void declare_open(const ValueTypes& open, FragmentText& text, Statements& statements,
                  const Dialect& dialect, const EntryPoint& entry) {
    const auto is_varying = [&](const std::string& name) {
        return std::any_of(text.varyings.begin(), text.varyings.end(),
                           [&](const Varying& of) { return of.name == name; });
    };
    for (const auto& [name, type] : open) {
        if (is_varying(name)) continue;
        if (name == "bary") throw RecordingError("bary: barycentrics are not handed to fragments");
        if (name.rfind("object_", 0) == 0) {
            add_uniforms(text.uniforms, {normal_matrix});
            statements.declare(name, type, object_axis(name.back() - 'x', dialect));
        } else if (name == "frag_coord") {
            statements.declare(name, type, entry.frag_coord());
        } else if (name == "front_facing") {
            text.asks_front_facing = true;
            statements.declare(name, type, dialect.choice(entry.front_facing(), "1.0", "-1.0"));
        } else if (type == Type::integer) {
            statements.declare(name, type, "0");
        } else if (type == Type::real) {
            statements.declare(name, type, "0.0");
        } else {
            std::string zeros = "0.0";
            for (int i = 1; i < components_of(type); ++i) zeros += ", 0.0";
            statements.declare(name, type, dialect.type(type) + "(" + zeros + ")");
        }
    }
}

std::string map_with_lod(const ProgramRequest& request) {
    for (const TextureSlot slot : {TextureSlot::height, TextureSlot::color})
        if (request.textures[static_cast<int>(slot)] != nullptr) return map_name(slot);
    throw RecordingError("lod: the material has neither a height map nor a colour map");
}

std::string comment_of(const ProgramRequest& request, const char* what) {
    return wrapped_line(std::string("// Material ") + as_word(request.material) + ": " + what) +
           "\n";
}

/// What is open and the rasterizer gives, and then what vertex programs hand on.
std::vector<Varying> varyings_of(const StageCalls& calls) {
    std::vector<Varying> varyings;
    for (const auto& [name, type] : calls.open())
        if (const Varying* const varying = find_varying(name)) varyings.push_back(*varying);
    for (const FunctionText& function : calls.functions())
        if (function.vertex)
            for (const Named& of : function.vertex->varyings)
                varyings.push_back(varying_of_program(of));
    return varyings;
}

FragmentText fragment_text(const ProgramRequest& request, const StageCalls& calls,
                           const Dialect& dialect, const EntryPoint& entry) {
    FragmentText text;
    text.varyings = varyings_of(calls);
    text.comment =
        comment_of(request, "what is visible, shaded. PASS says which values go to the targets.");
    text.centroid = request.centroid != 0;
    text.uniforms = calls.uniforms();
    Statements statements(dialect);
    declare_open(calls.open(), text, statements, dialect, entry);
    for (const FunctionText& function : calls.functions()) {
        text.functions += function.text + "\n";
        statements.call(function);
    }
    text.statements = statements.all();
    for (const auto& [name, type] : statements.declared()) text.values.push_back({name, type});
    text.passes = targets_of(request, dialect);
    if (request.writes_depth != 0) text.depth = "frag_depth";
    text.discard = discard_condition(request, dialect);
    if (asks_lod(request)) {
        text.lod_map = map_with_lod(request);
        add_uniforms(text.uniforms, {{text.lod_map, "sampler2D", 0}});
    }
    return text;
}

}  // namespace

int slot_of_map(const std::string& name) {
    for (int i = 0; i < texture_slot_count; ++i) {
        const std::string map = map_name(static_cast<TextureSlot>(i));
        if (name == map || name == map + "_nearest") return i;
    }
    return -1;
}

ProgramText compose_program(const ProgramRequest& request) {
    const auto dialect = find_dialect(request.language);
    const auto entry = dialect ? find_entry_point(request.language, *dialect) : nullptr;
    if (entry == nullptr)
        throw RecordingError(std::string("no scenes are written in ") + request.language);
    if (asks_lod(request) && !entry->has_lod())
        throw RecordingError(std::string("lod: a shader cannot ask for it in ") + request.language);
    ShaderScene scene = scene_of(request);
    const StageCalls calls(request.stages, request.stage_count, scene, wanted_values(request),
                           *dialect);
    FragmentText fragment = fragment_text(request, calls, *dialect, *entry);
    VertexText vertex = vertex_text(request, fragment.varyings, calls, *dialect);
    vertex.comment = comment_of(
        request,
        request.draws_shells != 0
            ? "vertices of its shell, as Quadrel has them."
            : "vertices to eye space and clip space, as Quadrel has them; by the matrices, which "
              "are by rows, where SHADED_VERTICES is 0.");
    vertex.centroid = fragment.centroid;
    vertex.fragment_functions = fragment.functions;
    fragment.varyings = vertex.varyings;  // structs of both are one
    std::vector<Uniform> all = vertex.uniforms;
    add_uniforms(all, fragment.uniforms);
    ProgramText text{"", "", vertex.attributes, {}, {}};
    for (const Uniform& uniform : all)
        (is_sampler(uniform) ? text.samplers : text.numbers).push_back(uniform);
    if (entry->has_one_struct()) {
        vertex.uniforms = text.numbers;
        fragment.uniforms = all;
    }
    text.vertex = entry->vertex(vertex);
    text.fragment = entry->fragment(fragment);
    return text;
}

}  // namespace quadrel::recorded
