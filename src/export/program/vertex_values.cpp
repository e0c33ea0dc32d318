#include "export/program/vertex_values.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <unordered_map>

#include "export/program/stage_calls.hpp"
#include "export/stages/named_parameters.hpp"
#include "export/stages/recorded_stage.hpp"
#include "export/stages/vertex_part.hpp"
#include "export/stages/vertex_transforms.hpp"
#include "quadrel/num/math.hpp"

namespace quadrel::recorded {
namespace {

using Kind = Node::Kind;
using F = Quad<float>;  ///< four vertices at a time

/// Of a real number, a vector or a mask.
struct Result {
    std::array<F, 4> of{};
    Mask<F> mask{};

    template <int n>
    vec<n, F> vector() const {
        vec<n, F> v;
        for (int i = 0; i < n; ++i) v[i] = of[static_cast<std::size_t>(i)];
        return v;
    }
};

Result result_of(const F& x) { return {{x}, {}}; }
Result result_of(const Mask<F>& m) { return {{}, m}; }
template <int n>
Result result_of(const vec<n, F>& v) {
    Result result;
    for (int i = 0; i < n; ++i) result.of[static_cast<std::size_t>(i)] = v[i];
    return result;
}

[[noreturn]] void refuse(const std::string& what) {
    throw RecordingError("vertex programs are not run with " + what);
}

/// Where the four vertices are, and what the object has.
struct Place {
    const VertexRun& run;
    int first;

    F attribute(const float* values, int components, int component) const {
        F x;
        for (int lane = 0; lane < 4; ++lane)
            x.lane[lane] = values[std::min(first + lane, run.count - 1) * components + component];
        return x;
    }
    const float* uniform(const std::string& name) const {
        const float* const values = run.uniform(run.uniforms, name.c_str());
        if (values == nullptr) refuse(name);
        return values;
    }
    Result attribute(const float* values, int components) const {
        Result result;
        for (int i = 0; i < components; ++i)
            result.of[static_cast<std::size_t>(i)] = attribute(values, components, i);
        return result;
    }
};

Result value_of_symbol(const Node& node, const Place& at) {
    const VertexRun& run = at.run;
    if (node.text == vertex_attribute::position) return at.attribute(run.position, 3);
    if (node.text == vertex_attribute::normal) return at.attribute(run.normal, 3);
    if (node.text == vertex_attribute::tangent) return at.attribute(run.tangent, 3);
    if (node.text == vertex_attribute::binormal) return at.attribute(run.binormal, 3);
    if (node.text == vertex_attribute::uv) return at.attribute(run.uv, 2);
    const std::size_t bracket = node.text.find('[');
    const float* values = at.uniform(node.text.substr(0, bracket));
    if (bracket != std::string::npos) values += std::atoi(node.text.c_str() + bracket + 1);
    Result result;
    for (int i = 0; i < components_of(node.type); ++i)
        result.of[static_cast<std::size_t>(i)] = F(values[i]);
    return result;
}

Result binary(const Node& node, const Result& a, const Result& b) {
    if (node.arguments[0]->type == Type::boolean) {
        if (node.text == "&&") return result_of(a.mask & b.mask);
        if (node.text == "||") return result_of(a.mask | b.mask);
        refuse(node.text);
    }
    if (node.arguments[0]->type != Type::real) refuse("whole numbers");
    const F &x = a.of[0], &y = b.of[0];
    if (node.text == "+") return result_of(x + y);
    if (node.text == "-") return result_of(x - y);
    if (node.text == "*") return result_of(x * y);
    if (node.text == "/") return result_of(x / y);
    if (node.text == "<") return result_of(x < y);
    if (node.text == "<=") return result_of(x <= y);
    if (node.text == ">") return result_of(x > y);
    if (node.text == ">=") return result_of(x >= y);
    if (node.text == "==") return result_of(x == y);
    if (node.text == "!=") return result_of(x != y);
    refuse(node.text);
}

/// As VertexProgram has it.
Result transformed(const Node& node, const float* m, const vec3<F>& v) {
    const auto row3 = [&](int row) {
        return vec3<F>(F(m[4 * row]), F(m[4 * row + 1]), F(m[4 * row + 2]));
    };
    if (node.text == "normal_to_eye")
        return result_of<3>(row3(0) * v.x + row3(1) * v.y + row3(2) * v.z);
    const F w(node.text.starts_with("point") ? 1.0f : 0.0f);
    const auto row = [&](int r) { return dot(row3(r), v) + F(m[4 * r + 3]) * w; };
    return result_of<3>(vec3<F>(row(0), row(1), row(2)));
}

Result called(const Node& node, const std::vector<Result>& a, const Place& at) {
    if (const Uniform* const matrix = matrix_of_transform(node))
        return transformed(node, at.uniform(matrix->name), a[0].vector<3>());
    const Type type = node.arguments[0]->type;
    if (type == Type::vec3) {
        const vec3<F> v = a[0].vector<3>();
        if (node.text == "normalize") return result_of<3>(normalize(v));
        if (node.text == "length") return result_of(length(v));
        if (node.text == "dot") return result_of(dot(v, a[1].vector<3>()));
        if (node.text == "cross") return result_of<3>(cross(v, a[1].vector<3>()));
        if (node.text == "distance") return result_of(distance(v, a[1].vector<3>()));
    }
    if (type == Type::real) {
        const F& x = a[0].of[0];
        if (node.text == "sqrt") return result_of(sqrt(x));
        if (node.text == "inversesqrt") return result_of(inversesqrt(x));
        if (node.text == "abs") return result_of(abs(x));
        if (node.text == "sign") return result_of(sign(x));
        if (node.text == "min") return result_of(min(x, a[1].of[0]));
        if (node.text == "max") return result_of(max(x, a[1].of[0]));
        if (node.text == "clamp") return result_of(clamp(x, a[1].of[0], a[2].of[0]));
    }
    refuse(node.text);
}

Result chosen(const Node& node, const std::vector<Result>& a) {
    if (node.type == Type::boolean)
        return result_of((a[0].mask & a[1].mask) | ((!a[0].mask) & a[2].mask));
    Result result;
    for (std::size_t i = 0; i < static_cast<std::size_t>(components_of(node.type)); ++i)
        result.of[i] = select(a[0].mask, a[1].of[i], a[2].of[i]);
    return result;
}

Result constructed(const Node& node, const std::vector<Result>& a) {
    Result result;
    for (std::size_t i = 0; i < static_cast<std::size_t>(components_of(node.type)); ++i)
        result.of[i] = a[a.size() == 1 ? 0 : i].of[0];
    return result;
}

Result value_of(const Node& node, const std::vector<Result>& a, const Place& at) {
    switch (node.kind) {
        case Kind::literal:
            if (node.type == Type::boolean) return result_of(Mask<F>(node.value != 0));
            return result_of(F(static_cast<float>(node.value)));
        case Kind::symbol:
            return value_of_symbol(node, at);
        case Kind::unary:
            return node.text == "!" ? result_of(!a[0].mask) : result_of(-a[0].of[0]);
        case Kind::binary:
            return binary(node, a[0], a[1]);
        case Kind::call:
            return called(node, a, at);
        case Kind::select:
            return chosen(node, a);
        case Kind::component:
            return result_of(a[0].of[static_cast<std::size_t>(node.index)]);
        case Kind::construct:
            return constructed(node, a);
        case Kind::read:
            break;
    }
    refuse("loops");
}

/// All outputs of the vertex part at all vertices.
class VertexPart {
  public:
    VertexPart(const Graph& graph, const VertexRun& run) : graph_(graph), run_(run) {
        for (const Named& of : graph.outputs)
            outputs_.emplace_back(static_cast<std::size_t>(run.count * components_of(of.type)));
        for (int first = 0; first < run.count; first += 4) run_at({run, first});
    }

