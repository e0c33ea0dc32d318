// Writes all stages that can be exported for the tests, as C++, in each language as one shader, and
// as a shader each in WGSL:
//
//     quadrel-emit-functions OUTPUT.cpp FOLDER
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <ostream>

#include "export/exported.hpp"
#include "export/shell_inputs.hpp"
#include "export/stages/plain_scene.hpp"
#include "export/stages/stage_text.hpp"
#include "export/stages/vertex_transforms.hpp"

namespace quadrel::export_tests {
namespace {

using namespace recorded;

/// Where a parameter of a function lies: the first slot of its value, and how many.
struct Place {
    int slot = -1, components = 0;
    bool is_integer = false;
};

Place place_of(const std::string& name) {
    for (int v = 0; v < static_cast<int>(Value::count); ++v) {
        const auto value = static_cast<Value>(v);
        const int n = info(value).components;
        for (int light = 0; light < (info(value).per_light ? max_lights : 1); ++light) {
            const int slot = slot_of(value) + light * n;
            const bool is_integer = info(value).kind == ValueKind::integer;
            if (n != 6 && name == shader_name(value, light)) return {slot, n, is_integer};
            if (n == 6 && name == shader_name(value, light, "_u")) return {slot, 3, false};
            if (n == 6 && name == shader_name(value, light, "_v")) return {slot + 3, 3, false};
        }
    }
    if (const std::size_t input = shell_input(name); input < std::size(shell_inputs))
        return {shell_slot(input), shell_inputs[input].components, false};
    return {};
}

/// Where the floats of a stage's varyings begin; the last is their number.
std::vector<int> varying_places(const VertexFunction& vertex) {
    std::vector<int> places{0};
    for (const Named& of : vertex.varyings)
        places.push_back(places.back() + components_of(of.type));
    if (places.back() > most_varying_floats)
        throw std::runtime_error(vertex.name + " has more varyings than the tests");
    return places;
}

std::string vector_at(Type type, const std::string& from) {
    return "vector_at<" + std::to_string(components_of(type)) + ">(" + from + ")";
}

std::string loaded(const Named& input, const FunctionText& function) {
    if (input.name == "frag_coord") return "frag_coord(arrays)";
    for (std::size_t i = 0; function.vertex && i < function.vertex->varyings.size(); ++i)
        if (function.vertex->varyings[i].name == input.name)
            return vector_at(input.type, "arrays.varyings + " +
                                             std::to_string(varying_places(*function.vertex)[i]));
    const Place place = place_of(input.name);
    if (place.is_integer) return "load_int(arrays, " + std::to_string(place.slot) + ")";
    return "load<" + std::to_string(place.components) + ">(arrays, " + std::to_string(place.slot) +
           ")";
}

void write_vertex_function(std::ostream& out, const VertexFunction& vertex,
                           const Dialect& dialect) {
    out << vertex.text << "void run_" << vertex.name << "(const VertexArrays& arrays) {\n";
    std::string arguments, puts;
    for (const Named& input : vertex.inputs)
        arguments +=
            (arguments.empty() ? "" : ", ") + vector_at(input.type, "arrays." + input.name);
    const std::vector<int> places = varying_places(vertex);
    for (std::size_t i = 0; i < vertex.outputs.size(); ++i) {
        const Named& output = vertex.outputs[i];
        out << "    " << dialect.type(output.type) << " " << output.name << ";\n";
        arguments += ", " + output.name;
        puts +=
            "    put(arrays.varyings + " + std::to_string(places[i]) + ", " + output.name + ");\n";
    }
    out << "    " << vertex.name << "(" << arguments << ");\n" << puts << "}\n\n";
}

void write_function(std::ostream& out, const FunctionText& function, const Dialect& dialect) {
    if (function.vertex) write_vertex_function(out, *function.vertex, dialect);
    out << function.text << "void run_" << function.name << "(const FragmentArrays& arrays) {\n";
    std::string arguments;
    for (const Named& input : function.inputs)
        arguments += (arguments.empty() ? "" : ", ") + loaded(input, function);
    std::string stores;
    for (const Named& output : function.outputs) {
        out << "    " << dialect.type(output.type) << " " << output.name << ";\n";
        arguments += (arguments.empty() ? "" : ", ") + output.name;
        stores += "    store(arrays, " + std::to_string(place_of(output.name).slot) + ", " +
                  output.name + ");\n";
    }
    out << "    " << function.name << "(" << arguments << ");\n" << stores << "}\n\n";
}

/// Whether it has derivatives, of its own or of a look-up.
bool uses_neighbours(const std::string& text) {
    for (const char* word : {"dFdx(", "dFdy(", "dFdxFine(", " texture(", "(texture("})
        if (text.find(word) != std::string::npos) return true;
    return false;
}

/// Whether neighbours may have gone another way, or have left a loop.
bool has_branches(const std::string& text) {
    return text.find("for (") != std::string::npos || text.find("if (") != std::string::npos;
}

/// The row of a table.
std::string row_of(const FunctionText& function, const char* id, const std::string& space = "") {
    const auto word = [](bool of) { return of ? "true, " : "false, "; };
    const std::string vertex = function.vertex
                                   ? std::to_string(varying_places(*function.vertex).back()) +
                                         ", glsl::" + space + "run_" + function.vertex->name
                                   : "0, nullptr";
    return std::string("{\"") + id + "\", " + word(uses_neighbours(function.text)) +
           word(has_branches(function.text)) + "glsl::" + space + "run_" + function.name + ", " +
           vertex + "}";
}

/// An error of a printer: what it writes in the place of what is right.
struct Planted {
    const char *id, *right, *wrong, *what;
};
constexpr Planted all_planted[] = {
    {"linear", "result_h >= 1.0f - s", "result_h > 1.0f - s", "another comparison"},
    {"linear", "uv + K * s", "uv - K * s", "the other direction"},
    {"linear", "i <= steps", "i < steps", "one step less"},
    {"linear", "if (isnan(result_h)) met_nan = true;", "", "an assignment lost"},
    {"steep", "1.0f - ", "1.0f + ", "another operator"},
    {"max-mip", ": INFINITY;\n}", ": -INFINITY;\n}", "an infinity of the other sign"},
    {"max-mip", "<< level", ">> level", "the other shift"},
    {"relief-binary", "break;", ";", "a way out lost"},
    {"frame-gram", "cross(py, n)", "cross(n, py)", "swapped operands"},
    {"ddm", "s) * 4.0f) - 1.0f", "s) * 4.0f)", "the next slice of a table"},
    {"vdm", "table_y, first", "table_x, first", "another row of a table"},
    {"normal-mcguire@published", "dFdyFine", "dFdxFine", "another neighbour"},
    {"normal-mcguire@published", "frag_coord.x", "frag_coord.y", "another column of the quad"},
    {"prism-pom", "& 127", "& 63", "another row of a shell"},
    {"prism-exact", "column + 5", "column + 4", "another texel of the row"},
    {"frame-prism", "corner_weights.y", "corner_weights.x", "another varying"},
    {"prism-gs@published", "front_facing", "-front_facing", "the other side"},
    {"shadow-shell", ">> 2", ">> 3", "another neighbour"},
    {"shade-lambert", "light_specular = vec3(0.0f)", "light_specular = vec3(-0.0f)",
     "a zero of the other sign"},
    // At the vertices.
    {"frame-vertex@published", "target_ - position", "position - target_", "the other way"},
    {"frame-vertex@published", "model_view[1]", "model_view[4]", "a transposed matrix"},
    {"curved-quadric@published", "inverse_model_view[3]", "inverse_model_view[12]",
     "another translation"},
    {"normal-map-flightgear@published", "inverse_model_view[4]", "inverse_model_view[1]",
     "a normal as a vector"},
    {"learnopengl", "dot(B, FragPos)", "dot(T, FragPos)", "another axis"}};

/// `text` with the first `right` as `wrong`; empty where it has none.
std::string with_error(const std::string& text, const Planted& planted) {
    const std::size_t at = text.find(planted.right, text.find("{\n"));
    if (at == std::string::npos) return "";
    std::string result = text;
    return result.replace(at, std::string(planted.right).size(), planted.wrong);
}

/// Functions, the table of them, and the reasons why others are none.
class Emitter {
  public:
    Emitter(std::ostream& out, const Dialect& dialect)
        : out_(out), dialect_(dialect), scene_(plain_scene({exported_side, exported_lights})) {}

