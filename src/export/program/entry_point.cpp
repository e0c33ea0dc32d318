#include "export/program/entry_point.hpp"

#include <algorithm>

#include "export/print/wrapped_line.hpp"

namespace quadrel::recorded {
namespace {

std::string vector_of_components(const std::string& type, const std::array<std::string, 4>& parts) {
    std::string text = type + "(";
    for (std::size_t i = 0; i < parts.size(); ++i)
        text += (i == 0 ? "" : ", ") + (parts[i].empty() ? std::string("0.0") : parts[i]);
    return text + ")";
}

std::size_t most_targets_of(const FragmentText& text) {
    std::size_t most = 0;
    for (const auto& pass : text.passes) most = std::max(most, pass.size());
    return most;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string all;
    for (const std::string& line : lines) all += statement(line);
    return all;
}

}  // namespace

std::string statement(const std::string& text) { return wrapped_line("    " + text) + "\n"; }

template <class Assign>
std::string EntryPoint::assignments(const FragmentText& text, const Assign& assign) const {
    std::string all;
    for (std::size_t pass = 0; pass < text.passes.size(); ++pass) {
        all += (pass == 0 ? "#if PASS == " : "#elif PASS == ") + std::to_string(pass) + "\n";
        for (std::size_t target = 0; target < text.passes[pass].size(); ++target)
            all += statement(
                assign("target" + std::to_string(target),
                       vector_of_components(dialect_.type(Type::vec4), text.passes[pass][target])));
    }
    return all.empty() ? all : all + "#endif\n";
}

std::string EntryPoint::begin(const std::string& comment, const std::string& all,
                              const std::vector<Uniform>& uniforms, const std::string& extension,
                              bool passes) const {
    std::string text = dialect_.first_lines(all) + extension;
    if (!text.empty()) text += "\n";
    text += comment;
    if (passes) text += "#ifndef PASS\n#define PASS 0\n#endif\n";
    const std::string prelude = dialect_.prelude(all);
    if (!prelude.empty()) text += (prelude[0] == '\n' ? "" : "\n") + prelude;
    text += "\n";
    for (const Uniform& uniform : uniforms) text += dialect_.uniform(uniform) + "\n";
    return text + "\n";
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
    std::string all = begin(text.comment, text.functions, text.uniforms,
                            asks_330 ? "#extension GL_ARB_texture_query_lod : enable\n" : "", true);
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
    std::string all = begin(text.comment, text.functions, text.uniforms, "", false);
    for (const Named& attribute : text.attributes)
        all += "layout(location = " + std::to_string(location_of(attribute.name)) + ") in " +
               dialect_.type(attribute.type) + " " + attribute.name + ";\n";
    for (const Varying& varying : text.varyings)
        all += std::string(varying.is_flat ? "flat "
                           : text.centroid ? "centroid "
                                           : "") +
               "out " + dialect_.type(varying.type) + " " + varying.name + ";\n";
    all += "\n" + text.functions + "void main() {\n";
    for (std::size_t i = 0; i < text.varyings.size(); ++i)
        all += statement(std::string(text.varyings[i].name) + " = " + text.values[i] + ";");
    return all + statement("gl_Position = " + text.position + ";") + "}\n";
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

    std::string fragment(const FragmentText& text) const override {
        std::string all = begin(text.comment, text.functions, text.uniforms, "", true) +
                          varyings_struct(text.varyings, text.centroid) + "struct Targets {\n";
        for (std::size_t i = 0; i < most_targets_of(text); ++i)
            all += statement("float4 target" + std::to_string(i) + " : SV_Target" +
                             std::to_string(i) + ";");
        if (!text.depth.empty()) all += statement("float depth : SV_Depth;");
        all += "};\n\n" + text.functions + "Targets main(Varyings varyings) {\n";
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
        std::string all =
            begin(text.comment, text.functions, text.uniforms, "", false) + "struct Vertex {\n";
        for (const Named& attribute : text.attributes)
            all += statement(dialect_.type(attribute.type) + " " + attribute.name + " : ATTRIBUTE" +
                             std::to_string(location_of(attribute.name)) + ";");
        all += "};\n" + varyings_struct(text.varyings, text.centroid) + text.functions +
               "Varyings main(Vertex corner) {\n";
        for (const Named& attribute : text.attributes)
            all += statement(dialect_.type(attribute.type) + " " + attribute.name + " = corner." +
                             attribute.name + ";");
        all += statement("Varyings varyings;");
        for (std::size_t i = 0; i < text.varyings.size(); ++i) {
            const std::string name = text.varyings[i].name;
            all += statement(dialect_.type(text.varyings[i].type) + " " + name + " = " +
                             text.values[i] + ";") +
                   statement("varyings." + name + " = " + name + ";");
        }
        return all + statement("varyings.window = " + text.position + ";") +
               statement("return varyings;") + "}\n";
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
    return nullptr;
}

}  // namespace quadrel::recorded
