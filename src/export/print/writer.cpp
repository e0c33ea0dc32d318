#include "export/print/writer.hpp"

#include <algorithm>
#include <climits>

#include "export/print/assignments.hpp"
#include "export/print/described.hpp"
#include "export/print/fold/fold.hpp"
#include "export/print/names.hpp"
#include "export/print/wrapped_line.hpp"

namespace quadrel::recorded {

using Kind = Node::Kind;

std::string Writer::function(const std::string& name, const std::vector<std::string>& inputs,
                             const std::vector<std::string>& taken) {
    names_.insert(name);
    names_.insert(taken.begin(), taken.end());
    for (const auto& loop : graph_.loops)
        if (!loop->index.empty()) names_.insert(loop->index);
    for (const Uniform& uniform : graph_.uniforms) names_.insert(uniform.name);
    choose_inputs(inputs);
    std::vector<Named> outputs = graph_.outputs;
    for (Named& output : outputs) {
        if (!dialect_.has_outputs()) break;  // members of a struct
        if (names_.count(output.name) != 0) {
            changed_outputs_.insert(output.name);
            output.name += "_out";
        }
        names_.insert(output.name);
    }
    out_ = dialect_.declarations(name, outputs) +
           wrapped_line(dialect_.head(name, inputs_, outputs)) + "\n";
    write_body(name);
    return out_;
}

std::string Writer::helper(const Helper& helper) {
    names_.insert(helper.name);
    for (const Uniform& uniform : graph_.uniforms) names_.insert(uniform.name);
    for (const Named& input : graph_.inputs) names_.insert(input.name);
    out_ = wrapped_line(dialect_.helper_head(helper.type, helper.name, graph_.inputs)) + "\n";
    region(graph_.top, 1);
    out_ += "}\n";
    return out_;
}

void Writer::write_body(const std::string& name) {
    write_parameters();
    if (const std::string first = dialect_.first_line(name); !first.empty()) line(1, first);
    region(graph_.top, 1);
    if (const std::string last = dialect_.last_line(); !last.empty()) line(1, last);
    out_ += "}\n";
}

void Writer::write_parameters() {
    for (const Parameter& of : graph_.parameters) {
        if (locals_.symbols().count(of.name) == 0) continue;
        const std::string value = of.type == Type::integer
                                      ? std::to_string(static_cast<std::int32_t>(of.value))
                                      : dialect_.real(static_cast<float>(of.value));
        out_ += commented_line("    " + dialect_.parameter(of.type, of.name, value), of.comment);
    }
}

void Writer::choose_inputs(const std::vector<std::string>& order) {
    for (const Named& input : graph_.inputs)
        if (locals_.symbols().count(input.name) != 0) inputs_.push_back(input);
    const auto rank = [&](const Named& of) {
        return std::find(order.begin(), order.end(), of.name) - order.begin();
    };
    std::stable_sort(inputs_.begin(), inputs_.end(),
                     [&](const Named& a, const Named& b) { return rank(a) < rank(b); });
    for (const Named& input : inputs_) names_.insert(input.name);
}

std::string Writer::unique(const std::string& hint, const char* otherwise) {
    return unique_name(hint, otherwise, names_);
}

// ---- Statements ---------------------------------------------------------------------------------

void Writer::line(int depth, const std::string& text) {
    out_ += wrapped_line(std::string(static_cast<std::size_t>(4 * depth), ' ') + text) + "\n";
}

void Writer::declare(const Node& node, int depth) {
    if (const Assignment* const at_once = locals_.assignment_of(&node)) {
        for (const std::string& comment : node.comments) line(depth, "// " + comment);
        Event event(Event::Kind::assign, node.order);
        event.assignments.push_back(*at_once);
        write_assignments(event, nullptr, depth);
        return expressions_.name(&node, name_of(at_once->variable));
    }
    std::string hint = node.name.empty() ? node.weak_name : node.name;
    std::string value;
    if (node.kind == Kind::read) {
        value = name_of(node.variable);
        hint = value + "_before";
    } else {
        value = expressions_.value(node);
        if (hint.empty()) hint = described(node);
    }
    for (const std::string& comment : node.comments) line(depth, "// " + comment);
    const char* const otherwise = node.type == Type::boolean   ? "is"
                                  : node.type == Type::integer ? "n"
                                                               : "t";
    const std::string name = unique(hint, otherwise);
    expressions_.name(&node, name);
    line(depth, dialect_.constant(node.type, name, value));
}

/// What a helper gives has no name.
void Writer::write_store(const Event& event, int depth) {
    const std::string value = text(event.value, choice_level);
    const bool is_changed = changed_outputs_.count(event.text) != 0;
    line(depth, event.text.empty()
                    ? "return " + value + ";"
                    : dialect_.store(event.text + (is_changed ? "_out" : ""), value));
}

void Writer::region(const Region& region, int depth) {
    std::vector<const Node*> locals;
    for (const auto& node : graph_.nodes)
        if (node->region == &region && locals_.is_needed(node.get()) &&
            locals_.is_declared(node.get()))
            locals.push_back(node.get());
    std::size_t next = 0;
    const auto declare_up_to = [&](int order) {
        for (; next < locals.size() && locals[next]->order < order; ++next)
            declare(*locals[next], depth);
    };
    for (std::size_t i = 0; i < region.events.size(); ++i) {
        const Event& event = region.events[i];
        declare_up_to(event.order);
        if (event.kind == Event::Kind::store) {
            write_store(event, depth);
        } else if (event.kind == Event::Kind::assign) {
            const bool leaves =
                i + 1 < region.events.size() && region.events[i + 1].kind == Event::Kind::leave;
            write_assignments(event, leaves ? &region.events[i + 1] : nullptr, depth);
        } else if (event.kind == Event::Kind::loop) {
            write_loop(*event.loop, depth);
        }
    }
    declare_up_to(INT_MAX);
}

// ---- Loops --------------------------------------------------------------------------------------

/// Conditions that hold in every round.
std::string Writer::guard_of(const Loop& loop) const {
    std::vector<std::string> guards;
    for (const auto& variable : loop.variables) {
        if (!variable->guards || is_literal(*variable->initial, 1)) continue;
        const std::string guard = text(variable->initial, and_operand_level);
        if (std::find(guards.begin(), guards.end(), guard) == guards.end()) guards.push_back(guard);
    }
    std::string all;
    for (const std::string& guard : guards) all += (all.empty() ? "" : " && ") + guard;
    return all;
}

namespace {

/// What the first value that a variable is given is; empty where that has no name either.
std::string described_by_assignments(const Region& region, const Variable* variable) {
    for (const Event& event : region.events) {
        for (const Assignment& of : event.assignments)
            if (of.variable == variable) {
                const Node& value = *of.value;
                return described(value.kind == Kind::select ? *value.arguments[1] : value);
            }
        const std::string inner = event.kind == Event::Kind::loop
                                      ? described_by_assignments(event.loop->body, variable)
                                      : std::string();
        if (!inner.empty()) return inner;
    }
    return "";
}

}  // namespace

void Writer::begin_variables(const Loop& loop, int depth) {
    for (const auto& variable : loop.variables) {
        if (!locals_.is_needed(variable.get())) continue;
        if (const Variable* const same = locals_.named_as(variable.get())) {
            expressions_.name(variable.get(), name_of(same));
            continue;
        }
        const Node& initial = *variable->initial;
        std::string hint;
        for (const std::string& name : variable->names)
            if (!name.empty()) hint = name;
        if (hint.empty()) hint = described(initial);
        if (hint.empty()) hint = described_by_assignments(loop.body, variable.get());
        const std::string name = unique(hint, "v");
        expressions_.name(variable.get(), name);
        line(depth, dialect_.variable(variable->type, name, text(&initial, choice_level)));
    }
}

std::string Writer::begin_of(const Loop& loop) const {
    if (loop.kind == Loop::Kind::block) return "if (" + text(loop.condition, choice_level) + ") {";
    if (loop.kind == Loop::Kind::rounds) return dialect_.endless_loop();
    return dialect_.counted_loop(loop.index, text(loop.first, choice_level), condition_of(loop));
}

/// `i <= last`, or `i < n` where `last` is n - 1.
std::string Writer::condition_of(const Loop& loop) const {
    const Node& last = *loop.last;
    const bool is_before = last.kind == Kind::binary && last.text == "-" &&
                           is_literal(*last.arguments[1], 1) && !expressions_.is_named(&last);
    if (is_before) return loop.index + " < " + text(last.arguments[0], sum_level);
    return loop.index + " <= " + text(&last, sum_level);
}

void Writer::write_loop(const Loop& loop, int depth) {
    const std::string guard = loop.kind == Loop::Kind::block ? "" : guard_of(loop);
    begin_variables(loop, depth);
    const std::string begin = begin_of(loop);
    if (!guard.empty()) line(depth++, "if (" + guard + ") {");
    line(depth, begin);
    region(loop.body, depth + 1);
    line(depth, "}");
    if (!guard.empty()) line(depth - 1, "}");
}

std::string Writer::leave_line(const Event& leave) const {
    if (const Variable* const condition = locals_.condition_of(&leave))
        return dialect_.guarded("if (!" + name_of(condition) + ")", "break;");
    const Node* const stay = leave.value;
    if (stay->kind == Kind::unary && stay->text == "!" && !expressions_.is_named(stay))
        return dialect_.guarded("if (" + text(stay->arguments[0], choice_level) + ")", "break;");
    return dialect_.guarded("if (!" + text(stay, unary_level) + ")", "break;");
}

// ---- Assignments --------------------------------------------------------------------------------

void Writer::write_groups(const std::vector<AssignmentGroup>& groups, bool independent, int depth) {
    std::string condition_before;
    for (const AssignmentGroup& group : groups) {
        if (group.condition == nullptr) {
            for (const std::string& text : group.lines) line(depth, text);
            condition_before.clear();
            continue;
        }
        const std::string condition = text(group.condition, choice_level);
        const bool is_else =
            independent && !condition_before.empty() &&
            (condition == "!" + condition_before || condition_before == "!" + condition) &&
            condition.find(' ') == std::string::npos;
        const std::string head = is_else ? "else" : "if (" + condition + ")";
        if (group.lines.size() == 1) {
            line(depth, dialect_.guarded(head, group.lines[0]));
        } else {
            line(depth, head + " {");
            for (const std::string& text : group.lines) line(depth + 1, text);
            line(depth, "}");
        }
        condition_before = condition;
    }
}

void Writer::write_assignments(const Event& event, const Event* leave, int depth) {
    std::vector<AssignmentGroup> groups = groups_of(event, expressions_);
    const bool independent = are_independent(event, expressions_);
    if (independent) {
        join_groups(groups);
        pair_groups(groups);
    }
    const bool is_out =
        leave != nullptr && independent && leaves_by_group(groups, *leave, locals_, expressions_);
    write_groups(groups, independent, depth);
    if (leave != nullptr && !is_out && !is_literal(*leave->value, 1))
        line(depth, leave_line(*leave));
}

}  // namespace quadrel::recorded