    /// What functions of vertices call.
    void emit_transforms() {
        std::string all;
        for (const std::string& name : transform_names()) all += name + "(";
        out_ << transform_functions(all, dialect_);
    }

    void emit(const RecordedStage& stage) {
        const FunctionText function = write_stage(stage, scene_, nullptr, {}, dialect_);
        write_function(out_, function, dialect_);
        rows_ += "    " + row_of(function, stage.text->id) + ",\n";
    }

    void plant(const Planted& planted) {
        const RecordedStage& stage = *find_recorded_stage(planted.id);
        FunctionText function = write_stage(stage, scene_, nullptr, {}, dialect_);
        std::string& text = function.vertex ? function.vertex->text : function.text;
        if (function.vertex) text = transform_functions(text, dialect_) + text;
        text = with_error(text, planted);
        if (text.empty())
            throw RecordingError(std::string(planted.id) + " has no " + planted.right);
        const std::string space = "planted" + std::to_string(planted_++);
        out_ << "namespace " << space << " {\n";
        write_function(out_, function, dialect_);
        out_ << "}\n";
        planted_rows_ +=
            "    {" + row_of(function, planted.id, space + "::") + ", \"" + planted.what + "\"},\n";
    }

    /// The function with other numbers in the places of its constants.
    void edit(const RecordedStage& stage) {
        FunctionText function = write_stage(stage, scene_, nullptr, {}, dialect_);
        std::string values;
        int count = 0;
        for (const Parameter& constant : function.parameters) {
            const ParameterText& parameter = parameter_of(stage, constant);
            const double value = other_value(constant, parameter);
            put(function.text, constant, value);
            char number[64];
            std::snprintf(number, sizeof number, "%a", value);
            values += "{\"" + std::string(parameter.name) + "\", " + number + "}, ";
            ++count;
        }
        if (count == 0) return;
        const std::string space = "edited" + std::to_string(edited_++);
        out_ << "namespace " << space << " {\n"
             << "const EditedParameter parameters[] = {" << values << "};\n";
        write_function(out_, function, dialect_);
        out_ << "}\n";
        edited_rows_ += "    {" + row_of(function, stage.text->id, space + "::") +
                        ", glsl::" + space + "::parameters, " + std::to_string(count) + "},\n";
    }

