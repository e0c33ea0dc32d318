// Recording a text: which objects of the number type live, what loops change of them, and the graph
// that comes of it.
//
// An object holds a pointer to the node that it stands for, so copies cost nothing. Where a loop
// begins, every object that lives becomes a variable of the loop; where the body ends or may be
// left, those that hold another node than before are assigned. The body is run once.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "quadrel/num/shader/graph.hpp"

namespace quadrel::recorded {

/// Why a text cannot be recorded.
struct RecordingError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

class Recorder;

/// An object of the number type: one of a list of all that live.
class Handle {
  public:
    Node* node() const { return node_; }

  protected:
    explicit inline Handle(Node* node);
    Handle(const Handle& other) : Handle(other.node_) {}
    Handle& operator=(const Handle& other) {
        node_ = other.node_;
        return *this;
    }
    inline ~Handle();

  private:
    friend class Recorder;
    Node* node_;
    Handle *before_ = nullptr, *after_ = nullptr;
    std::uint64_t id_ = 0;
};

class Recorder {
  public:
    /// Texts that run on this thread are recorded into `graph` from now on, until the end of this
    /// object.
    explicit Recorder(Graph& graph) : outer_(current_), graph_(graph), region_(&graph.top) {
        current_ = this;
    }
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;
    ~Recorder() { current_ = outer_; }

    static Recorder& current() {
        if (current_ == nullptr) throw RecordingError("nothing is being recorded");
        return *current_;
    }

    Node* add(Node node) {
        for (const Node* argument : node.arguments)
            if (argument == nullptr) throw RecordingError("a value is used before it has one");
        node.region = region_;
        node.order = ++order_;
        graph_.nodes.push_back(std::make_unique<Node>(std::move(node)));
        return graph_.nodes.back().get();
    }

    Node* input(Type type, const std::string& name) {
        declare(graph_.inputs, Named{name, type}, &Named::name);
        return symbol(type, name);
    }
    /// What fragments have of `value`, which is computed at the vertices, under a name of its own.
    Node* interpolated(Node* value) {
        if (value == nullptr) throw RecordingError("a varying has no value at the vertices");
        if (!open_.empty()) throw RecordingError("a vertex program runs in a loop or a block");
        const std::string name = "varying_" + std::to_string(graph_.at_vertices.size());
        graph_.at_vertices.push_back({value, name});
        return input(value->type, name);
    }
    Node* uniform(Type type, const Uniform& uniform, const std::string& text) {
        declare(graph_.uniforms, uniform, &Uniform::name);
        // Whose size alone was asked for before may be an array.
        for (Uniform& known : graph_.uniforms)
            if (known.name == uniform.name && uniform.type != "sampler2D")
                known.type = uniform.type;
        return symbol(type, text);
    }
    Node* uniform(Type type, const Uniform& of) { return uniform(type, of, of.name); }
    Node* symbol(Type type, const std::string& text) {
        Node node;
        node.kind = Node::Kind::symbol;
        node.type = type;
        node.text = text;
        return add(std::move(node));
    }

    void output(Node* value, const std::string& name) {
        if (value == nullptr) throw RecordingError(name + " is stored before it has a value");
        if (!open_.empty()) throw RecordingError(name + " is stored in a loop or a block");
        graph_.outputs.push_back({name, value->type});
        Event event(Event::Kind::store, ++order_);
        event.value = value;
        event.text = name;
        region_->events.push_back(std::move(event));
    }

    Loop* begin_steps(Node* first, Node* last) {
        Loop* const loop = begin(Loop::Kind::steps, nullptr);
        loop->index = std::string(1, static_cast<char>('i' + steps_open_++));
        loop->first = first;
        loop->last = last;
        return loop;
    }
    Loop* begin_rounds() { return begin(Loop::Kind::rounds, nullptr); }
    Loop* begin_block(Node* condition) { return begin(Loop::Kind::block, condition); }

    /// The way out of a loop: on only where `stay`.
    void leave_unless(Node* stay) {
        if (open_.empty()) throw RecordingError("none() outside of a loop");
        if (open_.back().loop->kind == Loop::Kind::block)
            throw RecordingError("a loop is left in a block");
        assign_changed(stay, false);
        Event event(Event::Kind::leave, ++order_);
        event.value = stay;
        region_->events.push_back(std::move(event));
    }

    void end_loop() {
        assign_changed(nullptr, true);
        Open open = std::move(open_.back());
        open_.pop_back();
        if (open.loop->kind == Loop::Kind::steps) --steps_open_;
        region_ = open.loop->outer;
        for (const OpenVariable& of : open.variables) of.handle->node_ = after(of.variable);
        // What had no value before the loop has none after it.
        for (Handle* handle = first_; handle != nullptr; handle = handle->after_)
            if (handle->id_ <= open.ids && !open.has(handle)) handle->node_ = nullptr;
    }

