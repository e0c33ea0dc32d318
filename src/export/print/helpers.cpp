#include "export/print/helpers.hpp"

#include <algorithm>
#include <cstdio>
#include <map>

#include "export/print/described.hpp"
#include "export/print/fold/fold.hpp"
#include "export/print/names.hpp"

namespace quadrel::recorded {

using Kind = Node::Kind;

namespace {

/// Fewer operations are said as soon as a call; more arguments are no help to a reader.
constexpr int least_size = 5, most_helpers = 12;
constexpr std::size_t most_arguments = 6;

/// A vector of literals, which is said wherever it stands.
bool is_constant(const Node& node) {
    return node.kind == Kind::construct &&
           std::all_of(node.arguments.begin(), node.arguments.end(),
                       [](const Node* of) { return of->kind == Kind::literal; });
}

bool is_operation(const Node& node) {
    return node.kind == Kind::unary || node.kind == Kind::binary || node.kind == Kind::call ||
           node.kind == Kind::select;
}

std::string name_of_result(const Node& node) {
    return node.weak_name.empty() ? node.name : node.weak_name;
}

/// `at` of at_x and at_y; empty where the names have nothing in common.
std::string common_stem(const std::string& a, const std::string& b) {
    const std::size_t end = a.rfind('_');
    return end != std::string::npos && end > 0 && b.rfind('_') == end &&
                   a.compare(0, end, b, 0, end) == 0
               ? a.substr(0, end)
               : "";
}

/// What an argument is called in all calls that name it, or what these names have in common; else
/// what it is in the first call.
template <class Cones>
std::string name_of_argument(const Cones& group, std::size_t i) {
    std::string name, first;
    for (const auto& of : group) {
        const std::string own = own_name(*of.arguments[i]);
        if (own.empty()) continue;
        if (first.empty()) first = name = own;
        if (own != name) name = common_stem(name, own);
        if (name.empty()) return first;
    }
    return name.empty() ? described(*group[0].arguments[i]) : name;
}

/// Likewise of what they give; of results of several axes what is in front of their letters.
template <class Cones>
std::string name_of_results(const Cones& group) {
    std::string name, first;
    for (const auto& of : group) {
        const std::string own = name_of_result(*of.root);
        if (own.empty()) continue;
        if (first.empty()) first = name = own;
        if (own != name) name = common_stem(name, own);
    }
    return name.empty() ? first : name;
}

/// What the first result's name ends in, and `name`, that of all, does not: `_x`.
std::string axis_of(const Node& first, const std::string& name) {
    const std::string own = name_of_result(first);
    return own.size() == name.size() + 2 && own.rfind(name, 0) == 0 ? own.substr(name.size()) : "";
}

std::string without(const std::string& axis, std::string name) {
    if (!axis.empty() && name.ends_with(axis)) name.resize(name.size() - axis.size());
    return name;
}

/// A function's graph, made of nodes of another. Its names do not end in `axis`.
class BodyCopy {
  public:
    BodyCopy(Graph& made, std::string axis) : made_(made), axis_(std::move(axis)) {}

    /// Stands for `of` from now on.
    void add_input(const Node& of, const std::string& name) {
        Node input;
        input.kind = Kind::symbol;
        input.type = of.type;
        input.text = name;
        made_.inputs.push_back({input.text, input.type});
        copies_[&of] = own(std::move(input));
    }
    /// What it is computed of and is not there yet are constants.
    void add(const Node& of) {
        Node node = of;
        for (Node*& argument : node.arguments) {
            if (copies_.count(argument) == 0) add(*argument);
            argument = copies_.at(argument);
        }
        node.name = without(axis_, node.name);
        node.weak_name = without(axis_, node.weak_name);
        copies_[&of] = own(std::move(node));
    }
    void store(const Node& of) {
        Node* const result = copies_.at(&of);
        result->name.clear();
        result->comments.clear();
        Event event(Event::Kind::store, static_cast<int>(made_.nodes.size()) + 1);
        event.value = result;
        made_.top.events.push_back(std::move(event));
    }

  private:
    Node* own(Node node) {
        node.region = &made_.top;
        node.order = static_cast<int>(made_.nodes.size()) + 1;
        made_.nodes.push_back(std::make_unique<Node>(std::move(node)));
        return made_.nodes.back().get();
    }