    void finish() {
        out_ << "}  // namespace quadrel::glsl\n\nnamespace quadrel::export_tests {\n";
        table("ExportedFunction", "exported_functions", "exported_count", rows_);
        table("PlantedFunction", "planted_functions", "planted_count", planted_rows_);
        table("EditedFunction", "edited_functions", "edited_count", edited_rows_);
        out_ << "}\n";
    }

  private:
    static const ParameterText& parameter_of(const RecordedStage& stage, const Parameter& of) {
        for (int i = 0; i < stage.parameter_count; ++i) {
            const std::string name = as_word(stage.parameters[i].name);
            if (of.name == name || of.name == name + "_") return stage.parameters[i];
        }
        throw RecordingError(of.name + " is no parameter");
    }
    static double other_value(const Parameter& of, const ParameterText& parameter) {
        if (of.type == Type::integer) return std::min(of.value + 3, parameter.maximum);
        return static_cast<float>(of.value + 0.125 * (std::min(parameter.maximum, 8.0) - of.value));
    }
    /// Changes the constant in a text.
    void put(std::string& text, const Parameter& of, double value) const {
        const auto constant = [&](double number) {
            return dialect_.parameter(of.type, of.name,
                                      of.type == Type::integer
                                          ? std::to_string(static_cast<int>(number))
                                          : dialect_.real(static_cast<float>(number)));
        };
        const std::size_t at = text.find(constant(of.value));
        if (at == std::string::npos) throw RecordingError(of.name + " is no constant");
        text.replace(at, constant(of.value).size(), constant(value));
    }

