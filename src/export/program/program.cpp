#include "export/program/program.hpp"

#include <initializer_list>
#include <map>
#include <set>

#include "export/print/wrapped_line.hpp"
#include "export/program/entry_point.hpp"
#include "export/program/matrices.hpp"
#include "export/program/stage_calls.hpp"
#include "export/program/targets.hpp"
#include "export/stages/plain_maps.hpp"

namespace quadrel::recorded {
namespace {

const Uniform flat_faces{"flat_faces", "float", 0};

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
    for (const auto& [name, type] : open) {
        if (find_varying(name) != nullptr) continue;
        if (name == "bary") throw RecordingError("bary: barycentrics are not handed to fragments");
        if (name.rfind("object_", 0) == 0) {
            add_uniforms(text.uniforms, {normal_matrix});
            statements.declare(name, type, object_axis(name.back() - 'x', dialect));
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

void bind_textures(const ProgramRequest& request, ShaderScene& scene) {
    for (int i = 0; i < texture_slot_count; ++i)
        if (const SampledTexture* const texture = request.textures[i])
            scene.textures.bind(i, map_name(static_cast<TextureSlot>(i)), texture->view,
                                texture->sampler);
}

FragmentText fragment_text(const ProgramRequest& request, const Dialect& dialect,
                           const EntryPoint& entry) {
    ShaderScene scene(*request.frame);
    scene.material = *request.uniforms;
    bind_textures(request, scene);
    const StageCalls calls(request.stages, request.stage_count, scene, wanted_values(request),
                           dialect);
    FragmentText text;
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
    for (const auto& [name, type] : calls.open())
        if (const Varying* const varying = find_varying(name)) text.varyings.push_back(*varying);
    text.passes = targets_of(request, dialect);
    if (request.writes_depth != 0) text.depth = "frag_depth";
    text.discard = discard_condition(request, dialect);
    if (asks_lod(request)) {
        text.lod_map = map_with_lod(request);
        add_uniforms(text.uniforms, {{text.lod_map, "sampler2D", 0}});
    }
    return text;
}

/// A shell's vertices are none of the mesh's: they are in eye space and in clip space as they come.
void take_shaded_vertices(const ProgramRequest& request, VertexText& text) {
    text.comment = comment_of(request, "vertices of its shell, as Quadrel has them.");
    std::set<std::string> read = {"clip_position"};
    for (const Varying& varying : text.varyings) {
        text.values.push_back({varying.shaded, varying.shaded});
        read.insert(varying.shaded);
    }
    text.position = {"clip_position", "clip_position"};
    for (const Named& attribute : vertex_attributes())
        if (read.count(attribute.name) != 0) text.attributes.push_back(attribute);
}

VertexText vertex_text(const ProgramRequest& request, const FragmentText& fragment,
                       const Dialect& dialect) {
    VertexText text;
    text.comment = comment_of(
        request,
        "vertices to eye space and clip space, as Quadrel has them; by the matrices, which "
        "are by rows, where SHADED_VERTICES is 0.");
    text.centroid = fragment.centroid;
    // The position in eye space is a varying in any case: it is what clip space is made of.
    text.varyings = fragment.varyings;
    std::erase_if(text.varyings, [](const Varying& of) { return of.name == std::string("P"); });
    text.varyings.insert(text.varyings.begin(), *find_varying("P"));
    if (request.draws_shells != 0) {
        take_shaded_vertices(request, text);
        return text;
    }
    text.functions = row_functions(dialect);
    text.uniforms = {model_view, projection};
    std::set<std::string> read;
    for (const Varying& varying : text.varyings) {
        const std::string name = varying.name;
        read.insert({varying.attribute, varying.shaded});
        std::string value = varying.attribute;
        if (name == "P") {
            value = rows_times(model_view, Type::vec3, value, dialect);
        } else if (name == "uv") {
            text.uniforms.push_back(texture_matrix);
            value = rows_times(texture_matrix, Type::vec2,
                               dialect.type(Type::vec3) + "(" + value + ", 0.0)", dialect);
        } else if (name == "vertex_normal") {
            text.uniforms.push_back(normal_matrix);
            value = normal_times(dialect);
            if (request.has_flat_meshes != 0) {
                text.uniforms.push_back(flat_faces);
                read.insert("face_normal");
                value = dialect.choice(dialect.use_of(flat_faces, flat_faces.name) + " != 0.0",
                                       "face_normal", value);
            }
        }
        text.values.push_back({value, varying.shaded});
    }
    read.insert("clip_position");
    for (const Named& attribute : vertex_attributes())
        if (read.count(attribute.name) != 0) text.attributes.push_back(attribute);
    text.position = {rows_times(projection, Type::vec4, "P", dialect), "clip_position"};
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
    FragmentText fragment = fragment_text(request, *dialect, *entry);
    VertexText vertex = vertex_text(request, fragment, *dialect);
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