  private:
    friend class Handle;

    struct OpenVariable {
        Handle* handle;
        Variable* variable;
    };
    struct Open {
        Loop* loop;
        std::uint64_t ids;  ///< objects up to this one lived before
        std::vector<OpenVariable> variables;

        bool has(const Handle* handle) const {
            return std::any_of(variables.begin(), variables.end(),
                               [&](const OpenVariable& of) { return of.handle == handle; });
        }
    };

    /// An object that ends in a loop, so that no other round has it.
    void forget(const Handle* handle) {
        for (Open& open : open_)
            if (handle->id_ <= open.ids)
                std::erase_if(open.variables,
                              [&](const OpenVariable& of) { return of.handle == handle; });
    }

    template <class List, class Entry, class Name>
    static void declare(List& list, const Entry& entry, Name name) {
        for (const auto& known : list)
            if (known.*name == entry.*name) return;
        list.push_back(entry);
    }

    Loop* begin(Loop::Kind kind, Node* condition) {
        graph_.loops.push_back(std::make_unique<Loop>());
        Loop* const loop = graph_.loops.back().get();
        loop->kind = kind;
        loop->condition = condition;
        loop->outer = region_;
        loop->order = ++order_;
        loop->body.parent = region_;
        Event event(Event::Kind::loop, loop->order);
        event.loop = loop;
        region_->events.push_back(std::move(event));
        region_ = &loop->body;
        Open open{loop, ids_, {}};
        for (Handle* handle = first_; handle != nullptr; handle = handle->after_)
            if (handle->node_ != nullptr) open.variables.push_back(enter(*loop, *handle));
        open_.push_back(std::move(open));
        return loop;
    }

    OpenVariable enter(Loop& loop, Handle& handle) {
        auto variable = std::make_unique<Variable>();
        variable->type = handle.node_->type;
        variable->initial = handle.node_;
        variable->names.push_back(name_of(handle.node_));
        variable->guards = loop.condition != nullptr && handle.node_ == loop.condition;
        handle.node_ = variable->now = read(variable.get());
        loop.variables.push_back(std::move(variable));
        return {&handle, loop.variables.back().get()};
    }

    Node* read(Variable* variable) {
        Node node;
        node.kind = Node::Kind::read;
        node.type = variable->type;
        node.variable = variable;
        node.index = static_cast<int>(variable->version_order.size()) - 1;
        return add(std::move(node));
    }

    /// What a variable holds behind its loop.
    Node* after(Variable* variable) {
        return variable->version_order.size() == 1 ? variable->initial : read(variable);
    }

    /// Gives the loop's variables what has changed. `stay` is true from here on.
    void assign_changed(const Node* stay, bool at_end) {
        Event event(Event::Kind::assign, ++order_);
        for (const OpenVariable& of : open_.back().variables) {
            Variable* const variable = of.variable;
            Node* const value = of.handle->node_;
            if (value == nullptr) throw RecordingError("a loop takes a value away");
            const bool stays = stay != nullptr && value == stay;
            if (value == variable->now) {
                if (at_end && variable->type == Type::boolean && value->is_true)
                    variable->guards = true;
                if (!stays) continue;
            } else {
                const int version = static_cast<int>(variable->version_order.size());
                variable->version_order.push_back(++order_);
                variable->names.push_back(name_of(value));
                event.assignments.push_back({variable, value, version, order_});
            }
            of.handle->node_ = variable->now = read(variable);
            variable->now->is_true = stays;
        }
        region_->events.push_back(std::move(event));
    }

    static std::string name_of(const Node* node) {
        if (!node->name.empty()) return node->name;
        if (node->kind == Node::Kind::read)
            for (auto i = node->variable->names.rbegin(); i != node->variable->names.rend(); ++i)
                if (!i->empty()) return *i;
        return node->weak_name;
    }

    inline static thread_local Recorder* current_ = nullptr;
    Recorder* outer_;
    Graph& graph_;
    Region* region_;
    int order_ = 0, steps_open_ = 0;
    Handle* first_ = nullptr;
    std::uint64_t ids_ = 0;
    std::vector<Open> open_;
};

inline Handle::Handle(Node* node) : node_(node) {
    Recorder* const recorder = Recorder::current_;
    if (recorder == nullptr) return;
    id_ = ++recorder->ids_;
    after_ = recorder->first_;
    if (after_ != nullptr) after_->before_ = this;
    recorder->first_ = this;
}
inline Handle::~Handle() {
    Recorder* const recorder = Recorder::current_;
    if (recorder == nullptr) return;
    recorder->forget(this);
    if (before_ != nullptr)
        before_->after_ = after_;
    else if (recorder->first_ == this)
        recorder->first_ = after_;
    if (after_ != nullptr) after_->before_ = before_;
}

}  // namespace quadrel::recorded