    void table(const char* type, const char* name, const char* count, const std::string& rows) {
        out_ << "const " << type << " " << name << "[] = {\n"
             << rows << "};\nconst int " << count << " = "
             << std::count(rows.begin(), rows.end(), '\n') << ";\n";
    }

    std::ostream& out_;
    const Dialect& dialect_;
    ShaderScene scene_;
    std::string rows_, planted_rows_, edited_rows_;
    int planted_ = 0, edited_ = 0;
};

void write_all(std::ostream& out) {
    const auto dialect = find_dialect("c++");
    Emitter emitter(out, *dialect);
    emitter.emit_transforms();
    for (const RecordedStage& stage : all_recorded_stages()) emitter.emit(stage);
    for (const Planted& planted : all_planted) emitter.plant(planted);
    for (const RecordedStage& stage : all_recorded_stages())
        if (stage.parameter_count > 0) emitter.edit(stage);
    emitter.finish();
}

/// All functions in one file, which a compiler of that language takes.
void write_shader(std::ostream& out, const char* language, const char* main,
                  ParametersAs parameters = ParametersAs::constants) {
    const auto dialect = find_dialect(language);
    const ShaderScene scene = plain_scene({exported_side, exported_lights});
    FunctionText all;
    for (const RecordedStage& stage : all_recorded_stages()) {
        const FunctionText function =
            write_stage(stage, scene, nullptr, {}, *dialect, "", parameters);
        if (function.vertex) {
            all.text += function.vertex->text + "\n";
            add_uniforms(all.uniforms, function.vertex->uniforms);
        }
        all.text += function.text + "\n";
        add_uniforms(all.uniforms, function.uniforms);
    }
    out << whole_file(all.text, all.uniforms, *dialect) << main;
}

/// A file each, behind a line with its stage's name. Odd ones have uniforms for parameters.
void write_each(std::ostream& out, const char* language) {
    const auto dialect = find_dialect(language);
    const ShaderScene scene = plain_scene({exported_side, exported_lights});
    int number = 0;
    for (const RecordedStage& stage : all_recorded_stages()) {
        const FunctionText function =
            write_stage(stage, scene, nullptr, {}, *dialect, "",
                        number++ % 2 == 0 ? ParametersAs::constants : ParametersAs::uniforms);
        std::vector<Uniform> uniforms = function.uniforms;
        std::string text = function.text;
        if (function.vertex) {
            add_uniforms(uniforms, function.vertex->uniforms);
            text = function.vertex->text + "\n" + text;
        }
        out << "=== " << stage.text->id << "\n" << whole_file(text, uniforms, *dialect);
    }
}

}  // namespace
}  // namespace quadrel::export_tests

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    using namespace quadrel::export_tests;
    const std::string folder = argv[2];
    std::ofstream out(argv[1]);
    out << "#include \"export/fragment_arrays.hpp\"\n#include \"export/glsl.hpp\"\n\n"
        << "namespace quadrel::glsl {\n\nusing namespace export_tests;\n\n";
    try {
        write_all(out);
        std::ofstream glsl(folder + "/all.glsl.frag"), es(folder + "/all.es.frag"),
            hlsl(folder + "/all.hlsl.frag"), uniforms(folder + "/all.uniforms.frag"),
            wgsl(folder + "/each.wgsl");
        write_shader(glsl, "glsl", "void main() {}\n");
        write_shader(es, "glsl-es", "void main() {}\n");
        write_shader(hlsl, "hlsl", "float4 main() : SV_Target { return float4(0, 0, 0, 0); }\n");
        write_shader(uniforms, "glsl", "void main() {}\n", ParametersAs::uniforms);
        write_each(wgsl, "wgsl");
        for (std::ofstream* of : {&glsl, &es, &hlsl, &uniforms, &wgsl})
            if (!of->flush()) return 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    out.close();
    return out ? 0 : 1;
}
