#include "export/program/entry_point.hpp"

#include <algorithm>

#include "export/print/wrapped_line.hpp"
#include "export/program/wgsl_entry_point.hpp"

namespace quadrel::recorded {
namespace {

std::size_t most_targets_of(const FragmentText& text) {
    std::size_t most = 0;
    for (const auto& pass : text.passes) most = std::max(most, pass.size());
    return most;
}

/// Whether vertices are taken as Quadrel has transformed them: what comes after is judged by
/// itself.
constexpr const char* shaded_macro = "SHADED_VERTICES 1";

/// Results go into varyings, whose names stand behind `owner`.
std::string call_statement(const VertexCall& call, const std::string& owner) {
    std::string arguments;
    const auto add = [&](const std::string& argument) {
        arguments += (arguments.empty() ? "" : ", ") + argument;
    };
    for (const std::string& argument : call.arguments) add(argument);
    for (const std::string& varying : call.varyings) add(owner + varying);
    return statement(call.function + "(" + arguments + ");");
}

std::string joined(const std::vector<std::string>& lines) {
    std::string all;
    for (const std::string& line : lines) all += statement(line);
    return all;
}

}  // namespace

std::string statement(const std::string& text) { return wrapped_line("    " + text) + "\n"; }

std::string target_value(const std::string& type, const std::vector<std::string>& parts) {
    std::string text = type + "(";
    for (std::size_t i = 0; i < parts.size(); ++i) text += (i == 0 ? "" : ", ") + parts[i];
    return text + ")";
}

template <class Assign>
std::string EntryPoint::assignments(const FragmentText& text, const Assign& assign) const {
    std::string all;
    for (std::size_t pass = 0; pass < text.passes.size(); ++pass) {
        all += (pass == 0 ? "#if PASS == " : "#elif PASS == ") + std::to_string(pass) + "\n";
        for (std::size_t target = 0; target < text.passes[pass].size(); ++target)
            all += statement(
                assign("target" + std::to_string(target),
                       target_value(dialect_.type(Type::vec4), text.passes[pass][target])));
    }
    return all.empty() ? all : all + "#endif\n";
}

template <class Assign, class Call, class Place>
std::string EntryPoint::vertex_values(const VertexText& text, const Assign& assign,
                                      const Call& call, const Place& place) const {
    std::string same, transformed, shaded;
    for (std::size_t i = 0; i < text.varyings.size(); ++i) {
        const VertexText::Value& value = text.values[i];
        if (value.transformed == value.shaded) {
            if (!value.shaded.empty()) same += assign(text.varyings[i], value.shaded);
            continue;
        }
        if (!value.transformed.empty()) transformed += assign(text.varyings[i], value.transformed);
        if (!value.shaded.empty()) shaded += assign(text.varyings[i], value.shaded);
    }
    // A call that is needed in any case comes before the attributes that have a part of it.
    for (const VertexCall& of : text.calls) (of.is_needed ? same : transformed) += call(of);
    if (text.position.transformed == text.position.shaded)
        return same + place(text.position.shaded);
    return same + "#if SHADED_VERTICES\n" + shaded + place(text.position.shaded) + "#else\n" +
           transformed + place(text.position.transformed) + "#endif\n";
}

std::string EntryPoint::begin(const std::string& comment, const std::string& all,
                              const std::vector<Uniform>& uniforms, const std::string& first,
                              const std::string& macro) const {
    std::string text = first;
    if (!text.empty()) text += "\n";
    text += comment;
    const std::string name = macro.substr(0, macro.find(' '));
    text += "#ifndef " + name + "\n#define " + macro + "\n#endif\n";
    const std::string prelude = dialect_.prelude(all);
    if (!prelude.empty()) text += (prelude[0] == '\n' ? "" : "\n") + prelude;
    text += "\n";
    return text + dialect_.uniforms(uniforms, all) + "\n";
}

std::string EntryPoint::lod_statements(const std::string& map, const std::string& version) const {
    const std::string arguments = "(" + map + ", uv);";
    if (version.find("330") == std::string::npos)
        return statement("vec2 level_of_detail = textureQueryLod" + arguments);
    return statement("vec2 level_of_detail = vec2(0.0);") + "#ifdef GL_ARB_texture_query_lod\n" +
           statement("level_of_detail = textureQueryLOD" + arguments) + "#endif\n";
}

std::string EntryPoint::fragment(const FragmentText& text) const {
    const std::string version = dialect_.first_lines(text.functions);
    const bool asks_330 = !text.lod_map.empty() && version.find("330") != std::string::npos;
    std::string all = begin(
        text.comment, text.functions, text.uniforms,
        version + (asks_330 ? "#extension GL_ARB_texture_query_lod : enable\n" : ""), "PASS 0");
    for (const Varying& varying : text.varyings)
        all += std::string(varying.is_flat ? "flat "
                           : text.centroid ? "centroid "
                                           : "") +
               "in " + dialect_.type(varying.type) + " " + varying.name + ";\n";
    for (std::size_t i = 0; i < most_targets_of(text); ++i)
        all += "layout(location = " + std::to_string(i) + ") out vec4 target" + std::to_string(i) +
               ";\n";
    all += "\n" + text.functions + "void main() {\n";
    all += joined(text.statements);
    if (!text.lod_map.empty()) all += lod_statements(text.lod_map, version);
    all += assignments(text, [](const std::string& target, const std::string& value) {
        return target + " = " + value + ";";
    });
    if (!text.depth.empty()) all += statement("gl_FragDepth = " + text.depth + ";");
    // Last: neighbours need the values of what is discarded.
    if (!text.discard.empty()) all += statement("if (" + text.discard + ") discard;");
    return all + "}\n";
}

std::string EntryPoint::vertex(const VertexText& text) const {
    std::string all = begin(text.comment, text.functions, text.uniforms,
                            dialect_.first_lines(text.fragment_functions), shaded_macro);
    for (const Attribute& attribute : text.attributes)
        all += "layout(location = " + std::to_string(attribute.location) + ") in " +
               dialect_.type(attribute.type) + " " + attribute.name + ";\n";
    for (const Varying& varying : text.varyings)
        all += std::string(varying.is_flat ? "flat "
                           : text.centroid ? "centroid "
                                           : "") +
               "out " + dialect_.type(varying.type) + " " + varying.name + ";\n";
    all += "\n" + text.functions + "void main() {\n";
    all += vertex_values(
        text,
        [](const Varying& varying, const std::string& value) {
            return statement(varying.name + " = " + value + ";");
        },
        [](const VertexCall& call) { return call_statement(call, ""); },
        [](const std::string& position) { return statement("gl_Position = " + position + ";"); });
    return all + "}\n";
}

namespace {

class EsEntryPoint : public EntryPoint {
  public:
    using EntryPoint::EntryPoint;
    bool has_lod() const override { return false; }
};

/// What is handed on lies in structs; each pass has targets of its own.
class HlslEntryPoint : public EntryPoint {
  public:
    using EntryPoint::EntryPoint;