    void put(const std::string& prefix) const {
        for (std::size_t i = 0; i < outputs_.size(); ++i)
            run_.put(run_.to, (prefix + "_" + graph_.outputs[i].name).c_str(), outputs_[i].data(),
                     static_cast<std::int32_t>(outputs_[i].size()));
    }

  private:
    void run_at(const Place& at) {
        std::unordered_map<const Node*, Result> known;
        for (const auto& node : graph_.nodes) {
            std::vector<Result> arguments;
            for (const Node* argument : node->arguments) arguments.push_back(known.at(argument));
            known.emplace(node.get(), value_of(*node, arguments, at));
        }
        for (std::size_t i = 0; i < outputs_.size(); ++i)
            store(known.at(graph_.top.events[i].value), components_of(graph_.outputs[i].type), at,
                  outputs_[i]);
    }
    void store(const Result& result, int components, const Place& at, std::vector<float>& to) {
        for (int lane = 0; lane < std::min(4, run_.count - at.first); ++lane)
            for (int i = 0; i < components; ++i)
                to[static_cast<std::size_t>((at.first + lane) * components + i)] =
                    result.of[static_cast<std::size_t>(i)].lane[lane];
    }

    const Graph& graph_;
    const VertexRun& run_;
    std::vector<std::vector<float>> outputs_;
};

}  // namespace

void put_vertex_values(const VertexRun& run) {
    const ProgramRequest& program = *run.program;
    ShaderScene scene = scene_of(program);
    for (int i = 0; i < program.stage_count; ++i) {
        const StageUse& use = program.stages[i];
        const RecordedStage* const stage = find_recorded_stage(use.id);
        if (stage == nullptr || !stage->reads_vertices) continue;
        scene.light = light_of(use);
        std::vector<std::max_align_t> defaults(stage->params_size / sizeof(std::max_align_t) + 1);
        stage->make_params(defaults.data());
        Graph graph, vertex;
        stage->record(graph, scene, use.params != nullptr ? use.params : defaults.data());
        take_vertex_part(graph, vertex, NamedParameters(*stage, scene, use.params).names());
        VertexPart(vertex, run).put(as_word(use.id) + suffix_of(use));
    }
}

}  // namespace quadrel::recorded
