#include "export/stages/named_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>

#include "export/print/dialect.hpp"
#include "export/stages/parameter_forms.hpp"
#include "export/stages/same_shape.hpp"
#include "export/stages/stage_text.hpp"

namespace quadrel::recorded {
namespace {

using Kind = Node::Kind;

/// Values that no default has, the last one below all of them.
std::vector<double> odd_values(const ParameterText& text) {
    const double range = text.maximum - text.minimum;
    std::vector<double> values;
    for (const double part : {0.30078125, 0.61328125, 0.0}) {
        double value = text.minimum + std::min(range, 4096.0) * part;
        if (part == 0) value += text.integer ? 2 : std::min(range, 4.0) * 0.0087890625;
        values.push_back(static_cast<float>(text.integer ? std::floor(value) : value));
    }
    return values;
}

/// Whether a literal has the value that forms give for a parameter's.
bool fits(const Node& literal, bool is_whole, double parameter, int whole, int real) {
    if (literal.type == Type::integer)
        return whole_forms()[static_cast<std::size_t>(whole)].value(static_cast<std::int32_t>(
                   parameter)) == static_cast<std::int32_t>(literal.value);
    float x = static_cast<float>(parameter);
    if (is_whole)
        x = static_cast<float>(whole_forms()[static_cast<std::size_t>(whole)].value(
            static_cast<std::int32_t>(parameter)));
    const float value = real_forms()[static_cast<std::size_t>(real)].value(x);
    const float found = static_cast<float>(literal.value);
    return value == found && std::signbit(value) == std::signbit(found);
}

/// The expression that forms give for a symbol.
Node* expression(Type of_literal, bool is_whole, Node* symbol, int whole, int real) {
    const auto& whole_form = whole_forms()[static_cast<std::size_t>(whole)];
    const auto& real_form = real_forms()[static_cast<std::size_t>(real)];
    if (!is_whole) return real_form.text(Shader(symbol)).node();
    const ShaderInt n = whole_form.text(ShaderInt(symbol));
    if (of_literal == Type::integer) return n.node();
    return real_form.text(to_float<Shader>(n)).node();
}

/// The shortest digits.
std::string number(double value) {
    char text[40];
    for (int digits = 1; digits < 18; ++digits) {
        std::snprintf(text, sizeof text, "%.*g", digits, value);
        if (std::strtod(text, nullptr) == value) break;
    }
    return text;
}

/// "steps along the ray; 1 to 4096, default 32"
std::string comment(const ParameterText& text, bool has_least, bool has_most) {
    return std::string(text.meaning) + "; " + (has_least ? "" : "above ") + number(text.minimum) +
           " to " + (has_most ? "" : "below ") + number(text.maximum) + ", default " +
           number(text.default_value);
}

}  // namespace

NamedParameters::NamedParameters(const RecordedStage& stage, const ShaderScene& scene,
                                 const void* params)
    : stage_(stage), scene_(scene), params_(stage.params_size / sizeof(std::max_align_t) + 1) {
    if (params != nullptr)
        std::memcpy(params_.data(), params, stage.params_size);
    else
        stage.make_params(params_.data());
    for (int i = 0; i < stage.parameter_count; ++i) {
        const std::string name = as_word(stage.parameters[i].name);
        names_.push_back(is_reserved(name) ? name + "_" : name);
    }
}

NamedParameters::Params NamedParameters::with(int parameter, double value) const {
    Params params = params_;
    stage_.parameters[parameter].set(params.data(), value);
    return params;
}

/// Whether the parameter has that value.
bool NamedParameters::is_value(int parameter, double value) const {
    return std::memcmp(with(parameter, value).data(), params_.data(), stage_.params_size) == 0;
}

/// The parameter's value, as far as trying finds it.
std::optional<double> NamedParameters::value_of(int parameter) const {
    const ParameterText& text = stage_.parameters[parameter];
    if (is_value(parameter, text.default_value)) return text.default_value;
    if (!text.integer || text.maximum - text.minimum > 1e6) return std::nullopt;
    for (double value = text.minimum; value <= text.maximum; ++value)
        if (is_value(parameter, value)) return value;
    return std::nullopt;
}

/// False where the text cannot be recorded with that value.
bool NamedParameters::records(Graph& graph, int parameter, double value) const {
    try {
        stage_.record(graph, scene_, with(parameter, value).data());
        return true;
    } catch (const RecordingError&) {
        return false;
    }
}

// ---- Where a parameter is -----------------------------------------------------------------------

std::optional<NamedParameters::Places> NamedParameters::places_of(int parameter,
                                                                  const Graph& graph) const {
    const ParameterText& text = stage_.parameters[parameter];
    const std::vector<double> odd = odd_values(text);
    // A choice, and what has few values, is decided by branches.
    if (text.value_names != nullptr || std::fabs(odd[1] - odd[0]) < (text.integer ? 3 : 0))
        return std::nullopt;
    std::vector<Graph> others(odd.size());
    for (std::size_t k = 0; k < odd.size(); ++k)
        if (!records(others[k], parameter, odd[k]) || !have_same_shape(graph, others[k]))
            return std::nullopt;
    const auto fits_all = [&](std::size_t node, int whole, int real) {
        for (std::size_t k = 0; k < odd.size(); ++k)
            if (!fits(*others[k].nodes[node], text.integer, odd[k], whole, real)) return false;
        return true;
    };
    Places places{{}, true, true};
    for (std::size_t node = 0; node < graph.nodes.size(); ++node) {
        const Node& literal = *graph.nodes[node];
        if (std::all_of(others.begin(), others.end(), [&](const Graph& other) {
                return have_same_value(*other.nodes[node], *others[0].nodes[node]);
            })) {
            // What is the same for all but this value is decided by it.
            if (!have_same_value(literal, *others[0].nodes[node])) return std::nullopt;
            continue;
        }
        bool found = false;
        for (int whole = 0; !found && whole < std::ssize(whole_forms()); ++whole)
            for (int real = 0; !found && real < std::ssize(real_forms()); ++real)
                if (fits_all(node, whole, real)) {
                    places.all.push_back({node, whole, real});
                    found = true;
                }
        if (!found) return std::nullopt;
    }
    const auto has_end = [&](double value) {
        Graph end;
        return records(end, parameter, value) && have_same_shape(graph, end) &&
               std::all_of(places.all.begin(), places.all.end(), [&](const Place& place) {
                   return fits(*end.nodes[place.node], text.integer, value, place.whole,
                               place.real);
               });
    };
    places.has_least = has_end(text.minimum);
    places.has_most = has_end(text.maximum);
    return places;
}

/// The parameter's value where all literals are what it gives.
std::optional<double> NamedParameters::value_at(int parameter, const Graph& graph,
                                                const Places& places) const {
    std::optional<double> value = value_of(parameter);
    for (const Place& place : places.all)
        if (!value && place.whole == 0 && place.real == 0) value = graph.nodes[place.node]->value;
    const bool is_whole = stage_.parameters[parameter].integer;
    for (const Place& place : places.all) {
        const Node& literal = *graph.nodes[place.node];
        if (!value || literal.kind != Kind::literal ||
            !fits(literal, is_whole, *value, place.whole, place.real))
            return std::nullopt;
    }
    return value;
}

// ---- Recording ----------------------------------------------------------------------------------

/// Writes expressions of the parameter in the places of literals.
void NamedParameters::put(int parameter, const Places& places, Graph& graph, Nodes& made) const {
    const bool is_whole = stage_.parameters[parameter].integer;
    const std::string& name = names_[static_cast<std::size_t>(parameter)];
    for (const Place& place : places.all) {
        Node& literal = *graph.nodes[place.node];
        Graph parts;
        {
            const Recorder recorder(parts);
            Node* const symbol =
                Recorder::current().symbol(is_whole ? Type::integer : Type::real, name);
            Node root = *expression(literal.type, is_whole, symbol, place.whole, place.real);
            root.region = literal.region;
            root.order = literal.order;
            root.name = literal.name;
            root.comments = literal.comments;
            root.weak_name = literal.weak_name;
            literal = std::move(root);
        }
        for (auto& node : parts.nodes) {
            node->region = &graph.top;
            node->order = 0;
            made.push_back(std::move(node));
        }
    }
}

void NamedParameters::record(Graph& graph) const {
    stage_.record(graph, scene_, params_.data());
    std::vector<std::pair<int, Places>> found;
    for (int p = 0; p < stage_.parameter_count; ++p)
        if (auto places = places_of(p, graph); places && !places->all.empty())
            found.emplace_back(p, std::move(*places));
    Nodes made;
    for (const auto& [p, places] : found) {
        const ParameterText& text = stage_.parameters[p];
        const std::optional<double> value = value_at(p, graph, places);
        if (!value) continue;
        put(p, places, graph, made);
        graph.parameters.push_back({names_[static_cast<std::size_t>(p)],
                                    text.integer ? Type::integer : Type::real, *value,
                                    comment(text, places.has_least, places.has_most)});
    }
    graph.nodes.insert(graph.nodes.begin(), std::make_move_iterator(made.begin()),
                       std::make_move_iterator(made.end()));
}

// ---- What stays a number ------------------------------------------------------------------------

/// Whether the text is another one with other values of the parameter.
bool NamedParameters::changes(int parameter, const Graph& graph) const {
    const ParameterText& text = stage_.parameters[parameter];
    std::vector<double> values = odd_values(text);
    values.push_back(text.maximum);
    if (text.value_names != nullptr) values.clear();
    for (const ValueName& of : value_names(text)) values.push_back(of.value);
    return std::any_of(values.begin(), values.end(), [&](double value) {
        Graph other;
        return !records(other, parameter, std::min(value, text.maximum)) ||
               !are_equal(graph, other);
    });
}

std::string NamedParameters::written_in(const Graph& graph) const {
    Graph plain;
    stage_.record(plain, scene_, params_.data());
    std::string all;
    for (int p = 0; p < stage_.parameter_count; ++p) {
        const ParameterText& text = stage_.parameters[p];
        const bool has_name = std::any_of(
            graph.parameters.begin(), graph.parameters.end(),
            [&](const Parameter& of) { return of.name == names_[static_cast<std::size_t>(p)]; });
        if (has_name || !changes(p, plain)) continue;
        const std::optional<double> value = value_of(p);
        std::string is = value ? std::string(name_of_value(text, *value)) : "as given";
        if (is.empty()) is = number(*value);
        all += (all.empty() ? "" : ", ") + std::string(text.name) + " = " + is;
    }
    return all;
}

}  // namespace quadrel::recorded
