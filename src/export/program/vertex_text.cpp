#include "export/program/vertex_text.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "export/program/matrices.hpp"
#include "export/stages/vertex_transforms.hpp"

namespace quadrel::recorded {
namespace {

const Uniform flat_faces{"flat_faces", "float", 0};

/// Attributes at their locations in a program.
class Attributes {
  public:
    explicit Attributes(const ProgramRequest& request) {
        const auto& known = vertex_attributes();
        if (request.attribute_count == 0)
            for (const Named& of : known) names_.push_back(of.name);
        for (int i = 0; i < request.attribute_count; ++i) names_.push_back(request.attributes[i]);
        is_open_ = request.attribute_count == 0;
        for (const Named& of : known) types_[of.name] = of.type;
    }

    /// Whether vertices have the values of that varying.
    bool have(const Varying& of) const {
        return is_open_ || std::find(names_.begin(), names_.end(), of.shaded) != names_.end();
    }
    void read(const std::string& name) {
        if (read_.insert(name).second && location_of(name) < 0) names_.push_back(name);
    }
    void read(const std::string& name, Type type) {
        types_[name] = type;
        read(name);
    }
    /// Those that are read.
    std::vector<Attribute> all() const {
        std::vector<Attribute> list;
        for (const std::string& name : names_)
            if (read_.count(name) != 0) list.push_back({name, types_.at(name), location_of(name)});
        return list;
    }

  private:
    int location_of(const std::string& name) const {
        const auto found = std::find(names_.begin(), names_.end(), name);
        return found == names_.end() ? -1 : static_cast<int>(found - names_.begin());
    }

    std::vector<std::string> names_;
    bool is_open_ = false;  ///< whether vertices may have more
    std::map<std::string, Type> types_;
    std::set<std::string> read_;
};

/// The program's own vertices times the object's matrices, in the order of text.varyings.
class VertexValues {
  public:
    VertexValues(const ProgramRequest& request, VertexText& text, Attributes& attributes,
                 const Dialect& dialect)
        : request_(request), text_(text), attributes_(attributes), dialect_(dialect) {}

    VertexText::Value of(const Varying& varying) {
        if (varying.attribute.empty()) {
            if (!attributes_.have(varying)) return {};
            attributes_.read(varying.shaded, varying.type);
            return {"", varying.shaded};
        }
        attributes_.read(varying.attribute);
        attributes_.read(varying.shaded);
        return {transformed(varying), varying.shaded};
    }

    /// An expression for what a vertex program reads under that name.
    std::string argument(const std::string& input) {
        if (input == vertex_attribute::uv) {
            attributes_.read("texture_coordinates");
            return mapped("texture_coordinates");
        }
        const std::string attribute = attribute_of_program(input);
        attributes_.read(attribute);
        return attribute;
    }

  private:
    std::string transformed(const Varying& varying) {
        if (varying.name == "P")
            return rows_times(model_view, Type::vec3, varying.attribute, dialect_);
        if (varying.name == "uv") return mapped(varying.attribute);
        if (varying.name != "vertex_normal") return varying.attribute;
        add_uniforms(text_.uniforms, {normal_matrix});
        const std::string normal = normal_times(dialect_);
        if (request_.has_flat_meshes == 0) return normal;
        add_uniforms(text_.uniforms, {flat_faces});
        attributes_.read("face_normal");
        return dialect_.choice(dialect_.use_of(flat_faces, flat_faces.name) + " != 0.0",
                               "face_normal", normal);
    }
    std::string mapped(const std::string& coordinates) {
        add_uniforms(text_.uniforms, {texture_matrix});
        return rows_times(texture_matrix, Type::vec2,
                          dialect_.type(Type::vec3) + "(" + coordinates + ", 0.0)", dialect_);
    }

    const ProgramRequest& request_;
    VertexText& text_;
    Attributes& attributes_;
    const Dialect& dialect_;
};

VertexCall vertex_call(const VertexFunction& function, VertexValues& values,
                       const Attributes& attributes) {
    VertexCall call{function.name, {}, function.outputs, {}, false};
    for (const Named& input : function.inputs)
        call.arguments.push_back(values.argument(input.name));
    for (const Named& of : function.varyings) {
        call.varyings.push_back(of.name);
        call.is_needed |= !attributes.have(varying_of_program(of));
    }
    return call;
}

/// A shell's vertices are none of the mesh's: they are in eye space and in clip space as they come.
void take_shaded_vertices(const StageCalls& calls, VertexText& text, Attributes& attributes) {
    for (const FunctionText& function : calls.functions())
        if (function.vertex)
            throw RecordingError(function.name +
                                 ": computes at vertices, and shells have their own");
    for (const Varying& varying : text.varyings) {
        text.values.push_back({varying.shaded, varying.shaded});
        attributes.read(varying.shaded);
    }
    text.position = {"clip_position", "clip_position"};
}

}  // namespace

VertexText vertex_text(const ProgramRequest& request, const std::vector<Varying>& varyings,
                       const StageCalls& calls, const Dialect& dialect) {
    VertexText text;
    // The position in eye space is a varying in any case: it is what clip space is made of.
    text.varyings = varyings;
    std::erase_if(text.varyings, [](const Varying& of) { return of.name == "P"; });
    text.varyings.insert(text.varyings.begin(), *find_varying("P"));
    Attributes attributes(request);
    attributes.read("clip_position");
    if (request.draws_shells != 0) {
        take_shaded_vertices(calls, text, attributes);
        text.attributes = attributes.all();
        return text;
    }
    text.functions = row_functions(dialect);
    text.uniforms = {model_view, projection};
    VertexValues values(request, text, attributes, dialect);
    for (const Varying& varying : text.varyings) text.values.push_back(values.of(varying));
    std::string functions;
    for (const FunctionText& function : calls.functions()) {
        if (!function.vertex) continue;
        functions += function.vertex->text + "\n";
        add_uniforms(text.uniforms, function.vertex->uniforms);
        text.calls.push_back(vertex_call(*function.vertex, values, attributes));
    }
    text.functions += transform_functions(functions, dialect) + functions;
    text.attributes = attributes.all();
    text.position = {rows_times(projection, Type::vec4, "P", dialect), "clip_position"};
    return text;
}

}  // namespace quadrel::recorded
