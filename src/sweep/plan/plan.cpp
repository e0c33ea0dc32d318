#include "sweep/plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "file/read_file.hpp"
#include "io/document/stage_parameters.hpp"
#include "io/document/value.hpp"
#include "quadrel/relief/registry.hpp"
#include "sweep/plan/families.hpp"
#include "sweep/plan/map_kinds.hpp"
#include "sweep/plan/plan_checks.hpp"

namespace quadrel::sweep {
namespace {

constexpr Word<Rows> row_words[] = {{"all", Rows::all},
                                    {"corrected", Rows::corrected},
                                    {"published", Rows::published},
                                    {"engines", Rows::engines},
                                    {"oracles", Rows::oracles}};
constexpr double steepest_view = 89.5;

/// One value stands for an array of one.
std::vector<SceneValue> elements(const SceneValue& value) {
    if (!value.json().is_array()) return {value};
    if (value.json().empty()) value.fail("an empty array", "at least one");
    std::vector<SceneValue> all;
    for (std::size_t i = 0; i < value.json().size(); ++i) all.push_back(value.element(i));
    return all;
}

/// The same, where what stands there twice would be measured twice.
std::vector<SceneValue> distinct_elements(const SceneValue& value) {
    std::vector<SceneValue> all = elements(value);
    std::set<Json> known;
    for (const SceneValue& one : all)
        if (!known.insert(one.json()).second)
            one.fail(one.json().dump() + " a second time", "each value once");
    return all;
}

std::string short_number(double value) { return fmt::format("{:g}", value); }

std::string word_in(const SceneValue& value, const std::vector<std::string>& known) {
    const std::string word = value.string();
    if (std::find(known.begin(), known.end(), word) == known.end())
        value.reject(one_of(word, known));
    return word;
}

// Scenes

PlannedScene read_scene(const SceneValue& value) {
    PlannedScene scene;
    if (value.json().is_string()) {
        scene.file_or_name = value.string();
    } else {
        Fields fields(value);
        scene.file_or_name = fields.get("scene").string();
        fields.read("name", scene.name);
        if (fields.has("set")) {
            const SceneValue set = fields.get("set");
            if (!set.json().is_object()) set.reject("an object of keys of the scene");
            for (const auto& [key, member] : set.json().items())
                scene.overrides.push_back(key + "=" + member.dump());
        }
        fields.finish("a scene of a plan");
    }
    const std::string named = scene.file_or_name.string();
    if (named.empty()) value.fail("an empty name", "a scene file or the name of an installed one");
    if (scene.name.empty()) scene.name = scene.file_or_name.stem().string();
    // A file is meant from the plan on, an installed scene by its name.
    if (scene.file_or_name.has_extension() && scene.file_or_name.is_relative())
        scene.file_or_name = value.document().file.parent_path() / scene.file_or_name;
    return scene;
}

// Maps

void read_format(Fields& fields, PlannedMap& map) {
    const std::vector<std::string> formats{"unorm8", "unorm16", "half", "float"};
    const std::vector<std::string> wraps{"repeat", "mirrored-repeat", "clamp-to-edge",
                                         "clamp-to-border", "mirror-once"};
    if (fields.has("format")) map.format = word_in(fields.get("format"), formats);
    if (fields.has("wrap")) map.wrap = word_in(fields.get("wrap"), wraps);
}

/// Combinations of an entry's values.
constexpr std::size_t most_combinations = 10'000;

/// All combinations of `lists`' values, the last one changing quickest. Refuses `entry`, whose they
/// are, if there are too many.
template <class T>
std::vector<std::map<std::string, T>> products(
    const SceneValue& entry, const std::vector<std::pair<std::string, std::vector<T>>>& lists) {
    std::size_t count = 1;
    for (const auto& [name, values] : lists)
        if ((count *= values.size()) > most_combinations)
            entry.fail("lists with more than 10000 combinations", "at most as many");
    std::vector<std::map<std::string, T>> all{{}};
    for (const auto& [name, values] : lists) {
        std::vector<std::map<std::string, T>> next;
        for (const auto& before : all)
            for (const T& value : values) {
                next.push_back(before);
                next.back()[name] = value;
            }
        all = std::move(next);
    }
    return all;
}

std::string made_name(const MapKind& kind, const MapValues& values) {
    std::string name(kind.name);
    for (const MapParameter& parameter : kind.parameters) {
        const double value = values.at(std::string(parameter.name));
        if (value != parameter.standard)
            name += fmt::format(" {}={}", parameter.name, short_number(value));
    }
    return name;
}

std::vector<MapValues> map_values(Fields& fields, const MapKind& kind) {
    std::vector<std::pair<std::string, std::vector<double>>> lists;
    for (const MapParameter& parameter : kind.parameters) {
        const std::string name(parameter.name);
        lists.push_back({name, {}});
        if (!fields.has(name)) {
            lists.back().second.push_back(parameter.standard);
            continue;
        }
        for (const SceneValue& value : distinct_elements(fields.get(name)))
            lists.back().second.push_back(value.number({parameter.low, parameter.high}));
    }
    return products(fields.get("kind"), lists);
}

void read_made(Fields& fields, PlannedMap map, std::vector<PlannedMap>& maps) {
    std::vector<std::string> known;
    for (const MapKind& kind : map_kinds()) known.emplace_back(kind.name);
    map.source = PlannedMap::Source::made;
    map.kind = word_in(fields.get("kind"), known);
    const MapKind& kind = *find_map_kind(map.kind);
    if (map.format.empty()) map.format = kind.format;
    std::vector<int> sizes;
    if (fields.has("size"))
        for (const SceneValue& value : distinct_elements(fields.get("size")))
            sizes.push_back(value.integer(least_map_side, largest_map_side));
    else
        sizes.push_back(256);
    const std::string given = map.name;
    for (const MapValues& values : map_values(fields, kind))
        for (const int size : sizes) {
            map.parameters = values;
            map.size = size;
            map.name = given.empty() ? made_name(kind, values) : given;
            maps.push_back(map);
        }
}

void read_map(const SceneValue& value, std::vector<PlannedMap>& maps) {
    PlannedMap map;
    if (value.json().is_string()) {
        map.name = word_in(value, {"scene"});
        maps.push_back(map);
        return;
    }
    Fields fields(value);
    fields.read("name", map.name);
    read_format(fields, map);
    if (fields.has("kind")) {
        read_made(fields, map, maps);
        return fields.finish("a map of kind \"" + maps.back().kind + "\"");
    }
    if (!fields.has("file")) value.fail("neither \"kind\" nor \"file\"", "one of them");
    const SceneValue file = fields.get("file");
    map.source = PlannedMap::Source::file;
    map.file = std::filesystem::absolute(value.document().file.parent_path() /
                                         std::filesystem::path(file.string()));
    if (const char* reason = reason_not_to_read(map.file))
        file.fail(reason + (" (" + map.file.string() + ")"), "a height map");
    if (map.name.empty()) map.name = map.file.stem().string();
    maps.push_back(map);
    fields.finish("a map of a file");
}

// Algorithms

ParameterValue parameter_value(const SceneValue& value, const std::string& trace,
                               const std::string& name) {
    const ParameterText* text = find_parameter(trace, name);
    const ParameterValue given =
        value.json().is_string() ? ParameterValue(value.string()) : ParameterValue(value.number());
    if (!number_of(*text, given)) value.reject(expected_of(*text, given));
    return given;
}

std::vector<Parameters> read_parameters_of(const SceneValue& value, const std::string& trace) {
    if (!value.json().is_object()) value.reject("an object of parameters, each a value or a list");
    std::vector<std::string> known;
    for (const ParameterText& parameter : find_stage(trace)->parameters)
        known.emplace_back(parameter.name);
    std::vector<std::pair<std::string, std::vector<ParameterValue>>> lists;
    for (const auto& [name, member] : value.json().items()) {
        const SceneValue list = value.member(name);
        if (find_parameter(trace, name) == nullptr)
            list.fail("a parameter that " + trace + " does not take", one_of(name, known));
        lists.push_back({name, {}});
        for (const SceneValue& one : distinct_elements(list))
            lists.back().second.push_back(parameter_value(one, trace, name));
    }
    return products(value, lists);
}

std::map<double, double> read_published(const SceneValue& value) {
    std::map<double, double> published;
    if (!value.json().is_object())
        value.reject("an object of frames per second by angle, as {\"45\": 30}");
    for (const auto& [key, member] : value.json().items()) {
        double angle = 0;
        const auto [stop, error] = std::from_chars(key.data(), key.data() + key.size(), angle);
        if (error != std::errc() || stop != key.data() + key.size())
            value.member(key).fail("the key \"" + key + "\"", "an angle in degrees");
        if (!published.emplace(angle, value.member(key).number(above_zero)).second)
            value.member(key).fail(short_number(angle) + " degrees a second time", "each once");
    }
    return published;
}

std::string read_trace(const SceneValue& value) {
    const std::string id = value.string();
    const StageInfo* stage = find_stage(id == "none" ? "trace-none" : id);
    if (stage == nullptr || std::string_view(stage->text.room) != "trace")
        value.reject("a trace: " + one_of(id, trace_rows(Rows::all)));
    return stage->text.id;
}

/// An algorithm and the entry of the plan that has it: by its name, or as one of a group of rows.
struct PlannedAlgorithm {
    Algorithm algorithm;
    SceneValue entry;
    bool is_named;
};

void read_algorithm(const SceneValue& value, std::vector<PlannedAlgorithm>& all) {
    if (value.json().is_string()) {
        all.push_back({{read_trace(value), {}, {}}, value, true});
        return;
    }
    Fields fields(value);
    if (fields.has("rows")) {
        for (const std::string& id : trace_rows(fields.get("rows").word(row_words)))
            all.push_back({{id, {}, {}}, value, false});
        return fields.finish("an entry of rows");
    }
    const std::string trace = read_trace(fields.get("trace"));
    std::map<double, double> published;
    if (fields.has("published")) published = read_published(fields.get("published"));
    std::vector<Parameters> sets{{}};
    if (fields.has("parameters")) sets = read_parameters_of(fields.get("parameters"), trace);
    for (const Parameters& parameters : sets)
        all.push_back({{trace, parameters, published}, value, true});
    fields.finish("an algorithm");
}

/// Whether two are one search: a parameter that is not given has its default.
bool are_same(const Algorithm& a, const Algorithm& b) {
    if (a.trace != b.trace) return false;
    const auto value = [](const Algorithm& algorithm, const ParameterText& parameter) {
        const auto given = algorithm.parameters.find(parameter.name);
        if (given == algorithm.parameters.end()) return parameter.default_value;
        return *number_of(parameter, given->second);
    };
    return std::ranges::all_of(find_stage(a.trace)->parameters,
                               [&](const ParameterText& p) { return value(a, p) == value(b, p); });
}

/// Groups of rows may overlap, and hold what is named beside them: that is measured once, as it is
/// named. What is named twice is refused.
std::vector<Algorithm> each_once(const std::vector<PlannedAlgorithm>& all) {
    std::vector<PlannedAlgorithm> kept;
    for (const PlannedAlgorithm& one : all) {
        const auto same = std::ranges::find_if(kept, [&](const PlannedAlgorithm& other) {
            return are_same(one.algorithm, other.algorithm);
        });
        if (same == kept.end())
            kept.push_back(one);
        else if (one.is_named && same->is_named)
            one.entry.fail(one.algorithm.name() + " a second time: " + same->entry.path() +
                               " has " + same->algorithm.name(),
                           "each search with each set of parameters once");
        else if (one.is_named)
            *same = one;
    }
    std::vector<Algorithm> algorithms;
    for (const PlannedAlgorithm& one : kept) algorithms.push_back(one.algorithm);
    return algorithms;
}

// How they are run

View read_view(const SceneValue& value) {
    if (!value.json().is_string()) return {value.number({0, steepest_view})};
    word_in(value, {"camera"});
    return {};
}

void read_size(Fields& fields, Plan& plan) {
    if (!fields.has("size")) return;
    const SceneValue size = fields.get("size");
    if (!size.json().is_array() || size.json().size() != 2)
        size.reject("an array of 2: width and height in pixels");
    plan.width = size.element(0).integer(8, 8192);
    plan.height = size.element(1).integer(8, 8192);
}

void read_pictures(Fields& fields, PictureSettings& pictures) {
    if (!fields.has("pictures")) return;
    Fields own(fields.get("pictures"));
    own.read("side", pictures.side, 16, 256);
    own.read("most", pictures.most, 0, 2000);
    if (own.has("angles"))
        for (const SceneValue& value : distinct_elements(own.get("angles")))
            pictures.angles.push_back(value.number({0, steepest_view}));
    own.finish("the pictures of a plan");
}

void read_running(Fields& fields, Plan& plan) {
    read_size(fields, plan);
    fields.read("samples", plan.samples, 1, 16);
    fields.read("repeats", plan.repeats, 1, 1000);
    fields.read("repeat_seconds", plan.repeat_seconds, above_zero);
    fields.read("wrong_texels", plan.wrong_texels, above_zero);
    fields.read("published_on", plan.published_on);
    if (fields.has("numbers")) {
        plan.numbers.clear();
        for (const SceneValue& value : distinct_elements(fields.get("numbers")))
            plan.numbers.push_back(word_in(value, {"float", "double"}));
    }
    if (fields.has("isa")) {
        plan.isas.clear();
        for (const SceneValue& value : distinct_elements(fields.get("isa")))
            plan.isas.push_back(
                word_in(value, {"auto", "scalar", "sse4", "avx2", "avx512", "neon"}));
    }
    if (fields.has("threads")) {
        plan.threads.clear();
        for (const SceneValue& value : distinct_elements(fields.get("threads")))
            plan.threads.push_back(value.integer(1, 1024));
    }
    read_pictures(fields, plan.pictures);
}

constexpr const char* plan_keys[] = {"sweep",        "title",          "scenes",  "maps",
                                     "views",        "algorithms",     "size",    "samples",
                                     "repeats",      "repeat_seconds", "isa",     "wrong_texels",
                                     "published_on", "numbers",        "threads", "pictures"};

SceneDocument open_plan(const std::filesystem::path& file) {
    SceneDocument document = parse_scene_text(read_whole_file(file), file);
    const SceneValue root(document, document.root, "");
    if (!root.json().is_object() || root.json().empty())
        root.reject("a plan: an object { \"sweep\": 1, ... }");
    const std::string first = root.json().begin().key();
    if (first != "sweep")
        root.member(first).fail("\"" + first + "\" as the first key",
                                "\"sweep\": 1, the format's version, first");
    const std::vector<std::string> known(std::begin(plan_keys), std::end(plan_keys));
    for (const auto& [key, member] : root.json().items())
        if (std::find(known.begin(), known.end(), key) == known.end())
            root.member(key).fail("an unknown key", one_of(key, known));
    return document;
}

}  // namespace

std::string View::name() const { return angle ? short_number(*angle) : "camera"; }

std::string Algorithm::name() const {
    std::string text = trace;
    for (const auto& [key, value] : parameters) text += " " + key + "=" + text_of(value);
    return text;
}

Plan read_plan(const std::filesystem::path& file) {
    const SceneDocument document = open_plan(file);
    Fields fields(SceneValue(document, document.root, ""));
    Plan plan;
    plan.file = file;
    fields.get("sweep").integer(1, 1);
    plan.title = file.stem().string();
    fields.read("title", plan.title);
    for (const SceneValue& value : elements(fields.get("scenes")))
        plan.scenes.push_back(read_scene(value));
    if (fields.has("maps"))
        for (const SceneValue& value : elements(fields.get("maps"))) read_map(value, plan.maps);
    else
        plan.maps.push_back(scene_map());
    for (const SceneValue& value : distinct_elements(fields.get("views")))
        plan.views.push_back(read_view(value));
    std::vector<PlannedAlgorithm> algorithms;
    for (const SceneValue& value : elements(fields.get("algorithms")))
        read_algorithm(value, algorithms);
    plan.algorithms = each_once(algorithms);
    read_running(fields, plan);
    fields.finish("a plan");
    check_plan(plan, fields.value());
    return plan;
}

}  // namespace quadrel::sweep
