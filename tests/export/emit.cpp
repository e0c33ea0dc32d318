// Writes all stages that can be exported for the tests, as C++ and in each language as one shader:
//
//     quadrel-emit-functions OUTPUT.cpp FOLDER
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <ostream>

#include "export/exported.hpp"
#include "export/stages/plain_scene.hpp"
#include "export/stages/stage_text.hpp"

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
    return {};
}

std::string loaded(const Named& input) {
    const Place place = place_of(input.name);
    if (place.is_integer) return "load_int(arrays, " + std::to_string(place.slot) + ")";
    return "load<" + std::to_string(place.components) + ">(arrays, " + std::to_string(place.slot) +
           ")";
}

void write_function(std::ostream& out, const FunctionText& function, const Dialect& dialect) {
    out << function.text << "void run_" << function.name << "(const FragmentArrays& arrays) {\n";
    std::string arguments;
    for (const Named& input : function.inputs)
        arguments += (arguments.empty() ? "" : ", ") + loaded(input);
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
    for (const char* word : {"dFdx(", "dFdy(", " texture(", "(texture("})
        if (text.find(word) != std::string::npos) return true;
    return false;
}

/// The row of a table.
std::string row_of(const FunctionText& function, const char* id) {
    return std::string("{\"") + id + "\", " + (uses_neighbours(function.text) ? "true" : "false") +
           ", glsl::run_" + function.name + "}";
}

/// An error of a printer: what it writes in the place of what is right.
struct Planted {
    const char *id, *right, *wrong, *what;
};
constexpr Planted all_planted[] = {
    {"linear", "h >= 1.0f - s", "h > 1.0f - s", "another comparison"},
    {"linear", "uv + K * s", "uv - K * s", "the other direction"},
    {"linear", "i <= steps", "i < steps", "one step less"},
    {"linear", "if (isnan(h)) met_nan = true;", "", "an assignment lost"},
    {"steep", "1.0f - ", "1.0f + ", "another operator"},
    {"max-mip", ": INFINITY;", ": -INFINITY;", "an infinity of the other sign"},
    {"max-mip", "<< level", ">> level", "the other shift"},
    {"relief-binary", "break;", ";", "a way out lost"},
    {"frame-gram", "cross(py, n)", "cross(n, py)", "swapped operands"},
    {"shade-lambert", "0.0f + light0_diffuse", "light0_diffuse", "0 + x taken for x"}};

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

    void emit(const RecordedStage& stage) {
        try {
            const FunctionText function = write_stage(stage, scene_, nullptr, {}, dialect_);
            write_function(out_, function, dialect_);
            rows_ += "    " + row_of(function, stage.text->id) + ",\n";
        } catch (const RecordingError& error) {
            reasons_ +=
                std::string("    {\"") + stage.text->id + "\", \"" + error.what() + "\"},\n";
        }
    }

    void plant(const Planted& planted) {
        const RecordedStage& stage = *find_recorded_stage(planted.id);
        FunctionText function = write_stage(stage, scene_, nullptr, {}, dialect_);
        function.text = with_error(function.text, planted);
        if (function.text.empty())
            throw RecordingError(std::string(planted.id) + " has no " + planted.right);
        const std::string name = function.name + "_planted" + std::to_string(planted_++);
        for (std::size_t at = function.text.find(function.name + "("); at != std::string::npos;
             at = function.text.find(function.name + "(", at + name.size()))
            function.text.replace(at, function.name.size(), name);
        function.name = name;
        write_function(out_, function, dialect_);
        planted_rows_ += "    {" + row_of(function, planted.id) + ", \"" + planted.what + "\"},\n";
    }

    void finish() {
        out_ << "}  // namespace quadrel::glsl\n\nnamespace quadrel::export_tests {\n";
        table("ExportedFunction", "exported_functions", "exported_count", rows_);
        table("PlantedFunction", "planted_functions", "planted_count", planted_rows_);
        table("NotExported", "not_exported", "not_exported_count", reasons_);
        out_ << "}\n";
    }

  private:
    void table(const char* type, const char* name, const char* count, const std::string& rows) {
        out_ << "const " << type << " " << name << "[] = {\n"
             << rows << "};\nconst int " << count << " = "
             << std::count(rows.begin(), rows.end(), '\n') << ";\n";
    }

    std::ostream& out_;
    const Dialect& dialect_;
    ShaderScene scene_;
    std::string rows_, planted_rows_, reasons_;
    int planted_ = 0;
};

void write_all(std::ostream& out) {
    const auto dialect = find_dialect("c++");
    Emitter emitter(out, *dialect);
    for (const RecordedStage& stage : all_recorded_stages()) emitter.emit(stage);
    for (const Planted& planted : all_planted) emitter.plant(planted);
    emitter.finish();
}

/// All functions in one file, which a compiler of that language takes.
void write_shader(std::ostream& out, const char* language, const char* main) {
    const auto dialect = find_dialect(language);
    const ShaderScene scene = plain_scene({exported_side, exported_lights});
    FunctionText all;
    for (const RecordedStage& stage : all_recorded_stages()) {
        try {
            const FunctionText function = write_stage(stage, scene, nullptr, {}, *dialect);
            all.text += function.text + "\n";
            add_uniforms(all.uniforms, function.uniforms);
        } catch (const RecordingError&) {  // the other program's table has it
        }
    }
    out << whole_file(all.text, all.uniforms, *dialect) << main;
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
            hlsl(folder + "/all.hlsl.frag");
        write_shader(glsl, "glsl", "void main() {}\n");
        write_shader(es, "glsl-es", "void main() {}\n");
        write_shader(hlsl, "hlsl", "float4 main() : SV_Target { return float4(0, 0, 0, 0); }\n");
        if (!glsl.flush() || !es.flush() || !hlsl.flush()) return 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    out.close();
    return out ? 0 : 1;
}
