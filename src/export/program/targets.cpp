#include "export/program/targets.hpp"

#include <algorithm>
#include <span>

namespace quadrel::recorded {
namespace {

using Kind = ProgramChannel::Kind;

/// The number of a fragment's value that a channel shows, as a shader calls it.
struct Component {
    std::string name;
    Type type = Type::real;
    int index = 0;
};

Component component_of(const ProgramChannel& channel) {
    const ValueInfo& of = info(channel.value);
    if (of.components == 6)
        return {shader_name(channel.value, channel.light, channel.component < 3 ? "_u" : "_v"),
                Type::vec3, channel.component % 3};
    return {shader_name(channel.value, channel.light),
            of.kind == ValueKind::integer ? Type::integer : vector_of(of.components),
            channel.component};
}

std::string expression_of(const ProgramChannel& channel, const Dialect& dialect) {
    switch (channel.kind) {
        case Kind::none:
            return "0.0";
        case Kind::coverage:
            return "1.0";
        case Kind::z:
            return "-" + shader_name(Value::hit_P) + ".z";
        case Kind::lod_level:
            return "level_of_detail.x";
        case Kind::lod_lambda:
            return "level_of_detail.y";
        case Kind::value:
            break;
    }
    const Component component = component_of(channel);
    if (component.type == Type::integer)
        return dialect.type(Type::real) + "(" + component.name + ")";
    if (component.type == Type::real) return component.name;
    return component.name + "." + "xyzw"[component.index];
}

template <class Body>
void for_each_channel(const ProgramRequest& request, const Body& body) {
    for (int p = 0; p < request.pass_count; ++p)
        for (int t = 0; t < request.passes[p].target_count; ++t)
            for (const ProgramChannel& channel : request.passes[p].channels[t]) body(channel);
}

/// How many channels, from the first of these on, are a whole vector; 0: it is none.
std::size_t components_of_vector(std::span<const ProgramChannel> channels) {
    if (channels.front().kind != Kind::value) return 0;
    const Component first = component_of(channels.front());
    for (const std::size_t n : {2, 3, 4}) {
        if (first.type != vector_of(static_cast<int>(n)) || n > channels.size()) continue;
        for (std::size_t i = 0; i < n; ++i) {
            if (channels[i].kind != Kind::value) return 0;
            const Component of = component_of(channels[i]);
            if (of.name != first.name || of.index != static_cast<int>(i)) return 0;
        }
        return n;
    }
    return 0;
}

/// What a target's vec4 is made of.
std::vector<std::string> parts_of(std::span<const ProgramChannel> channels,
                                  const Dialect& dialect) {
    std::vector<std::string> parts;
    while (!channels.empty()) {
        const std::size_t whole = components_of_vector(channels);
        parts.push_back(whole > 0 ? component_of(channels.front()).name
                                  : expression_of(channels.front(), dialect));
        channels = channels.subspan(std::max<std::size_t>(whole, 1));
    }
    return parts;
}

}  // namespace

bool asks_lod(const ProgramRequest& request) {
    bool asks = false;
    for_each_channel(request, [&](const ProgramChannel& channel) {
        asks |= channel.kind == Kind::lod_level || channel.kind == Kind::lod_lambda;
    });
    return asks;
}

ValueTypes wanted_values(const ProgramRequest& request) {
    ValueTypes wanted;
    for_each_channel(request, [&](const ProgramChannel& channel) {
        if (channel.kind == Kind::z) wanted.emplace(shader_name(Value::hit_P), Type::vec3);
        if (channel.kind != Kind::value) return;
        const Component component = component_of(channel);
        wanted.emplace(component.name, component.type);
    });
    if (asks_lod(request)) wanted.emplace("uv", Type::vec2);
    if (request.discard_below >= 0) wanted.emplace(shader_name(Value::opacity), Type::real);
    if (request.clips != 0) wanted.emplace(shader_name(Value::hit_status), Type::integer);
    if (request.writes_depth != 0) wanted.emplace(shader_name(Value::frag_depth), Type::real);
    return wanted;
}

PassTargets targets_of(const ProgramRequest& request, const Dialect& dialect) {
    PassTargets passes;
    for (int p = 0; p < request.pass_count; ++p) {
        auto& pass = passes.emplace_back();
        for (int t = 0; t < request.passes[p].target_count; ++t)
            pass.push_back(parts_of(request.passes[p].channels[t], dialect));
    }
    return passes;
}

std::string discard_condition(const ProgramRequest& request, const Dialect& dialect) {
    std::string condition;
    if (request.discard_below >= 0) condition = "opacity < " + dialect.real(request.discard_below);
    if (request.clips != 0)
        condition += (condition.empty() ? "" : " || ") + std::string("hit_status == STATUS_CLIP");
    return condition;
}

}  // namespace quadrel::recorded
