#include "export/program/wgsl_entry_point.hpp"

#include <algorithm>

namespace quadrel::recorded {
namespace {

std::string member(const std::string& attributes, const std::string& name,
                   const std::string& type) {
    return statement(attributes + " " + name + ": " + type + ",");
}

std::string location(int number) { return "@location(" + std::to_string(number) + ")"; }

}  // namespace

std::string WgslEntryPoint::begin_module(const std::string& comment, const std::string& all,
                                         const std::vector<Uniform>& uniforms) const {
    std::string text = comment;
    for (const std::string& part : {dialect_.first_lines(all), dialect_.prelude(all)})
        if (!part.empty()) text += (part[0] == '\n' ? "" : "\n") + part;
    return text + "\n" + dialect_.uniforms(uniforms, all) + "\n";
}

std::string WgslEntryPoint::varyings_struct(const std::vector<Varying>& varyings,
                                            bool centroid) const {
    std::string all =
        "struct Varyings {\n" + member("@builtin(position)", "window", dialect_.type(Type::vec4));
    for (std::size_t i = 0; i < varyings.size(); ++i)
        all += member(
            location(static_cast<int>(i)) + (varyings[i].is_flat ? " @interpolate(flat)"
                                             : centroid ? " @interpolate(perspective, centroid)"
                                                        : ""),
            varyings[i].name, dialect_.type(varyings[i].type));
    return all + "}\n\n";
}

/// Variables of the shader for all that passes show, and the function that sets them.
std::string WgslEntryPoint::values(const FragmentText& text) const {
    std::string all, body;
    const auto declare = [&](const std::string& name, Type type) {
        all += "var<private> " + name + ": " + dialect_.type(type) + ";\n";
    };
    for (const Varying& varying : text.varyings) {
        declare(varying.name, varying.type);
        body += statement(varying.name + " = varyings." + varying.name + ";");
    }
    const auto is_varying = [&](const Named& value) {
        return std::any_of(text.varyings.begin(), text.varyings.end(),
                           [&](const Varying& of) { return of.name == value.name; });
    };
    for (const Named& value : text.values)
        if (!is_varying(value)) declare(value.name, value.type);
    for (const std::string& line : text.statements) body += statement(line);
    return all + "\nfn shade_fragment(varyings: Varyings" +
           (text.asks_front_facing ? ", is_front_facing: bool" : "") + ") {\n" + body + "}\n\n";
}

std::string WgslEntryPoint::pass(const FragmentText& text, std::size_t number) const {
    const auto& targets = text.passes[number];
    const std::string type = "Targets" + std::to_string(number);
    const bool asks = text.asks_front_facing;
    std::string members, body;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const std::string name = "target" + std::to_string(i);
        members += member(location(static_cast<int>(i)), name, dialect_.type(Type::vec4));
        body += statement("targets." + name + " = " +
                          target_value(dialect_.type(Type::vec4), targets[i]) + ";");
    }
    if (!text.depth.empty()) {
        members += member("@builtin(frag_depth)", "depth", dialect_.type(Type::real));
        body += statement("targets.depth = " + text.depth + ";");
    }
    // Last: neighbours need the values of what is discarded.
    if (!text.discard.empty()) body += statement("if (" + text.discard + ") { discard; }");
    return "struct " + type + " {\n" + members + "}\n\n@fragment\nfn pass" +
           std::to_string(number) + "(varyings: Varyings" +
           (asks ? ", @builtin(front_facing) is_front_facing: bool" : "") + ") -> " + type +
           " {\n" +
           statement(asks ? "shade_fragment(varyings, is_front_facing);"
                          : "shade_fragment(varyings);") +
           statement("var targets: " + type + ";") + body + statement("return targets;") + "}\n";
}

std::string WgslEntryPoint::fragment(const FragmentText& text) const {
    std::string needs = text.functions + text.discard;
    for (const std::string& line : text.statements) needs += line;
    std::string all = begin_module(text.comment, needs, text.uniforms) +
                      varyings_struct(text.varyings, text.centroid) + text.functions + "\n" +
                      values(text);
    for (std::size_t i = 0; i < text.passes.size(); ++i)
        all += (i == 0 ? "" : "\n") + pass(text, i);
    return all;
}

/// Members of the struct, set within a branch or, where there is none, without `indent`.
std::string WgslEntryPoint::vertex_branch(const VertexText& text, bool shaded,
                                          const std::string& indent) const {
    std::string all;
    const auto set = [&](const std::string& line) { all += statement(indent + line); };
    // A call that is needed in any case comes before the attributes that have a part of it.
    for (const VertexCall& call : text.calls) {
        if (shaded && !call.is_needed) continue;
        const std::string values = call.function + "_values";
        std::string arguments;
        for (const std::string& argument : call.arguments)
            arguments += (arguments.empty() ? "" : ", ") + argument;
        set("let " + values + " = " + call.function + "(" + arguments + ");");
        for (std::size_t i = 0; i < call.results.size(); ++i)
            set("varyings." + call.varyings[i] + " = " + values + "." + call.results[i].name + ";");
    }
    for (std::size_t i = 0; i < text.varyings.size(); ++i) {
        const VertexText::Value& value = text.values[i];
        const std::string& name = text.varyings[i].name;
        if ((shaded ? value.shaded : value.transformed).empty()) continue;
        set("let " + name + " = " + (shaded ? value.shaded : value.transformed) + ";");
        set("varyings." + name + " = " + name + ";");
    }
    set("varyings.window = " + (shaded ? text.position.shaded : text.position.transformed) + ";");
    return all;
}

std::string WgslEntryPoint::vertex(const VertexText& text) const {
    std::string all = begin_module(text.comment, text.functions, text.uniforms) +
                      "override SHADED_VERTICES: bool = true;\n\nstruct Vertex {\n";
    for (const Attribute& attribute : text.attributes)
        all += member(location(attribute.location), attribute.name, dialect_.type(attribute.type));
    all += "}\n\n" + varyings_struct(text.varyings, text.centroid) + text.functions +
           "@vertex\nfn main(corner: Vertex) -> Varyings {\n";
    for (const Attribute& attribute : text.attributes)
        all += statement("let " + attribute.name + " = corner." + attribute.name + ";");
    all += statement("var varyings: Varyings;");
    if (text.position.transformed == text.position.shaded)
        return all + vertex_branch(text, true, "") + statement("return varyings;") + "}\n";
    return all + statement("if (SHADED_VERTICES) {") + vertex_branch(text, true) +
           statement("} else {") + vertex_branch(text, false) + statement("}") +
           statement("return varyings;") + "}\n";
}

}  // namespace quadrel::recorded
