#include "export/print/hlsl.hpp"

#include <iterator>
#include <utility>

namespace quadrel::recorded {
namespace {

/// `text` with each of `from` as `to`.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

/// What functions of GLSL are called here.
std::string function_of(const Node& node) {
    static constexpr std::pair<const char*, const char*> others[] = {{"mix", "lerp"},
                                                                     {"fract", "frac"},
                                                                     {"inversesqrt", "rsqrt"},
                                                                     {"dFdx", "ddx"},
                                                                     {"dFdy", "ddy"},
                                                                     {"dFdxFine", "ddx_fine"},
                                                                     {"dFdyFine", "ddy_fine"},
                                                                     {"roundEven", "round"},
                                                                     {"floatBitsToInt", "asint"},
                                                                     {"intBitsToFloat", "asfloat"}};
    if (node.text == "atan" && node.arguments.size() == 2) return "atan2";
    for (const auto& [name, other] : others)
        if (node.text == name) return other;
    return node.text;
}

/// A look-up as the texture's method; empty for other functions.
std::string method_of(const Node& node, bool has_bias) {
    if (node.text == "texture") return has_bias ? "SampleBias" : "Sample";
    if (node.text == "textureLod" || node.text == "textureLayer") return "SampleLevel";
    if (node.text == "textureGrad") return "SampleGrad";
    return node.text == "textureGather" ? "Gather" : "";
}

}  // namespace

std::string HlslDialect::type(Type type) const {
    static const char* const names[] = {"float", "int", "bool", "float2", "float3", "float4"};
    return names[static_cast<int>(type)];
}

std::string HlslDialect::call(const Node& node, const std::vector<std::string>& arguments) const {
    const std::string& first = arguments[0];
    if (node.kind == Node::Kind::construct && arguments.size() == 1) {
        std::string all = first;  // no vector is made of one number
        for (int i = 1; i < components_of(node.type); ++i) all += ", " + first;
        return node.text + "(" + all + ")";
    }
    if (node.text == "texelFetch")
        return first + ".Load(int3(" + arguments[1] + ", " + arguments[2] + ", " + arguments[3] +
               "))";
    if (node.text == "texelLayer")
        return first + ".Load(int4(" + arguments[1] + ", " + arguments[2] + ", " + arguments[3] +
               ", " + arguments[4] + "))";
    if (node.text == "textureSize")
        return "texture_size(" + first + ", " + arguments[1] + ")" +
               (arguments[2] == "0" ? ".x" : ".y");
    std::string method = method_of(node, arguments.size() > 2);
    if (method.empty()) return function_of(node) + "(" + join(arguments) + ")";
    std::vector<std::string> rest = {first + "_sampler"};
    rest.insert(rest.end(), arguments.begin() + 1, arguments.end());
    if (node.text == "textureLayer") {
        rest[1] = "float3(" + rest[1] + ", float(" + rest[2] + "))";
        rest.erase(rest.begin() + 2);
    }
    if (method == "Gather") {
        static constexpr const char* channels[] = {"Red", "Green", "Blue", "Alpha"};
        method += channels[arguments[2][0] - '0'];
        rest.pop_back();
    }
    return first + "." + method + "(" + join(rest) + ")";
}

std::string HlslDialect::uniform(const Uniform& uniform) const {
    const std::string& type = uniform.type;
    if (type.rfind("sampler", 0) == 0) {
        const std::string texture = type == "samplerCube"      ? "TextureCube"
                                    : type == "sampler2DArray" ? "Texture2DArray"
                                                               : "Texture2D";
        return texture + "<float4> " + uniform.name + ";\nSamplerState " + uniform.name +
               "_sampler;";
    }
    return replaced(Dialect::uniform(uniform), "vec", "float");
}

std::string HlslDialect::first_lines(const std::string&) const { return ""; }

std::string HlslDialect::prelude(const std::string& text) const {
    std::string all = Dialect::prelude(text);
    for (const auto& [from, to] :
         {std::pair("const int", "static const int"), std::pair("intBitsToFloat", "asfloat"),
          std::pair("floatBitsToInt", "asint")})
        all = replaced(all, from, to);
    if (has_word(text, "texture_size("))
        all +=
            "\nint2 texture_size(Texture2D<float4> map, int level) {\n"
            "    uint width, height, levels;\n"
            "    map.GetDimensions(level, width, height, levels);\n"
            "    return int2(width, height);\n}\n"
            "int2 texture_size(Texture2DArray<float4> map, int level) {\n"
            "    uint width, height, layers, levels;\n"
            "    map.GetDimensions(level, width, height, layers, levels);\n"
            "    return int2(width, height);\n}\n";
    for (const char* vector : {"float", "float2", "float3"})
        if (has_word(text, "mod("))
            all += std::string("\n") + vector + " mod(" + vector + " x, " + vector +
                   " y) {\n    return x - y * floor(x / y);\n}\n";
    return all;
}

}  // namespace quadrel::recorded
