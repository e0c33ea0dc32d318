#include "export/print/dialect.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>

#include "export/print/hlsl.hpp"
#include "export/print/wgsl.hpp"
#include "export/print/wrapped_line.hpp"

namespace quadrel::recorded {

std::string Dialect::join(const std::vector<std::string>& parts) {
    std::string all;
    for (const std::string& part : parts) all += (all.empty() ? "" : ", ") + part;
    return all;
}

std::string Dialect::shortest(float value) {
    char digits[40];
    for (int n = 1; n < 10; ++n) {
        std::snprintf(digits, sizeof digits, "%.*g", n, static_cast<double>(value));
        if (std::strtof(digits, nullptr) == value) break;
    }
    std::string text = digits;
    if (text.find('e') != std::string::npos && std::fabs(value) < 1e7f && std::fabs(value) >= 1) {
        std::snprintf(digits, sizeof digits, "%.1f", static_cast<double>(value));
        text = digits;
    }
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string Dialect::type(Type type) const {
    static const char* const names[] = {"float", "int", "bool", "vec2", "vec3", "vec4"};
    return names[static_cast<int>(type)];
}

std::string Dialect::real(float value) const {
    if (std::isnan(value)) return "NAN";
    if (std::isinf(value)) return value < 0 ? "-INFINITY" : "INFINITY";
    return shortest(value);
}

std::string Dialect::call(const Node& node, const std::vector<std::string>& arguments) const {
    if (node.text == "texelFetch")
        return "texelFetch(" + arguments[0] + ", ivec2(" + arguments[1] + ", " + arguments[2] +
               "), " + arguments[3] + ")";
    if (node.text == "texelLayer")
        return "texelFetch(" + arguments[0] + ", ivec3(" + arguments[1] + ", " + arguments[2] +
               ", " + arguments[3] + "), " + arguments[4] + ")";
    if (node.text == "textureSize")
        return "textureSize(" + arguments[0] + ", " + arguments[1] + ")" +
               (arguments[2] == "0" ? ".x" : ".y");
    if (node.text == "textureLayer")
        return "textureLod(" + arguments[0] + ", " + type(Type::vec3) + "(" + arguments[1] + ", " +
               "float(" + arguments[2] + ")), " + arguments[3] + ")";
    return node.text + "(" + join(arguments) + ")";
}

int Dialect::operand_level(const Node&, const Node&, int otherwise) const { return otherwise; }

std::string Dialect::shift_count(const Node&, const std::string& text) const { return text; }

std::string Dialect::choice(const std::string& condition, const std::string& a,
                            const std::string& b) const {
    return condition + " ? " + a + " : " + b;
}

std::string Dialect::prefix(const std::string& vector, int components) const {
    return vector + "." + std::string("xyzw").substr(0, static_cast<std::size_t>(components));
}

std::string Dialect::constant(Type of, const std::string& name, const std::string& value) const {
    return type(of) + " " + name + " = " + value + ";";
}
std::string Dialect::variable(Type of, const std::string& name, const std::string& value) const {
    return type(of) + " " + name + " = " + value + ";";
}

std::string Dialect::parameter(Type of, const std::string& name, const std::string& value) const {
    return "const " + type(of) + " " + name + " = " + value + ";";
}

std::string Dialect::counted_loop(const std::string& index, const std::string& first,
                                  const std::string& condition) const {
    return "for (int " + index + " = " + first + "; " + condition + "; ++" + index + ") {";
}
std::string Dialect::endless_loop() const { return "for (;;) {"; }

std::string Dialect::guarded(const std::string& head, const std::string& statement) const {
    return head + " " + statement;
}

std::string Dialect::declarations(const std::string&, const std::vector<Named>&) const {
    return "";
}
std::string Dialect::first_line(const std::string&) const { return ""; }
std::string Dialect::last_line() const { return ""; }

std::string Dialect::store(const std::string& output, const std::string& value) const {
    return output + " = " + value + ";";
}

std::string Dialect::head(const std::string& name, const std::vector<Named>& inputs,
                          const std::vector<Named>& outputs) const {
    std::vector<std::string> parameters;
    for (const Named& of : inputs) parameters.push_back(type(of.type) + " " + of.name);
    for (const Named& of : outputs) parameters.push_back("out " + type(of.type) + " " + of.name);
    return "void " + name + "(" + join(parameters) + ") {";
}

std::string Dialect::helper_head(Type result, const std::string& name,
                                 const std::vector<Named>& inputs) const {
    std::vector<std::string> parameters;
    for (const Named& of : inputs) parameters.push_back(type(of.type) + " " + of.name);
    return type(result) + " " + name + "(" + join(parameters) + ") {";
}

std::string Dialect::uniform(const Uniform& uniform) const {
    const std::string count = uniform.count > 0 ? "[" + std::to_string(uniform.count) + "]" : "";
    return "uniform " + uniform.type + " " + uniform.name + count + ";";
}

std::string Dialect::uniforms(const std::vector<Uniform>& all, const std::string&) const {
    std::string lines;
    for (const Uniform& of : all) lines += commented_line(uniform(of), of.comment);
    return lines;
}

std::string Dialect::use_of(const Uniform&, const std::string& text) const { return text; }

bool Dialect::has_word(const std::string& text, const std::string& word) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
        if (at == 0 ||
            (std::isalnum(static_cast<unsigned char>(text[at - 1])) == 0 && text[at - 1] != '_'))
            return true;
    return false;
}

std::string Dialect::prelude(const std::string& text) const {
    struct Part {
        const char *word, *text;
    };
    static constexpr Part parts[] = {
        {"STATUS_",
         "// hit_status and frame_status\n"
         "const int STATUS_NONE = 0, STATUS_HIT = 1, STATUS_FLOOR = 2, STATUS_CAP = 3;\n"
         "const int STATUS_CLIP = 4, STATUS_NO_FRAME = 5, STATUS_NAN = 6, STATUS_OUTSIDE = 7;\n"},
        {"FLAG_",
         "// bits of hit_flags and frame_flags\n"
         "const int FLAG_DEGENERATE_UV = 1, FLAG_AMBIGUOUS = 2, FLAG_START_BELOW = 4;\n"
         "const int FLAG_WRAPPED = 8, FLAG_NAN_LOOK_UP = 32;\n"},
        {"INFINITY", "#define INFINITY intBitsToFloat(0x7f800000)\n"},
        {"NAN", "#define NAN intBitsToFloat(0x7fc00000)\n"},
        {"power_of_two(",
         "\n// 2 to the power of a whole number in [-126, 127].\n"
         "float power_of_two(float n) {\n    return intBitsToFloat((int(n) + 127) << 23);\n}\n"},
        {"exponent(",
         "\n// floor(log2(|x|)) of a normal number.\n"
         "float exponent(float x) {\n"
         "    return float(((floatBitsToInt(x) >> 23) & 255) - 127);\n}\n"},
        {"significand(",
         "\n// |x| / 2^exponent(x) of a normal number, in [1, 2).\n"
         "float significand(float x) {\n"
         "    return intBitsToFloat((floatBitsToInt(x) & 0x007fffff) | 0x3f800000);\n}\n"},
        {"copysign(",
         "\n// The size of a with the sign of b.\n"
         "float copysign(float a, float b) {\n"
         "    return intBitsToFloat((floatBitsToInt(a) & 0x7fffffff) |\n"
         "        (floatBitsToInt(b) & ~0x7fffffff));\n}\n"}};
    std::string needed;
    for (const Part& part : parts)
        if (has_word(text, part.word)) needed += part.text;
    return needed;
}

std::string Dialect::first_lines(const std::string& text) const {
    if (has_word(text, "dFdxFine(") || has_word(text, "dFdyFine("))
        return "#version 400 core\n#extension GL_ARB_derivative_control : require\n";
    return has_word(text, "textureGather") ? "#version 400 core\n" : "#version 330 core\n";
}

namespace {

/// GLSL ES 300, or 310 where it gathers.
class EsDialect : public Dialect {
  public:
    std::string first_lines(const std::string& text) const override {
        std::string lines =
            has_word(text, "textureGather") ? "#version 310 es\n" : "#version 300 es\n";
        for (const char* type : {"float", "int", "sampler2D", "sampler2DArray", "samplerCube"})
            lines += std::string("precision highp ") + type + ";\n";
        return lines;
    }
    std::string prelude(const std::string& text) const override {
        std::string all = Dialect::prelude(text);
        if (has_word(text, "dFdxFine("))
            all +=
                "// OpenGL ES cannot ask for fine differences; of coarse ones neighbours' numbers "
                "are not "
                "told.\n"
                "#define dFdxFine dFdx\n#define dFdyFine dFdy\n";
        return all;
    }
};

/// C++ with the header of tests/export: what the tests compile to hold the text to the stage.
class CppDialect : public Dialect {
  public:
    std::string real(float value) const override {
        const std::string text = Dialect::real(value);
        return std::isfinite(value) ? text + "f" : text;
    }
    std::string call(const Node& node, const std::vector<std::string>& arguments) const override {
        if (node.text == "int") return "to_int(" + arguments[0] + ")";
        if (node.text == "textureSize") return "texture_size(" + join(arguments) + ")";
        if (node.text == "texelFetch") return "texel_fetch(" + join(arguments) + ")";
        if (node.text == "texelLayer") return "texel_of_layer(" + join(arguments) + ")";
        return Dialect::call(node, arguments);
    }
    std::string prefix(const std::string& vector, int components) const override {
        return std::string("xyzw").substr(0, static_cast<std::size_t>(components)) + "(" + vector +
               ")";
    }
    std::string head(const std::string& name, const std::vector<Named>& inputs,
                     const std::vector<Named>& outputs) const override {
        std::vector<std::string> parameters;
        for (const Named& of : inputs) parameters.push_back(type(of.type) + " " + of.name);
        for (const Named& of : outputs) parameters.push_back(type(of.type) + "& " + of.name);
        return "void " + name + "(" + join(parameters) + ") {";
    }
    std::string uniform(const Uniform& uniform) const override {
        const std::string count =
            uniform.count > 0 ? "[" + std::to_string(uniform.count) + "]" : "";
        return "extern " + uniform.type + " " + uniform.name + count + ";";
    }
    std::string prelude(const std::string&) const override { return ""; }
    std::string first_lines(const std::string&) const override { return ""; }
};

struct DialectRow {
    const char* name;
    std::unique_ptr<Dialect> (*make)();
};
template <class D>
std::unique_ptr<Dialect> made() {
    return std::make_unique<D>();
}
const DialectRow dialects[] = {{"glsl", made<Dialect>},
                               {"glsl-es", made<EsDialect>},
                               {"hlsl", made<HlslDialect>},
                               {"wgsl", made<WgslDialect>},
                               {"c++", made<CppDialect>}};

}  // namespace

std::unique_ptr<Dialect> find_dialect(std::string_view name) {
    for (const DialectRow& row : dialects)
        if (name == row.name) return row.make();
    return nullptr;
}

bool is_reserved(const std::string& word) {
    static const char* const words[] = {
        "abs",        "abstract",    "acos",       "active",     "alias",       "alignas",
        "all",        "and",         "any",        "array",      "as",          "asin",
        "asm",        "async",       "atan",       "atomic",     "attribute",   "auto",
        "await",      "become",      "bitcast",    "bool",       "break",       "case",
        "cast",       "catch",       "ceil",       "centroid",   "clamp",       "class",
        "clip",       "coherent",    "common",     "concept",    "const",       "continue",
        "continuing", "copysign",    "cos",        "crate",      "cross",       "debugger",
        "default",    "delete",      "demote",     "diagnostic", "discard",     "distance",
        "do",         "dot",         "double",     "dpdx",       "dpdy",        "else",
        "enable",     "enum",        "exp",        "exp2",       "explicit",    "exponent",
        "export",     "extends",     "extern",     "external",   "fallthrough", "false",
        "filter",     "final",       "finally",    "fixed",      "flat",        "float",
        "floor",      "fma",         "fn",         "for",        "frac",        "fract",
        "friend",     "from",        "get",        "goto",       "half",        "highp",
        "if",         "impl",        "implements", "import",     "in",          "infinity",
        "inline",     "inout",       "input",      "int",        "interface",   "invariant",
        "inverse",    "inversesqrt", "layout",     "length",     "lerp",        "let",
        "line",       "linear",      "log",        "log2",       "long",        "loop",
        "lowp",       "macro",       "match",      "matrix",     "max",         "mediump",
        "meta",       "min",         "mix",        "mod",        "module",      "modulo",
        "move",       "mut",         "mutable",    "namespace",  "nan",         "new",
        "nil",        "noise",       "normalize",  "not",        "null",        "nullptr",
        "of",         "operator",    "or",         "out",        "output",      "override",
        "package",    "packed",      "partition",  "pass",       "patch",       "point",
        "pow",        "precise",     "precision",  "priv",       "private",     "protected",
        "ptr",        "pub",         "public",     "readonly",   "ref",         "reflect",
        "refract",    "register",    "require",    "requires",   "resource",    "restrict",
        "return",     "round",       "sample",     "sampler",    "saturate",    "select",
        "self",       "set",         "shader",     "shared",     "short",       "sign",
        "signed",     "significand", "sin",        "sizeof",     "smooth",      "snorm",
        "sqrt",       "static",      "std",        "step",       "storage",     "struct",
        "super",      "superp",      "switch",     "tan",        "target",      "template",
        "texture",    "this",        "throw",      "trait",      "transpose",   "triangle",
        "true",       "trunc",       "try",        "type",       "typedef",     "typeid",
        "typename",   "typeof",      "uint",       "uniform",    "uniforms",    "union",
        "unless",     "unorm",       "unsafe",     "unsigned",   "use",         "using",
        "var",        "varying",     "vector",     "virtual",    "void",        "volatile",
        "where",      "while",       "with",       "workgroup",  "writeonly",   "xor",
        "yield"};
    return std::any_of(std::begin(words), std::end(words),
                       [&](const char* known) { return word == known; });
}

}  // namespace quadrel::recorded