    std::string frag_coord() const override { return "varyings.window.xy"; }
    std::string front_facing() const override { return "is_front_facing"; }

    std::string fragment(const FragmentText& text) const override {
        std::string all = begin(text.comment, text.functions, text.uniforms, "", "PASS 0") +
                          varyings_struct(text.varyings, text.centroid) + "struct Targets {\n";
        for (std::size_t i = 0; i < most_targets_of(text); ++i)
            all += statement("float4 target" + std::to_string(i) + " : SV_Target" +
                             std::to_string(i) + ";");
        if (!text.depth.empty()) all += statement("float depth : SV_Depth;");
        all += "};\n\n" + text.functions + "Targets main(Varyings varyings" +
               (text.asks_front_facing ? ", bool is_front_facing : SV_IsFrontFace" : "") + ") {\n";
        for (const Varying& varying : text.varyings)
            all += statement(dialect_.type(varying.type) + " " + varying.name + " = varyings." +
                             varying.name + ";");
        all += joined(text.statements);
        if (!text.lod_map.empty()) all += lod_statements(text.lod_map, "");
        all += statement("Targets targets = (Targets)0;");
        all += assignments(text, [](const std::string& target, const std::string& value) {
            return "targets." + target + " = " + value + ";";
        });
        if (!text.depth.empty()) all += statement("targets.depth = " + text.depth + ";");
        if (!text.discard.empty()) all += statement("if (" + text.discard + ") discard;");
        return all + statement("return targets;") + "}\n";
    }

    std::string vertex(const VertexText& text) const override {
        std::string all = begin(text.comment, text.functions, text.uniforms, "", shaded_macro) +
                          "struct Vertex {\n";
        for (const Attribute& attribute : text.attributes)
            all += statement(dialect_.type(attribute.type) + " " + attribute.name + " : ATTRIBUTE" +
                             std::to_string(attribute.location) + ";");
        all += "};\n" + varyings_struct(text.varyings, text.centroid) + text.functions +
               "Varyings main(Vertex corner) {\n";
        for (const Attribute& attribute : text.attributes)
            all += statement(dialect_.type(attribute.type) + " " + attribute.name + " = corner." +
                             attribute.name + ";");
        all += statement("Varyings varyings;");
        all += vertex_values(
            text,
            [&](const Varying& varying, const std::string& value) {
                const std::string& name = varying.name;
                return statement(dialect_.type(varying.type) + " " + name + " = " + value + ";") +
                       statement("varyings." + name + " = " + name + ";");
            },
            [](const VertexCall& call) { return call_statement(call, "varyings."); },
            [](const std::string& position) {
                return statement("varyings.window = " + position + ";");
            });
        return all + statement("return varyings;") + "}\n";
    }

  protected:
    std::string lod_statements(const std::string& map, const std::string&) const override {
        const std::string arguments = "(" + map + "_sampler, uv)";
        return statement("float2 level_of_detail = float2(" + map + ".CalculateLevelOfDetail" +
                         arguments + ", " + map + ".CalculateLevelOfDetailUnclamped" + arguments +
                         ");");
    }

  private:
    std::string varyings_struct(const std::vector<Varying>& varyings, bool centroid) const {
        std::string all = "struct Varyings {\n" + statement("float4 window : SV_Position;");
        for (std::size_t i = 0; i < varyings.size(); ++i)
            all += statement(std::string(varyings[i].is_flat ? "nointerpolation "
                                         : centroid          ? "centroid "
                                                             : "") +
                             dialect_.type(varyings[i].type) + " " + varyings[i].name +
                             " : VARYING" + std::to_string(i) + ";");
        return all + "};\n\n";
    }
};

}  // namespace

std::unique_ptr<EntryPoint> find_entry_point(std::string_view language, const Dialect& dialect) {
    if (language == "glsl") return std::make_unique<EntryPoint>(dialect);
    if (language == "glsl-es") return std::make_unique<EsEntryPoint>(dialect);
    if (language == "hlsl") return std::make_unique<HlslEntryPoint>(dialect);
    if (language == "wgsl") return std::make_unique<WgslEntryPoint>(dialect);
    return nullptr;
}

}  // namespace quadrel::recorded
