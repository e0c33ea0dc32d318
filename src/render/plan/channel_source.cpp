#include "render/plan/channel_source.hpp"

#include <map>

#include "quadrel/check.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/channels.hpp"

namespace quadrel {
namespace {

using Kind = ChannelSource::Kind;

struct Component {
    Value value;
    int component;
    int axis = 0;
    Observed observed = Observed::none;
};

using Table = std::map<std::string, Component>;

/// name.X name.Y name.Z for the letters of `suffixes`.
void add(Table& table, const std::string& name, const std::string& suffixes, Value value,
         int first = 0) {
    for (std::size_t i = 0; i < suffixes.size(); ++i)
        table[name + "." + suffixes[i]] = {value, first + static_cast<int>(i)};
}

void add_geometry(Table& table) {
    add(table, "P", "XYZ", Value::P);
    add(table, "N", "XYZ", Value::N);
    add(table, "Ng", "XYZ", Value::Ng);
    add(table, "T", "XYZ", Value::T);
    add(table, "B", "XYZ", Value::B);
    add(table, "bary", "012", Value::bary);
    add(table, "uv", "UV", Value::uv);
    add(table, "dUVdx", "UV", Value::dUVdx);
    add(table, "dUVdy", "UV", Value::dUVdy);
    add(table, "dPdx", "XYZ", Value::dPdx);
    add(table, "dPdy", "XYZ", Value::dPdy);
    add(table, "frame_normal", "XYZ", Value::frame_normal);
    add(table, "J.U", "XYZ", Value::J);
    add(table, "J.V", "XYZ", Value::J, 3);
    add(table, "K", "UV", Value::K);
    table["r"] = {Value::r, 0};
}

void add_hit(Table& table) {
    add(table, "hit.P", "XYZ", Value::hit_P);
    add(table, "hit", "UV", Value::hit_uv);
    table["relief.depth"] = {Value::relief_depth, 0};
    table["frag.depth"] = {Value::frag_depth, 0};
    table["hit.s"] = {Value::hit_s, 0};
    table["hit.h"] = {Value::hit_h, 0};
    table["hit.status"] = {Value::hit_status, 0};
    table["hit.flags"] = {Value::hit_flags, 0};
    table["hit.steps"] = {Value::hit_steps, 0};
    table["hit.fetches"] = {Value::hit_fetches, 0};
    table["lod.rho"] = {Value::lod_rho, 0};
    table["lod.lambda"] = {Value::lod_lambda, 0};
    table["lod.level"] = {Value::lod_level, 0};
    table["lod.frac"] = {Value::lod_frac, 0};
}

void add_oracle(Table& table) {
    table["oracle.s"] = {Value::oracle_s, 0};
    add(table, "oracle", "UV", Value::oracle_uv);
    add(table, "oracle.cell", "XY", Value::oracle_cell);
    add(table, "oracle.place", "XY", Value::oracle_place);
    add(table, "oracle.gradient", "UV", Value::oracle_gradient);
    table["oracle.condition"] = {Value::oracle_condition, 0};
    table["oracle.bound"] = {Value::oracle_bound, 0};
    table["oracle.status"] = {Value::oracle_status, 0};
    table["certified"] = {Value::certified, 0};
    table["certified.reason"] = {Value::certified_reason, 0};
}

void add_shading(Table& table) {
    table["R"] = {Value::color, 0};
    table["G"] = {Value::color, 1};
    table["B"] = {Value::color, 2};
    add(table, "light.ambient", "RGB", Value::light_ambient);
    add(table, "light.diffuse", "RGB", Value::light_diffuse);
    add(table, "light.specular", "RGB", Value::light_specular);
    add(table, "light.emissive", "RGB", Value::light_emissive);
    add(table, "light.reflection", "RGB", Value::light_reflection);
    add(table, "light.refraction", "RGB", Value::light_refraction);
    table["occlusion"] = {Value::occlusion, 0};
    table["occlusion.error"] = {Value::occlusion_error, 0};
    table["shadow.visibility"] = {Value::shadow_visibility, 0};
    table["shadow.steps"] = {Value::shadow_steps, 0};
}

/// What exact.* and derr.* are about, without these words.
const Table& exact_channels() {
    static const Table table = [] {
        Table made;
        const auto add_axes = [&](const std::string& name, const std::string& suffixes, Value v,
                                  Observed observed = Observed::none) {
            for (int axis = 0; axis < 2; ++axis)
                for (std::size_t i = 0; i < suffixes.size(); ++i)
                    made["d" + name + "d" + "xy"[axis] + "." + suffixes[i]] = {
                        v, static_cast<int>(i), axis, observed};
        };
        add_axes("P", "XYZ", Value::P);
        add_axes("UV", "UV", Value::uv);
        add_axes("hitUV", "UV", Value::hit_uv);
        add_axes("N", "XYZ", Value::N);
        add_axes("color", "RGB", Value::color);
        add_axes("mirrored", "XYZ", Value::N, Observed::mirrored);
        made["dhdx"] = {Value::hit_uv, 0, 0, Observed::height};
        made["dhdy"] = {Value::hit_uv, 0, 1, Observed::height};
        made["lod.rho"] = {Value::lod_rho, 0};
        made["lod.lambda"] = {Value::lod_lambda, 0};
        return made;
    }();
    return table;
}

/// The source of exact.* or derr.*; false for other channels.
bool find_exact(const std::string& name, ChannelSource& source) {
    const std::size_t dot = name.find('.');
    const std::string first = name.substr(0, dot);
    if (dot == std::string::npos || (first != "exact" && first != "derr")) return false;
    const auto found = exact_channels().find(name.substr(dot + 1));
    QUADREL_CHECK(found != exact_channels().end(), name);
    source.kind = first == "exact" ? Kind::exact : Kind::exact_error;
    source.value = found->second.value;
    source.component = found->second.component;
    source.axis = found->second.axis;
    source.observed = found->second.observed;
    return true;
}

struct MeasureName {
    ErrorMeasure measure;
    int component = 0;
};

/// What err.*, err.search.* and err.frame.* are about, without these words.
const std::map<std::string, MeasureName>& error_measures() {
    using enum ErrorMeasure;
    static const std::map<std::string, MeasureName> table{{"s", {s}},
                                                          {"uv", {uv}},
                                                          {"cell", {cell}},
                                                          {"kind", {kind}},
                                                          {"normal", {normal}},
                                                          {"shadow", {shadow}},
                                                          {"color.R", {color}},
                                                          {"color.G", {color, 1}},
                                                          {"color.B", {color, 2}},
                                                          {"K", {K}},
                                                          {"certified", {certified}}};
    return table;
}

/// The source of err.*; false for other channels.
bool find_error(std::string name, ChannelSource& source) {
    const auto begins = [&](const std::string& prefix) {
        const bool has = name.starts_with(prefix);
        if (has) name.erase(0, prefix.size());
        return has;
    };
    if (!begins("err.")) return false;
    source.part = begins("search.")  ? ErrorPart::search
                  : begins("frame.") ? ErrorPart::frame
                                     : ErrorPart::whole;
    const auto found = error_measures().find(name);
    QUADREL_CHECK(found != error_measures().end(), name);
    source.kind = Kind::error;
    source.measure = found->second.measure;
    source.component = found->second.component;
    return true;
}

const Table& value_channels();

/// The source of gpu.*, bound.*, undecided or certified.pixel*; false for other channels.
bool find_range(const std::string& name, ChannelSource& source) {
    if (name == "undecided") {
        source.kind = Kind::undecided;
        source.range_set = RangeSet::gpu;
        source.value = Value::hit_uv;
        return true;
    }
    if (name == "certified.pixel" || name == "certified.pixel.reason") {
        source.kind = name == "certified.pixel" ? Kind::pixel_certified : Kind::pixel_reason;
        source.range_set = RangeSet::exact;
        source.value = Value::K;
        return true;
    }
    const auto range = range_channel(name);
    if (!range) return false;
    static const std::map<std::string, Kind> kinds = {{"lo", Kind::range_low},
                                                      {"hi", Kind::range_high},
                                                      {"gap.lo", Kind::gap_low},
                                                      {"gap.hi", Kind::gap_high},
                                                      {"paths", Kind::range_paths}};
    source.kind = kinds.at(range->part);
    source.range_set = range->set == "gpu" ? RangeSet::gpu : RangeSet::exact;
    if (range->channel == "Z") {
        source.negated = true;
        source.value = Value::hit_P;
        source.component = 2;
        return true;
    }
    const ChannelSource of = channel_source(range->channel);
    source.value = of.value;
    source.component = of.component;
    source.light = of.light;
    return true;
}

/// The source of integral.error.*; false for other channels.
bool find_integral_error(const std::string& name, ChannelSource& source) {
    const std::string prefix = "integral.error.", components = "RGB";
    if (!name.starts_with(prefix)) return false;
    source.kind = Kind::integral_error;
    source.value = Value::color;
    source.component = static_cast<int>(components.find(name.back()));
    return true;
}

const Table& value_channels() {
    static const Table table = [] {
        Table made;
        add_geometry(made);
        add_hit(made);
        add_oracle(made);
        add_shading(made);
        return made;
    }();
    return table;
}

const std::map<std::string, Kind>& special_channels() {
    static const std::map<std::string, Kind> table{{"A", Kind::coverage},
                                                   {"Z", Kind::z},
                                                   {"depth", Kind::depth},
                                                   {"id.object", Kind::object},
                                                   {"id.primitive", Kind::primitive},
                                                   {"quad.lane", Kind::lane},
                                                   {"quad.coverage", Kind::quad_coverage},
                                                   {"integral.samples", Kind::integral_samples}};
    return table;
}

/// shadow.<i>.visibility as shadow.visibility, with the light's number.
std::string without_light(const std::string& name, int& light) {
    const std::string prefix = "shadow.";
    const std::size_t dot = name.find('.', prefix.size());
    if (name.compare(0, prefix.size(), prefix) != 0 || dot == std::string::npos) return name;
    light = std::stoi(name.substr(prefix.size(), dot - prefix.size()));
    if (light >= max_lights)
        throw UsageError("channel \"" + name + "\": at most " + std::to_string(max_lights) +
                         " lights are supported");
    return prefix + name.substr(dot + 1);
}

}  // namespace

bool ChannelSource::resolved() const {
    return kind == Kind::coverage || kind == Kind::z ||
           (kind == Kind::value && value == Value::color);
}

ChannelSource channel_source(const std::string& name) {
    const ChannelInfo* channel = find_channel(name);
    QUADREL_CHECK(channel != nullptr, name);
    ChannelSource source;
    source.name = name;
    source.type = channel->type;
    if (const auto special = special_channels().find(name); special != special_channels().end()) {
        source.kind = special->second;
        return source;
    }
    if (find_exact(name, source) || find_error(name, source) || find_range(name, source) ||
        find_integral_error(name, source))
        return source;
    const auto found = value_channels().find(without_light(name, source.light));
    QUADREL_CHECK(found != value_channels().end(), name);
    source.value = found->second.value;
    source.component = found->second.component;
    return source;
}

}  // namespace quadrel
