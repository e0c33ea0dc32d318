#include "export/print/fold/carried_vectors.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "export/print/described.hpp"
#include "export/print/needs.hpp"

namespace quadrel::recorded {

using Kind = Node::Kind;

namespace {

/// The vector whose components the numbers are, all of them and in order; null where there is none.
Node* whole_vector(const std::vector<Node*>& numbers) {
    if (numbers[0]->kind != Kind::component) return nullptr;
    Node* const vector = numbers[0]->arguments[0];
    if (vector->type != vector_of(static_cast<int>(numbers.size()))) return nullptr;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (numbers[i]->kind != Kind::component || numbers[i]->arguments[0] != vector ||
            numbers[i]->index != static_cast<int>(i))
            return nullptr;
    return vector;
}

/// Whether the numbers are a vector's, or what one condition chooses of a vector and others.
bool are_of_vector(const std::vector<Node*>& numbers) {
    if (whole_vector(numbers) != nullptr) return true;
    std::vector<Node*> sides[2];
    for (const Node* of : numbers) {
        if (of->kind != Kind::select || of->arguments[0] != numbers[0]->arguments[0]) return false;
        for (const std::size_t i : {0, 1}) sides[i].push_back(of->arguments[i + 1]);
    }
    return are_of_vector(sides[0]) || are_of_vector(sides[1]);
}

/// Where a variable of a loop is given its version 1, 2, ...: events of the loop's body.
std::vector<Event*> events_of(Loop& loop, const Variable* variable) {
    std::vector<Event*> events;
    for (Event& event : loop.body.events)
        for (const Assignment& of : event.assignments)
            if (of.variable == variable) events.push_back(&event);
    return events;
}

Assignment& assignment_of(Event& event, const Variable* variable) {
    return *std::find_if(event.assignments.begin(), event.assignments.end(),
                         [&](const Assignment& of) { return of.variable == variable; });
}

/// One loop's variables that become one.
class Joining {
  public:
    Joining(Graph& graph, Loop& loop, std::vector<Variable*> parts)
        : graph_(graph),
          loop_(loop),
          parts_(std::move(parts)),
          events_(events_of(loop, parts_[0])) {
        versions_.emplace_back();
        for (const Variable* of : parts_) versions_[0].push_back(of->initial);
        for (Event* event : events_) {
            versions_.emplace_back();
            for (const Variable* of : parts_)
                versions_.back().push_back(assignment_of(*event, of).value);
        }
    }

    /// Whether all are given values together, and those of a vector at least once.
    static bool is_vector(Graph& graph, Loop& loop, const std::vector<Variable*>& parts) {
        const std::vector<Event*> events = events_of(loop, parts[0]);
        for (const Variable* of : parts)
            if (of->type != Type::real || events.empty() || events_of(loop, of) != events)
                return false;
        const Joining joining(graph, loop, parts);
        return std::any_of(joining.versions_.begin(), joining.versions_.end(), are_of_vector);
    }

    std::unique_ptr<Variable> run() {
        auto vector = std::make_unique<Variable>();
        vector->type = type();
        vector->version_order = parts_[0]->version_order;
        vector->initial = value_of(0, loop_.outer, loop_.order);
        vector->names.push_back(own_name(*vector->initial));
        for (std::size_t i = 0; i < events_.size(); ++i) {
            Event& event = *events_[i];
            Node* const value = value_of(i + 1, &loop_.body, event.order);
            Assignment& first = assignment_of(event, parts_[0]);
            vector->names.push_back(own_name(*value));
            first.variable = vector.get();
            first.value = value;
            std::erase_if(event.assignments,
                          [&](const Assignment& of) { return is_part(of.variable); });
        }
        replace_reads(vector.get());
        return vector;
    }

  private:
    Type type() const { return vector_of(static_cast<int>(parts_.size())); }
    bool is_part(const Variable* variable) const {
        return std::find(parts_.begin(), parts_.end(), variable) != parts_.end();
    }

    /// The vector of a version's numbers, made just before `order` where there is none.
    Node* value_of(std::size_t version, Region* region, int order) {
        if (Node* const vector = whole_vector(versions_[version])) return vector;
        auto node = std::make_unique<Node>();
        node->kind = Kind::construct;
        node->type = type();
        node->arguments = versions_[version];
        node->region = region;
        node->order = order - 1;
        const auto at = std::find_if(graph_.nodes.begin(), graph_.nodes.end(),
                                     [&](const auto& of) { return of->order >= order; });
        return graph_.nodes.insert(at, std::move(node))->get();
    }

    /// Who has read a part reads the vector, and takes its component.
    void replace_reads(Variable* vector) {
        std::vector<std::unique_ptr<Node>> nodes;
        for (auto& node : graph_.nodes) {
            const auto part = node->kind == Kind::read
                                  ? std::find(parts_.begin(), parts_.end(), node->variable)
                                  : parts_.end();
            if (part != parts_.end()) {
                auto read = std::make_unique<Node>(*node);
                read->type = type();
                read->variable = vector;
                node->kind = Kind::component;
                node->index = static_cast<int>(part - parts_.begin());
                node->variable = nullptr;
                node->arguments = {read.get()};
                nodes.push_back(std::move(read));
            }
            nodes.push_back(std::move(node));
        }
        graph_.nodes = std::move(nodes);
    }

    Graph& graph_;
    Loop& loop_;
    std::vector<Variable*> parts_;  ///< x, y, ...
    std::vector<Event*> events_;
    std::vector<std::vector<Node*>> versions_;
};

bool join_one(Graph& graph, Loop& loop, const Needs& needs) {
    auto& variables = loop.variables;
    for (const std::size_t n : {4, 3, 2})
        for (std::size_t i = 0; i + n <= variables.size(); ++i) {
            std::vector<Variable*> parts;
            for (std::size_t j = 0; j < n; ++j) parts.push_back(variables[i + j].get());
            const bool are_needed =
                std::all_of(parts.begin(), parts.end(),
                            [&](const Variable* of) { return needs.is_needed(of); });
            if (!are_needed || !Joining::is_vector(graph, loop, parts)) continue;
            std::unique_ptr<Variable> vector = Joining(graph, loop, parts).run();
            const auto first = variables.begin() + static_cast<std::ptrdiff_t>(i);
            variables.erase(first + 1, first + static_cast<std::ptrdiff_t>(n));
            *first = std::move(vector);
            return true;
        }
    return false;
}

/// The recorder goes through objects from the last one to the first.
void put_in_order(Loop& loop) {
    std::reverse(loop.variables.begin(), loop.variables.end());
    for (Event& event : loop.body.events) {
        auto& all = event.assignments;
        for (std::size_t i = 0; 2 * i + 1 < all.size(); ++i)
            std::swap(all[i].order, all[all.size() - 1 - i].order);
        std::reverse(all.begin(), all.end());
        for (const Assignment& of : all)
            of.variable->version_order[static_cast<std::size_t>(of.version)] = of.order;
    }
}

}  // namespace

void join_carried_vectors(Graph& graph, const std::set<std::string>& wanted) {
    for (const auto& loop : graph.loops) put_in_order(*loop);
    const Needs needs(graph, wanted);
    // What one loop tells of its variables tells more of those of another.
    for (bool again = true; again;) {
        again = false;
        for (const auto& loop : graph.loops)
            while (join_one(graph, *loop, needs)) again = true;
    }
}

}  // namespace quadrel::recorded