    Graph& made_;
    std::string axis_;
    std::unordered_map<const Node*, Node*> copies_;
};

}  // namespace

Helpers::Helpers(Graph& graph, const std::set<std::string>& wanted, const std::string& prefix)
    : graph_(graph) {
    for (int i = 0; i < most_helpers; ++i) {
        const Needs needs(graph, wanted);
        count_uses(needs);
        std::vector<Cone> group = best_group(needs);
        if (group.empty()) return;
        extract(group, prefix);
    }
}

void Helpers::count_uses(const Needs& needs) {
    uses_.clear();
    const auto of_region = [&](const auto& self, const Region& region) -> void {
        for (const Event& event : region.events) {
            if (event.value != nullptr) use(event.value);
            for (const Assignment& of : event.assignments)
                if (needs.is_needed(of.variable)) use(of.value);
            if (event.kind != Event::Kind::loop) continue;
            for (const Node* of : {event.loop->condition, event.loop->first, event.loop->last})
                if (of != nullptr) use(of);
            for (const auto& of : event.loop->variables)
                if (needs.is_needed(of.get()) || of->guards) use(of->initial);
            self(self, event.loop->body);
        }
    };
    of_region(of_region, graph_.top);
    for (const auto& node : graph_.nodes)
        if (needs.is_needed(node.get()))
            for (const Node* argument : node->arguments) use(argument);
}

/// What a helper knows without being told.
bool Helpers::is_global(const Node& node) const {
    if (node.kind == Kind::literal) return true;
    if (node.kind != Kind::symbol) return false;
    const std::string name = node.text.substr(0, node.text.find('['));
    return name.rfind("STATUS_", 0) == 0 || name.rfind("FLAG_", 0) == 0 ||
           std::any_of(graph_.uniforms.begin(), graph_.uniforms.end(),
                       [&](const Uniform& of) { return of.name == name; });
}

/// Differences of neighbours stay where all fragments come by.
bool Helpers::is_body(const Node& node, const Node& root) const {
    return !is_leaf(node) && !is_difference(node) && node.region == root.region;
}

std::set<const Node*> Helpers::alone_for(const Node& root) const {
    std::set<const Node*> body = {&root};
    std::unordered_map<const Node*, std::size_t> met;
    std::vector<const Node*> work = {&root};
    while (!work.empty()) {
        const Node* const node = work.back();
        work.pop_back();
        for (const Node* argument : node->arguments)
            if (++met[argument] == uses_.at(argument) && is_body(*argument, root) &&
                body.insert(argument).second)
                work.push_back(argument);
    }
    return body;
}

std::string Helpers::described(const Node* node, Cone& cone, const std::set<const Node*>& body,
                               std::unordered_map<const Node*, int>& known) const {
    char number[64];
    if (node->kind == Kind::literal) {
        std::snprintf(number, sizeof number, "%d:%a", static_cast<int>(node->type), node->value);
        return number;
    }
    if (is_constant(*node)) {
        std::string text = "[" + std::to_string(static_cast<int>(node->type));
        for (const Node* argument : node->arguments)
            text += " " + described(argument, cone, body, known);
        return text + "]";
    }
    if (is_global(*node)) return node->text;
    const auto found = known.find(node);
    if (found != known.end()) return "#" + std::to_string(found->second);
    const int id = static_cast<int>(known.size());
    known[node] = id;
    if (body.count(node) == 0) {
        cone.arguments.push_back(const_cast<Node*>(node));
        return "?" + std::to_string(static_cast<int>(node->type));
    }
    std::string text = "(" + std::to_string(static_cast<int>(node->kind)) + "," +
                       std::to_string(static_cast<int>(node->type)) + "," + node->text + "," +
                       std::to_string(node->index);
    for (const Node* argument : node->arguments)
        text += " " + described(argument, cone, body, known);
    cone.body.push_back(node);
    if (is_operation(*node)) ++cone.size;
    return text + ")";
}

Helpers::Cone Helpers::cone_of(Node* root) const {
    Cone cone{root, {}, {}, {}, 0};
    std::unordered_map<const Node*, int> known;
    cone.key = described(root, cone, alone_for(*root), known);
    return cone;
}

/// Where a helper saves the most.
std::vector<Helpers::Cone> Helpers::best_group(const Needs& needs) const {
    std::map<std::string, std::vector<Cone>> groups;
    for (const auto& node : graph_.nodes) {
        if (!needs.is_needed(node.get()) || !is_operation(*node) || is_difference(*node)) continue;
        Cone cone = cone_of(node.get());
        if (cone.size >= least_size && cone.arguments.size() <= most_arguments)
            groups[cone.key].push_back(std::move(cone));
    }
    std::vector<Cone> best;
    int most = 0;
    for (auto& [key, group] : groups) {
        const int saved = (static_cast<int>(group.size()) - 1) * group[0].size;
        const bool has_name = std::any_of(group.begin(), group.end(), [](const Cone& of) {
            return !name_of_result(*of.root).empty();
        });
        if (group.size() < 2 || !has_name || saved <= most) continue;
        most = saved;
        best = group;
    }
    return best;
}

void Helpers::extract(std::vector<Cone>& group, const std::string& prefix) {
    const Cone& first = group[0];
    auto helper = std::make_unique<Helper>();
    helper->type = first.root->type;
    helper->graph.uniforms = graph_.uniforms;
    const std::string name = name_of_results(group);
    helper->name = unique_name(prefix + "_" + name, "helper", names_);
    const std::string axis = axis_of(*first.root, name);
    BodyCopy copy(helper->graph, axis);
    std::set<std::string> inputs;
    for (const Uniform& of : graph_.uniforms) inputs.insert(of.name);
    for (std::size_t i = 0; i < first.arguments.size(); ++i) {
        const std::string letter(1, static_cast<char>('a' + i));
        copy.add_input(*first.arguments[i], unique_name(without(axis, name_of_argument(group, i)),
                                                        letter.c_str(), inputs));
    }
    for (const Node* of : first.body) copy.add(*of);
    copy.store(*first.root);
    for (const Cone& of : group) {
        of.root->kind = Kind::call;
        of.root->text = helper->name;
        of.root->index = 0;
        of.root->arguments = of.arguments;
    }
    all_.push_back(std::move(helper));
}

}  // namespace quadrel::recorded
