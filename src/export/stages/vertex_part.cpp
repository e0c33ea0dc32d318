#include "export/stages/vertex_part.hpp"

#include <algorithm>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "export/print/names.hpp"
#include "export/print/needs.hpp"
#include "export/stages/vertex_transforms.hpp"
#include "quadrel/num/shader/recorder.hpp"
#include "quadrel/quad/shader_io.hpp"

namespace quadrel::recorded {
namespace {

using Kind = Node::Kind;

bool is_attribute(const std::string& name) {
    for (const char* attribute :
         {vertex_attribute::position, vertex_attribute::normal, vertex_attribute::tangent,
          vertex_attribute::binormal, vertex_attribute::uv})
        if (name == attribute) return true;
    return false;
}

/// The component of a vector that an expression is, through vectors that are put together of these.
const Node* component_behind(const Node* node) {
    while (node->kind == Kind::component && node->arguments[0]->kind == Kind::construct &&
           node->index >= 0 &&
           static_cast<std::size_t>(node->index) < node->arguments[0]->arguments.size())
        node = node->arguments[0]->arguments[static_cast<std::size_t>(node->index)];
    return node;
}

/// What the text calls a varying: the name of a vector of its components, or of the function that
/// made it; else the first thing that is computed of it, "NAME_varying".
std::string name_in_text(const Graph& graph, const std::string& varying) {
    const auto is_varying = [&](const Node* of) {
        return of->kind == Kind::symbol && of->text == varying;
    };
    const auto is_component = [&](const Node* of) {
        const Node* const behind = component_behind(of);
        return behind->kind == Kind::component && is_varying(behind->arguments[0]);
    };
    std::unordered_set<const Node*> made_of_it;
    std::string by_function, of_result;
    for (const auto& node : graph.nodes) {
        const auto& arguments = node->arguments;
        if (!is_varying(node.get()) &&
            std::none_of(arguments.begin(), arguments.end(),
                         [&](const Node* of) { return made_of_it.count(of) != 0; }))
            continue;
        made_of_it.insert(node.get());
        const bool is_it = node->kind == Kind::construct &&
                           std::all_of(arguments.begin(), arguments.end(), is_component);
        if (is_it && !node->name.empty()) return node->name;
        // The word "varying" itself says nothing.
        const std::string name = node->name.empty() ? node->weak_name : node->name;
        if (name.empty() || name == "varying") continue;
        if (is_it) by_function = name;
        if (!is_it && of_result.empty()) of_result = name;
    }
    return !by_function.empty() || of_result.empty() ? by_function : of_result + "_varying";
}

void rename_varying(Graph& graph, AtVertices& of, const std::string& name) {
    for (const auto& node : graph.nodes)
        if (node->kind == Kind::symbol && node->text == of.name) node->text = name;
    for (Named& input : graph.inputs)
        if (input.name == of.name) input.name = name;
    of.name = name;
}

void name_varyings(Graph& graph, std::set<std::string> taken) {
    for (const Named& of : graph.inputs) taken.insert(of.name);
    for (const Named& of : graph.outputs) taken.insert(of.name);
    for (const Uniform& of : graph.uniforms) taken.insert(of.name);
    for (AtVertices& of : graph.at_vertices)
        rename_varying(graph, of, unique_name(name_in_text(graph, of.name), "varying", taken));
}

/// Name of the uniform that a symbol is, or is an element of.
std::string uniform_name(const std::string& symbol) { return symbol.substr(0, symbol.find('[')); }

/// Copies expressions from one recording into another.
class Copier {
  public:
    Copier(const Graph& from, Graph& to) : from_(from), to_(to) {}

    void want(const Node* node) {
        if (!wanted_.insert(node).second) return;
        check(*node);
        for (const Node* argument : node->arguments) want(argument);
    }

    /// In the order in which they were made.
    void copy() {
        for (const auto& node : from_.nodes) {
            if (wanted_.count(node.get()) == 0) continue;
            auto made = std::make_unique<Node>(*node);
            made->region = &to_.top;
            for (Node*& argument : made->arguments) argument = copies_.at(argument);
            copies_[node.get()] = made.get();
            declare(*made);
            to_.nodes.push_back(std::move(made));
        }
    }
    Node* copy_of(const Node* node) const { return copies_.at(node); }

  private:
    void check(const Node& node) const {
        if (node.kind == Kind::read)
            throw RecordingError("a vertex program reads what a loop has changed");
        if (node.kind == Kind::symbol && !is_attribute(node.text))
            for (const Named& input : from_.inputs)
                if (input.name == node.text)
                    throw RecordingError("a vertex program reads " + node.text +
                                         ", which fragments have");
    }

    /// Attributes, uniforms and parameters.
    void declare(const Node& symbol) {
        const auto add = [](auto& list, const auto& entry) {
            for (const auto& known : list)
                if (known.name == entry.name) return;
            list.push_back(entry);
        };
        if (const Uniform* const matrix = matrix_of_transform(symbol))
            return add(to_.uniforms, *matrix);
        if (symbol.kind != Kind::symbol) return;
        if (is_attribute(symbol.text)) return add(to_.inputs, Named{symbol.text, symbol.type});
        for (const Uniform& of : from_.uniforms)
            if (of.name == uniform_name(symbol.text)) add(to_.uniforms, of);
        for (const Parameter& of : from_.parameters)
            if (of.name == symbol.text) add(to_.parameters, of);
    }

    const Graph& from_;
    Graph& to_;
    std::unordered_set<const Node*> wanted_;
    std::unordered_map<const Node*, Node*> copies_;
};

/// Those that only the vertices read.
void drop_uniforms(Graph& graph, const Graph& vertex) {
    const Needs needs(graph, {});
    for (const auto& node : graph.nodes)
        if (needs.is_needed(node.get()) && matrix_of_transform(*node) != nullptr)
            throw RecordingError("asks for an object's matrices in fragments");
    std::set<std::string> read;
    for (const std::string& symbol : needs.symbols()) read.insert(uniform_name(symbol));
    std::erase_if(graph.uniforms, [&](const Uniform& of) {
        return read.count(of.name) == 0 &&
               std::any_of(vertex.uniforms.begin(), vertex.uniforms.end(),
                           [&](const Uniform& other) { return other.name == of.name; });
    });
}

}  // namespace

void take_vertex_part(Graph& graph, Graph& vertex, const std::vector<std::string>& taken) {
    if (graph.at_vertices.empty()) return;
    name_varyings(graph, {taken.begin(), taken.end()});
    Copier copier(graph, vertex);
    for (const AtVertices& of : graph.at_vertices) copier.want(of.value);
    copier.copy();
    int order = 0;
    for (const auto& node : vertex.nodes) order = std::max(order, node->order);
    for (const AtVertices& of : graph.at_vertices) {
        vertex.outputs.push_back({of.name, of.value->type});
        Event event(Event::Kind::store, ++order);
        event.value = copier.copy_of(of.value);
        event.text = of.name;
        vertex.top.events.push_back(std::move(event));
    }
    graph.at_vertices.clear();
    drop_uniforms(graph, vertex);
}

}  // namespace quadrel::recorded
