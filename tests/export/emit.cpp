// Writes all stages that can be exported as C++, for the tests: emit OUTPUT.
#include <cstdio>
#include <fstream>
#include <sstream>

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

void write_all(std::ostream& out) {
    const auto dialect = find_dialect("c++");
    ShaderScene scene = plain_scene(exported_side, exported_lights);
    std::ostringstream rows, reasons;
    int functions = 0, refused = 0;
    for (const RecordedStage& stage : all_recorded_stages()) {
        try {
            const FunctionText function = write_stage(stage, scene, nullptr, {}, *dialect);
            write_function(out, function, *dialect);
            rows << "    {\"" << stage.text->id << "\", "
                 << (uses_neighbours(function.text) ? "true" : "false") << ", glsl::run_"
                 << function.name << "},\n";
            ++functions;
        } catch (const RecordingError& error) {
            reasons << "    {\"" << stage.text->id << "\", \"" << error.what() << "\"},\n";
            ++refused;
        }
    }
    out << "}  // namespace quadrel::glsl\n\nnamespace quadrel::export_tests {\n"
        << "const ExportedFunction exported_functions[] = {\n"
        << rows.str() << "};\nconst int exported_count = " << functions
        << ";\nconst NotExported not_exported[] = {\n"
        << reasons.str() << "};\nconst int not_exported_count = " << refused << ";\n}\n";
}

}  // namespace
}  // namespace quadrel::export_tests

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    std::ofstream out(argv[1]);
    out << "#include \"export/fragment_arrays.hpp\"\n#include \"export/glsl.hpp\"\n\n"
        << "namespace quadrel::glsl {\n\nusing namespace export_tests;\n\n";
    quadrel::export_tests::write_all(out);
    out.close();
    if (out) return 0;
    std::fprintf(stderr, "cannot write %s\n", argv[1]);
    return 1;
}
