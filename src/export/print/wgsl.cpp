#include "export/print/wgsl.hpp"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "export/print/expressions.hpp"
#include "export/print/wrapped_line.hpp"

namespace quadrel::recorded {
namespace {

using Kind = Node::Kind;

bool is_map(const Uniform& uniform) { return uniform.type.rfind("sampler", 0) == 0; }

bool is_bitwise(const Node& node) {
    return node.text == "&" || node.text == "|" || node.text == "^";
}
bool is_shift(const Node& node) { return node.text == "<<" || node.text == ">>"; }
bool is_logical(const Node& node) { return node.text == "&&" || node.text == "||"; }

/// What functions of GLSL are called here.
std::string function_of(const Node& node) {
    static constexpr std::pair<const char*, const char*> others[] = {
        {"inversesqrt", "inverseSqrt"},
        {"dFdx", "dpdx"},
        {"dFdy", "dpdy"},
        {"dFdxFine", "dpdxFine"},
        {"dFdyFine", "dpdyFine"},
        {"roundEven", "round"},
        {"floatBitsToInt", "bitcast<i32>"},
        {"intBitsToFloat", "bitcast<f32>"},
        {"float", "f32"},
        {"int", "i32"},
        {"textureLod", "textureSampleLevel"},
        {"textureLayer", "textureSampleLevel"},
        {"textureGrad", "textureSampleGrad"}};
    if (node.text == "atan" && node.arguments.size() == 2) return "atan2";
    if (node.text == "texture")
        return node.arguments.size() > 2 ? "textureSampleBias" : "textureSample";
    for (const auto& [name, other] : others)
        if (node.text == name) return other;
    return node.text;
}

/// "trace_linear" as the name of a type.
std::string type_name(const std::string& function) {
    std::string name;
    bool begins = true;
    for (const char c : function) {
        if (c != '_')
            name += begins ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
        begins = c == '_';
    }
    return name;
}

}  // namespace

std::string WgslDialect::type(Type type) const {
    static const char* const names[] = {"f32", "i32", "bool", "vec2f", "vec3f", "vec4f"};
    return names[static_cast<int>(type)];
}

/// No constant expression may be infinite or NaN, and none be rounded to the largest number.
std::string WgslDialect::real(float value) const {
    if (std::isnan(value)) return "nan()";
    if (std::isinf(value)) return value < 0 ? "-infinity()" : "infinity()";
    if (std::fabs(value) == std::numeric_limits<float>::max())
        return value < 0 ? "-0x1.fffffep+127f" : "0x1.fffffep+127f";
    return shortest(value);
}

std::string WgslDialect::call(const Node& node, const std::vector<std::string>& arguments) const {
    const std::string function = function_of(node);
    const std::string& map = arguments[0];
    if (node.text == "texelFetch")
        return "textureLoad(" + map + ", vec2i(" + arguments[1] + ", " + arguments[2] + "), " +
               arguments[3] + ")";
    if (node.text == "texelLayer")
        return "textureLoad(" + map + ", vec2i(" + arguments[1] + ", " + arguments[2] + "), " +
               arguments[3] + ", " + arguments[4] + ")";
    if (node.text == "textureSize")
        return "i32(textureDimensions(" + map + ", " + arguments[1] + ")" +
               (arguments[2] == "0" ? ".x)" : ".y)");
    if (node.text == "textureGather")
        return "textureGather(" + arguments[2] + ", " + map + ", " + map + "_sampler, " +
               arguments[1] + ")";
    std::vector<std::string> all = arguments;
    if (node.text.rfind("texture", 0) == 0) {
        all.insert(all.begin() + 1, map + "_sampler");
        return function + "(" + join(all) + ")";
    }
    const bool is_mod = node.text == "mod";
    if (node.text == "min" || node.text == "max" || is_mod)
        for (std::size_t i = 0; i < all.size(); ++i)  // all components by one number
            if (node.arguments[i]->type != node.type) all[i] = type(node.type) + "(" + all[i] + ")";
    if (is_mod) {
        static const char* const names[] = {"modulo", "", "", "modulo2", "modulo3", "modulo4"};
        return names[static_cast<int>(node.type)] + ("(" + join(all) + ")");
    }
    return function + "(" + join(all) + ")";
}

std::string WgslDialect::choice(const std::string& condition, const std::string& a,
                                const std::string& b) const {
    return "select(" + b + ", " + a + ", " + condition + ")";
}

/// Shifts, bitwise and logical operators stand beside none but their own kind.
int WgslDialect::operand_level(const Node& in, const Node& of, int otherwise) const {
    if (of.kind != Kind::binary) return otherwise;
    if (is_shift(in)) return unary_level;
    if (is_bitwise(in)) return of.text == in.text ? otherwise : unary_level;
    const bool is_other = is_logical(of) && of.text != in.text;
    const bool compares = in.type == Type::boolean && !is_logical(in);
    const bool is_compared = of.type == Type::boolean && !is_logical(of);
    return (is_logical(in) && is_other) || (compares && is_compared) ? unary_level : otherwise;
}

std::string WgslDialect::shift_count(const Node& count, const std::string& text) const {
    return count.kind == Kind::literal ? text + "u" : "u32(" + text + ")";
}

std::string WgslDialect::constant(Type, const std::string& name, const std::string& value) const {
    return "let " + name + " = " + value + ";";
}
std::string WgslDialect::variable(Type, const std::string& name, const std::string& value) const {
    return "var " + name + " = " + value + ";";
}
/// None that is known as the shader is compiled: what is computed of it might be infinite.
std::string WgslDialect::parameter(Type, const std::string& name, const std::string& value) const {
    return "let " + name + " = " + value + ";";
}

std::string WgslDialect::counted_loop(const std::string& index, const std::string& first,
                                      const std::string& condition) const {
    return "for (var " + index + " = " + first + "; " + condition + "; " + index + "++) {";
}
std::string WgslDialect::endless_loop() const { return "loop {"; }

std::string WgslDialect::guarded(const std::string& head, const std::string& statement) const {
    return head + " { " + statement + " }";
}

std::string WgslDialect::declarations(const std::string& name,
                                      const std::vector<Named>& outputs) const {
    std::string text = "struct " + type_name(name) + " {\n";
    for (const Named& of : outputs) text += "    " + of.name + ": " + type(of.type) + ",\n";
    return text + "}\n\n";
}

std::string WgslDialect::head(const std::string& name, const std::vector<Named>& inputs,
                              const std::vector<Named>&) const {
    return "fn " + name + "(" + parameters_of(inputs) + ") -> " + type_name(name) + " {";
}

std::string WgslDialect::helper_head(Type result, const std::string& name,
                                     const std::vector<Named>& inputs) const {
    return "fn " + name + "(" + parameters_of(inputs) + ") -> " + type(result) + " {";
}

std::string WgslDialect::parameters_of(const std::vector<Named>& inputs) const {
    std::vector<std::string> parameters;
    for (const Named& of : inputs) parameters.push_back(of.name + ": " + type(of.type));
    return join(parameters);
}

std::string WgslDialect::first_line(const std::string& name) const {
    return "var out: " + type_name(name) + ";";
}
std::string WgslDialect::store(const std::string& output, const std::string& value) const {
    return "out." + output + " = " + value + ";";
}
std::string WgslDialect::last_line() const { return "return out;"; }

/// A member of the struct of uniforms, or a map.
std::string WgslDialect::uniform(const Uniform& uniform) const {
    if (is_map(uniform)) {
        const std::string type = uniform.type == "samplerCube"      ? "texture_cube<f32>"
                                 : uniform.type == "sampler2DArray" ? "texture_2d_array<f32>"
                                                                    : "texture_2d<f32>";
        return "var " + uniform.name + ": " + type + ";";
    }
    if (uniform.count > 0)
        return uniform.name + ": array<vec4f, " + std::to_string((uniform.count + 3) / 4) + ">,";
    static constexpr std::pair<const char*, const char*> types[] = {
        {"float", "f32"}, {"int", "i32"}, {"vec2", "vec2f"}, {"vec3", "vec3f"}, {"vec4", "vec4f"}};
    for (const auto& [name, other] : types)
        if (uniform.type == name) return uniform.name + ": " + other + ",";
    return uniform.name + ": " + uniform.type + ",";
}

std::string WgslDialect::uniforms(const std::vector<Uniform>& all, const std::string& text) const {
    std::string members, maps;
    int binding = 0;
    const auto place = [&] { return "@group(0) @binding(" + std::to_string(binding++) + ") "; };
    for (const Uniform& of : all)
        if (!is_map(of)) members += commented_line("    " + uniform(of), of.comment);
    if (!members.empty())
        members = "struct Uniforms {\n" + members + "}\n" + place() +
                  "var<uniform> uniforms: Uniforms;\n";
    for (const Uniform& of : all) {
        if (!is_map(of)) continue;
        maps += place() + uniform(of) + "\n";
        if (has_word(text, of.name + "_sampler"))
            maps += place() + "var " + of.name + "_sampler: sampler;\n";
    }
    return members + maps;
}

/// Arrays of numbers have four in each element: uniforms know no closer ones.
std::string WgslDialect::use_of(const Uniform& uniform, const std::string& text) const {
    if (is_map(uniform)) return text;
    if (uniform.count == 0) return "uniforms." + text;
    const int index = std::atoi(text.c_str() + text.find('[') + 1);
    return "uniforms." + uniform.name + "[" + std::to_string(index / 4) + "]." + "xyzw"[index % 4];
}

std::string WgslDialect::first_lines(const std::string& text) const {
    bool has_differences = false, has_branches = false;
    for (const char* function :
         {"dpdx(", "dpdy(", "dpdxFine(", "dpdyFine(", "textureSample(", "textureSampleBias("})
        has_differences = has_differences || has_word(text, function);
    for (const char* branch : {"if (", "for (", "loop {"})
        has_branches = has_branches || has_word(text, branch);
    if (!has_differences || !has_branches) return "";
    return "// Differences of neighbours in branches, as the source has them.\n"
           "diagnostic(off, derivative_uniformity);\n";
}

std::string WgslDialect::prelude(const std::string& text) const {
    struct Part {
        const char *word, *text;
    };
    static constexpr Part parts[] = {
        {"STATUS_",
         "// hit_status and frame_status\n"
         "const STATUS_NONE = 0;\nconst STATUS_HIT = 1;\nconst STATUS_FLOOR = 2;\n"
         "const STATUS_CAP = 3;\nconst STATUS_CLIP = 4;\nconst STATUS_NO_FRAME = 5;\n"
         "const STATUS_NAN = 6;\nconst STATUS_OUTSIDE = 7;\n"},
        {"FLAG_",
         "// bits of hit_flags and frame_flags\n"
         "const FLAG_DEGENERATE_UV = 1;\nconst FLAG_AMBIGUOUS = 2;\nconst FLAG_START_BELOW = 4;\n"
         "const FLAG_WRAPPED = 8;\nconst FLAG_NAN_LOOK_UP = 32;\n"},
        {"infinity(",
         "\n// No constant may be infinite; a variable's bits may.\n"
         "var<private> infinity_bits: u32 = 0x7f800000u;\n"
         "fn infinity() -> f32 {\n    return bitcast<f32>(infinity_bits);\n}\n"},
        {"nan(",
         "\nvar<private> nan_bits: u32 = 0x7fc00000u;\n"
         "fn nan() -> f32 {\n    return bitcast<f32>(nan_bits);\n}\n"},
        {"isnan(",
         "\nfn isnan(x: f32) -> bool {\n"
         "    return (bitcast<u32>(x) & 0x7fffffffu) > 0x7f800000u;\n}\n"},
        {"power_of_two(",
         "\n// 2 to the power of a whole number in [-126, 127].\n"
         "fn power_of_two(n: f32) -> f32 {\n"
         "    return bitcast<f32>((i32(n) + 127) << 23u);\n}\n"},
        {"exponent(",
         "\n// floor(log2(|x|)) of a normal number.\n"
         "fn exponent(x: f32) -> f32 {\n"
         "    return f32(((bitcast<i32>(x) >> 23u) & 255) - 127);\n}\n"},
        {"significand(",
         "\n// |x| / 2^exponent(x) of a normal number, in [1, 2).\n"
         "fn significand(x: f32) -> f32 {\n"
         "    return bitcast<f32>((bitcast<i32>(x) & 0x007fffff) | 0x3f800000);\n}\n"},
        {"copysign(",
         "\n// The size of a with the sign of b.\n"
         "fn copysign(a: f32, b: f32) -> f32 {\n"
         "    return bitcast<f32>((bitcast<u32>(a) & 0x7fffffffu) |\n"
         "        (bitcast<u32>(b) & 0x80000000u));\n}\n"}};
    std::string needed;
    for (const Part& part : parts)
        if (has_word(text, part.word)) needed += part.text;
    for (const auto& [name, type] : {std::pair("modulo", "f32"), std::pair("modulo2", "vec2f"),
                                     std::pair("modulo3", "vec3f"), std::pair("modulo4", "vec4f")})
        if (has_word(text, std::string(name) + "("))
            needed += std::string("\n// The remainder of x / y, of the sign of y.\nfn ") + name +
                      "(x: " + type + ", y: " + type + ") -> " + type +
                      " {\n    return x - y * floor(x / y);\n}\n";
    return needed;
}

}  // namespace quadrel::recorded
