#include "export/print/writer.hpp"

#include <algorithm>
#include <climits>
#include <cmath>

#include "export/print/described.hpp"
#include "export/print/fold.hpp"
#include "export/print/names.hpp"
#include "export/print/wrapped_line.hpp"

namespace quadrel::recorded {

using Kind = Node::Kind;

namespace {

/// How weakly operators bind.
constexpr int unary_level = 2, or_level = 13, choice_level = 14;

int level_of_operator(const std::string& text) {
    struct Row {
        const char* text;
        int level;
    };
    static constexpr Row rows[] = {{"*", 3}, {"/", 3}, {"+", 4},  {"-", 4},  {"<<", 5}, {">>", 5},
                                   {"<", 6}, {">", 6}, {"<=", 6}, {">=", 6}, {"==", 7}, {"!=", 7},
                                   {"&", 8}, {"^", 9}, {"|", 10}, {"&&", 11}};
    for (const Row& row : rows)
        if (text == row.text) return row.level;
    return or_level;
}

}  // namespace

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
        const std::string constant = dialect_.parameter(of.type, of.name, value);
        if (constant.size() + of.comment.size() < 90) {
            out_ += "    " + constant + "  // " + of.comment + "\n";
        } else {
            line(1, "// " + of.comment);
            line(1, constant);
        }
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

// ---- Expressions --------------------------------------------------------------------------------

int Writer::level_of(const Node& node) const {
    if (node.kind == Kind::literal) return std::signbit(node.value) ? unary_level : 0;
    if (node.kind == Kind::unary) return unary_level;
    if (node.kind == Kind::select) return dialect_.chooses_by_function() ? 0 : choice_level;
    return node.kind == Kind::binary ? level_of_operator(node.text) : 0;
}

/// A uniform, or whatever else has a name of its own.
std::string Writer::symbol(const Node& node) const {
    const std::string name = node.text.substr(0, node.text.find('['));
    for (const Uniform& uniform : graph_.uniforms)
        if (uniform.name == name) return dialect_.use_of(uniform, node.text);
    return node.text;
}

std::string Writer::operands(const Node& node, int level) const {
    const Node &a = *node.arguments[0], &b = *node.arguments[1];
    const auto operand = [&](const Node& of, int within) {
        return text(
            &of, local_names_.count(&of) != 0 ? within : dialect_.operand_level(node, of, within));
    };
    const bool is_shift = node.text == "<<" || node.text == ">>";
    const std::string right = operand(b, level - 1);
    return operand(a, level) + " " + node.text + " " +
           (is_shift ? dialect_.shift_count(b, right) : right);
}

std::string Writer::text(const Node* node, int within) const {
    const auto name = local_names_.find(node);
    if (name != local_names_.end()) return name->second;
    const int level = level_of(*node);
    const std::string bare_text = bare(*node, level);
    return level > within ? "(" + bare_text + ")" : bare_text;
}

std::string Writer::literal(const Node& node) const {
    if (node.type == Type::boolean) return node.value != 0 ? "true" : "false";
    if (node.type == Type::integer) return std::to_string(static_cast<std::int32_t>(node.value));
    return dialect_.real(static_cast<float>(node.value));
}

std::string Writer::name_of(const Variable* variable) const {
    const auto found = variable_names_.find(variable);
    return found != variable_names_.end() ? found->second : "?";
}

std::string Writer::bare(const Node& node, int level) const {
    const auto& arguments = node.arguments;
    const auto all = [&] {
        std::vector<std::string> texts;
        for (const Node* argument : arguments) texts.push_back(text(argument, choice_level));
        return texts;
    };
    switch (node.kind) {
        case Kind::literal:
            return literal(node);
        case Kind::symbol:
            return symbol(node);
        case Kind::read:
            return name_of(node.variable);
        case Kind::unary:
            return node.text + text(arguments[0], unary_level - 1);
        case Kind::binary:
            return operands(node, level);
        case Kind::select:
            return dialect_.choice(text(arguments[0], or_level), text(arguments[1], or_level),
                                   text(arguments[2], choice_level));
        case Kind::component:
            if (node.index < 0) return dialect_.prefix(text(arguments[0], 0), -node.index);
            return text(arguments[0], 0) + "." + "xyzw"[node.index];
        case Kind::construct: {
            Node named = node;
            named.text = dialect_.type(node.type);
            return dialect_.call(named, all());
        }
        case Kind::call:
            break;
    }
    return dialect_.call(node, all());
}

// ---- Statements ---------------------------------------------------------------------------------

void Writer::line(int depth, const std::string& text) {
    out_ += wrapped_line(std::string(static_cast<std::size_t>(4 * depth), ' ') + text) + "\n";
}

void Writer::declare(const Node& node, int depth) {
    std::string hint = node.name.empty() ? node.weak_name : node.name;
    std::string value;
    if (node.kind == Kind::read) {
        value = name_of(node.variable);
        hint = value + "_before";
    } else {
        value = bare(node, level_of(node));
        if (hint.empty()) hint = described(node);
    }
    for (const std::string& comment : node.comments) line(depth, "// " + comment);
    const char* const otherwise = node.type == Type::boolean   ? "is"
                                  : node.type == Type::integer ? "n"
                                                               : "t";
    const std::string name = unique(hint, otherwise);
    local_names_[&node] = name;
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
        const std::string guard = text(variable->initial, 10);
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
        if (const Variable* const same = locals_.continued(variable.get())) {
            variable_names_[variable.get()] = name_of(same);
            continue;
        }
        const Node& initial = *variable->initial;
        const bool is_last =
            initial.kind == Kind::read && locals_.uses_of(&initial) == 1 &&
            !locals_.is_declared(&initial) && variable_names_.count(initial.variable) != 0 &&
            initial.index == static_cast<int>(initial.variable->version_order.size()) - 1;
        if (is_last) {
            variable_names_[variable.get()] = name_of(initial.variable);
            continue;
        }
        std::string hint;
        for (const std::string& name : variable->names)
            if (!name.empty()) hint = name;
        if (hint.empty()) hint = described(initial);
        if (hint.empty()) hint = described_by_assignments(loop.body, variable.get());
        const std::string name = unique(hint, "v");
        variable_names_[variable.get()] = name;
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
    constexpr int sum_level = 4;
    const Node& last = *loop.last;
    const bool is_before = last.kind == Kind::binary && last.text == "-" &&
                           is_literal(*last.arguments[1], 1) && local_names_.count(&last) == 0;
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
    if (stay->kind == Kind::unary && stay->text == "!" && local_names_.count(stay) == 0)
        return dialect_.guarded("if (" + text(stay->arguments[0], choice_level) + ")", "break;");
    return dialect_.guarded("if (!" + text(stay, unary_level) + ")", "break;");
}

// ---- Assignments --------------------------------------------------------------------------------

/// v = c ? x : v and v = v || c are conditional.
std::vector<Writer::Group> Writer::groups_of(const Event& event) const {
    std::vector<Group> groups;
    for (const Assignment& of : event.assignments) {
        const Node& value = *of.value;
        const std::string name = name_of(of.variable);
        const auto is_old = [&](const Node* node) {
            return node->kind == Kind::read && node->variable == of.variable &&
                   node->index == of.version - 1 && local_names_.count(node) == 0;
        };
        const bool is_open = local_names_.count(&value) == 0;
        const Node* condition = nullptr;
        std::string assigned;
        if (is_open && value.kind == Kind::select && is_old(value.arguments[2])) {
            condition = value.arguments[0];
            assigned = text(value.arguments[1], choice_level);
        } else if (is_open && value.kind == Kind::binary && value.text == "||" &&
                   is_old(value.arguments[0])) {
            condition = value.arguments[1];
            assigned = "true";
        } else {
            assigned = text(&value, choice_level);
            if (assigned == name) continue;
        }
        if (groups.empty() || groups.back().condition != condition)
            groups.push_back({condition, {}});
        groups.back().lines.push_back(name + " = " + assigned + ";");
    }
    return groups;
}

/// Whether the text of `node` reads the variable.
bool Writer::touches(const Node* node, const Variable* variable) const {
    if (local_names_.count(node) != 0) return false;
    if (node->kind == Kind::read) return name_of(node->variable) == name_of(variable);
    return std::any_of(node->arguments.begin(), node->arguments.end(),
                       [&](const Node* argument) { return touches(argument, variable); });
}

bool Writer::are_independent(const Event& event) const {
    for (const Assignment& a : event.assignments)
        for (const Assignment& b : event.assignments)
            if (&a != &b && touches(a.value, b.variable)) return false;
    return true;
}

void Writer::join_groups(std::vector<Group>& groups) {
    for (std::size_t i = 0; i < groups.size(); ++i) {
        for (std::size_t j = i + 1; j < groups.size();) {
            if (groups[j].condition != groups[i].condition) {
                ++j;
                continue;
            }
            groups[i].lines.insert(groups[i].lines.end(), groups[j].lines.begin(),
                                   groups[j].lines.end());
            groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(j));
        }
    }
}

/// Puts the way out into the group of its condition, which then comes last.
bool Writer::leaves_by_group(std::vector<Group>& groups, const Event& leave) const {
    const Node* const stay = leave.value;
    if (locals_.condition_of(&leave) != nullptr || stay->kind != Kind::unary || stay->text != "!" ||
        local_names_.count(stay) != 0)
        return false;
    const auto found = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
        return group.condition == stay->arguments[0];
    });
    if (found == groups.end()) return false;
    found->lines.emplace_back("break;");
    std::rotate(found, found + 1, groups.end());
    return true;
}

void Writer::write_groups(const std::vector<Group>& groups, bool independent, int depth) {
    std::string condition_before;
    for (const Group& group : groups) {
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
    std::vector<Group> groups = groups_of(event);
    const bool independent = are_independent(event);
    if (independent) join_groups(groups);
    const bool is_out = leave != nullptr && independent && leaves_by_group(groups, *leave);
    write_groups(groups, independent, depth);
    if (leave != nullptr && !is_out && !is_literal(*leave->value, 1))
        line(depth, leave_line(*leave));
}

}  // namespace quadrel::recorded
