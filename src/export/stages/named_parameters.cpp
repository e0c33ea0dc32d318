#include "export/stages/named_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <map>
#include <set>

#include "export/print/dialect.hpp"
#include "export/stages/parameter_forms.hpp"
#include "export/stages/same_shape.hpp"
#include "export/stages/stage_text.hpp"

namespace quadrel::recorded {
namespace {

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

/// "steps along the ray; 1 to 4096, default 32"
std::string comment(const ParameterText& text, bool has_least, bool has_most) {
    return std::string(text.meaning) + "; " + (has_least ? "" : "above ") +
           shortest_number(text.minimum) + " to " + (has_most ? "" : "below ") +
           shortest_number(text.maximum) + ", default " + shortest_number(text.default_value);
}

}  // namespace

std::string shortest_number(double value) {
    char text[40];
    if (value == std::floor(value) && std::fabs(value) < 1e9) {
        std::snprintf(text, sizeof text, "%.0f", value);
        return text;
    }
    for (int digits = 1; digits < 18; ++digits) {
        std::snprintf(text, sizeof text, "%.*g", digits, value);
        if (std::strtod(text, nullptr) == value) break;
    }
    return text;
}

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

/// Whether a literal has what its place's forms give for a value of the parameter.
bool NamedParameters::fits(const Node& literal, int parameter, double value,
                           const Place& place) const {
    float x = static_cast<float>(value);
    if (stage_.parameters[parameter].integer) {
        auto n = static_cast<std::int32_t>(value);
        if (place.other >= 0)
            n = std::max(n, static_cast<std::int32_t>(value_of(place.other).value_or(0)));
        n = whole_forms()[static_cast<std::size_t>(place.whole)].value(n);
        if (literal.type == Type::integer) return n == static_cast<std::int32_t>(literal.value);
        x = static_cast<float>(n);
    }
    x = real_forms()[static_cast<std::size_t>(place.real)].value(x);
    const float found = static_cast<float>(literal.value);
    return x == found && std::signbit(x) == std::signbit(found);
}

/// The first forms that give what other recordings have in the place of a node.
std::optional<NamedParameters::Place> NamedParameters::place_of(
    int parameter, std::size_t node, const std::vector<Graph>& others,
    const std::vector<double>& values) const {
    const bool is_whole = stage_.parameters[parameter].integer;
    for (int other = -1; other < (is_whole ? stage_.parameter_count : 0); ++other) {
        if (other == parameter ||
            (other >= 0 && (!stage_.parameters[other].integer || !value_of(other).has_value())))
            continue;
        for (int whole = 0; whole < (is_whole ? std::ssize(whole_forms()) : 1); ++whole)
            for (int real = 0; real < std::ssize(real_forms()); ++real) {
                const Place place{node, whole, real, other};
                bool fit = true;
                for (std::size_t k = 0; fit && k < values.size(); ++k)
                    fit = fits(*others[k].nodes[node], parameter, values[k], place);
                if (fit) return place;
            }
    }
    return std::nullopt;
}

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
    Places places{{}, true, true};
    for (std::size_t node = 0; node < graph.nodes.size(); ++node) {
        const Node &literal = *graph.nodes[node], &first = *others[0].nodes[node];
        if (std::all_of(others.begin(), others.end(), [&](const Graph& other) {
                return have_same_value(*other.nodes[node], first);
            })) {
            // What is the same for all but this value is decided by it.
            if (!have_same_value(literal, first)) return std::nullopt;
            continue;
        }
        const std::optional<Place> place = place_of(parameter, node, others, odd);
        if (!place) return std::nullopt;
        places.all.push_back(*place);
    }
    const auto has_end = [&](double value) {
        Graph end;
        return records(end, parameter, value) && have_same_shape(graph, end) &&
               std::all_of(places.all.begin(), places.all.end(), [&](const Place& place) {
                   return fits(*end.nodes[place.node], parameter, value, place);
               });
    };
    places.has_least = has_end(text.minimum);
    places.has_most = has_end(text.maximum);
    return places;
}

/// Of all parameters that can have a name, those alone that share no place but with each other, and
/// need no other one for it that has none.
std::vector<NamedParameters::Found> NamedParameters::all_places(const Graph& graph) const {
    std::vector<Found> all;
    std::map<std::size_t, std::pair<int, int>> taken;  // whose each place is, and with whom
    for (int p = 0; p < stage_.parameter_count; ++p) {
        auto places = places_of(p, graph);
        if (!places || places->all.empty()) continue;
        const std::optional<double> value = value_at(p, graph, *places);
        const bool is_free =
            std::all_of(places->all.begin(), places->all.end(), [&](const Place& place) {
                const auto found = taken.find(place.node);
                return found == taken.end() || found->second == std::pair(place.other, p);
            });
        if (!value || !is_free) continue;
        for (const Place& place : places->all) taken[place.node] = {p, place.other};
        all.push_back({p, std::move(*places), *value});
    }
    const auto is_named = [&](const Place& place) {
        return place.other < 0 || std::any_of(all.begin(), all.end(), [&](const Found& of) {
                   return of.parameter == place.other;
               });
    };
    for (std::size_t before = 0; before != all.size();) {
        before = all.size();
        std::erase_if(all, [&](const Found& of) {
            return !std::all_of(of.places.all.begin(), of.places.all.end(), is_named);
        });
    }
    return all;
}

/// The parameter's value where all literals are what it gives.
std::optional<double> NamedParameters::value_at(int parameter, const Graph& graph,
                                                const Places& places) const {
    std::optional<double> value = value_of(parameter);
    for (const Place& place : places.all)
        if (!value && place.whole == 0 && place.real == 0 && place.other < 0)
            value = graph.nodes[place.node]->value;
    for (const Place& place : places.all)
        if (!value || !fits(*graph.nodes[place.node], parameter, *value, place))
            return std::nullopt;
    return value;
}

// ---- Recording ----------------------------------------------------------------------------------

Node* NamedParameters::expression(const Node& literal, int parameter, const Place& place) const {
    const auto symbol = [&](int of, Type type) {
        return Recorder::current().symbol(type, names_[static_cast<std::size_t>(of)]);
    };
    const auto& real = real_forms()[static_cast<std::size_t>(place.real)];
    if (!stage_.parameters[parameter].integer)
        return real.text(Shader(symbol(parameter, Type::real))).node();
    ShaderInt n(symbol(parameter, Type::integer));
    if (place.other >= 0) n = max(n, ShaderInt(symbol(place.other, Type::integer)));
    n = whole_forms()[static_cast<std::size_t>(place.whole)].text(n);
    return literal.type == Type::integer ? n.node() : real.text(to_float<Shader>(n)).node();
}

/// Writes an expression of the parameter in the place of a literal.
void NamedParameters::put(int parameter, const Place& place, Graph& graph, Nodes& made) const {
    Node& literal = *graph.nodes[place.node];
    Graph parts;
    {
        const Recorder recorder(parts);
        Node root = *expression(literal, parameter, place);
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

void NamedParameters::record(Graph& graph) const {
    stage_.record(graph, scene_, params_.data());
    Nodes made;
    std::set<std::size_t> done;  // of two parameters, the first has put both
    for (const Found& of : all_places(graph)) {
        for (const Place& place : of.places.all)
            if (done.insert(place.node).second) put(of.parameter, place, graph, made);
        const ParameterText& text = stage_.parameters[of.parameter];
        graph.parameters.push_back({names_[static_cast<std::size_t>(of.parameter)],
                                    text.integer ? Type::integer : Type::real, of.value,
                                    comment(text, of.places.has_least, of.places.has_most)});
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
        if (is.empty()) is = shortest_number(*value);
        all += (all.empty() ? "" : ", ") + std::string(text.name) + " = " + is;
    }
    return all;
}

}  // namespace quadrel::recorded
