#include "render/inject/injected_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "quadrel/error.hpp"
#include "quadrel/film/channels.hpp"
#include "quadrel/quad/promises.hpp"
#include "render/plan/channel_source.hpp"
#include "render/plan/names.hpp"

namespace quadrel {
namespace {

constexpr std::size_t index_of(Value v) { return static_cast<std::size_t>(v); }

/// A component of a value, by the names that an image may have it under.
struct Component {
    Value value;
    int component = 0, light = 0;
    std::vector<std::string> names;
};

Component component_of(const std::string& channel) {
    const ChannelSource source = channel_source(channel);
    if (source.kind != ChannelSource::Kind::value)
        throw UsageError(
            fmt::format("--inject: found {}, expected what a stage stores, as hit.uv or N (see "
                        "`quadrel list channels`)",
                        channel));
    return {source.value,
            source.component,
            source.light,
            {channel, component_name(source.value, source.component, source.light)}};
}

const ValueInfo* find_value(const std::string& name) {
    const auto found = std::ranges::find(value_table, name, &ValueInfo::name);
    return found == value_table.end() ? nullptr : &*found;
}

/// What a name stands for: a channel, a value with all of its components, or a group of channels.
std::vector<Component> components_of(const std::string& name) {
    if (find_channel(name) != nullptr) return {component_of(name)};
    std::vector<Component> components;
    if (const ValueInfo* const value = find_value(name)) {
        const auto v = static_cast<Value>(value - value_table.data());
        for (int c = 0; c < value->components; ++c)
            components.push_back({v, c, 0, {component_name(v, c)}});
        return components;
    }
    for (const std::string& channel : expand_channels(std::vector{name}))
        components.push_back(component_of(channel));
    return components;
}

/// A group stands for those of its channels that the image has.
bool is_group(const std::string& name) {
    return find_channel(name) == nullptr && find_value(name) == nullptr;
}

std::string text_of(const Window& w) { return fmt::format("{},{},{},{}", w.x0, w.y0, w.x1, w.y1); }

void check_size(const Injection& injection, const Scene& scene, const Window& window) {
    const Film& image = *injection.image;
    const Window frame{0, 0, scene.width, scene.height};
    if (image.frame.width() != frame.width() || image.frame.height() != frame.height())
        throw InputError(
            injection.source, "",
            fmt::format("an image of {}x{} pixels", image.frame.width(), image.frame.height()),
            fmt::format("{}x{}, as the scene is rendered", scene.width, scene.height));
    if (image.frame != frame)
        throw InputError(injection.source, "",
                         fmt::format("a frame from {} on", text_of(image.frame)),
                         "one that begins at 0,0");
    if (!contains(image.window, window))
        throw InputError(injection.source, "", fmt::format("the window {}", text_of(image.window)),
                         fmt::format("all of {}, which is rendered", text_of(window)));
}

const char* type_name(ChannelType type) {
    return type == ChannelType::uint32 ? "integers" : "floats";
}

void check_type(const Injection& injection, const Component& component, const Plane& plane) {
    const ChannelType expected = info(component.value).kind == ValueKind::integer
                                     ? ChannelType::uint32
                                     : ChannelType::float32;
    if (plane.type != expected)
        throw InputError(injection.source, plane.name, type_name(plane.type), type_name(expected));
}

/// Stages index by codes and shift by flags: none may be one that no stage stores.
void check_codes(const Injection& injection, const Component& component, const Plane& plane) {
    const std::uint32_t end = allowed_end(component.value);
    if (plane.type != ChannelType::uint32 || end == 0) return;
    const auto bad = std::ranges::find_if(plane.bits, [&](std::uint32_t v) { return v >= end; });
    if (bad == plane.bits.end()) return;
    const Window& w = injection.image->window;
    const auto pixel = static_cast<int>(bad - plane.bits.begin());
    throw InputError(
        injection.source, plane.name,
        fmt::format("{} at {},{}", *bad, w.x0 + pixel % w.width(), w.y0 + pixel / w.width()),
        fmt::format("0 to {}", end - 1));
}

const Plane* find_plane(const Film& image, const Component& component) {
    for (const std::string& name : component.names)
        if (const Plane* const plane = image.find(name)) return plane;
    return nullptr;
}

}  // namespace

InjectedValues::InjectedValues(std::vector<Injection> injections, const Scene& scene,
                               const Window& window)
    : injections_(std::move(injections)), viewport_{scene.width, scene.height, scene.conventions} {
    if (scene.samples > 1)
        throw UsageError(fmt::format(
            "--inject: the scene has {} samples per pixel, expected 1: images have one fragment",
            scene.samples));
    for (const Injection& injection : injections_) {
        options_.push_back(injection.values + "=" + injection.source);
        check_size(injection, scene, window);
        std::istringstream names(injection.values);
        for (std::string name; std::getline(names, name, ',');) add(injection, name);
        if (arrays_.empty() || arrays_.back().asked != &injection)
            throw UsageError(
                fmt::format("--inject: found \"{}\", expected names", injection.values));
    }
}

void InjectedValues::add(const Injection& injection, const std::string& name) {
    std::size_t found = 0;
    for (const Component& component : components_of(name)) {
        const Plane* const plane = find_plane(*injection.image, component);
        if (plane == nullptr && is_group(name)) continue;
        if (plane == nullptr)
            throw InputError(injection.source, component.names.front(), "no such channel",
                             fmt::format("one, for --inject {}", injection.values));
        check_type(injection, component, *plane);
        check_codes(injection, component, *plane);
        const int slot = slot_of(component.value) +
                         component.light * info(component.value).components + component.component;
        if (std::ranges::count(arrays_, slot, &InjectedArray::slot) != 0)
            throw UsageError(fmt::format("--inject: {} comes twice", plane->name));
        arrays_.push_back({component.value, slot, component.light, plane, injection.image.get(),
                           injection.image->find("A"), &injection});
        ++found;
    }
    if (found == 0)
        throw InputError(injection.source, name, "no channel of that group", "one at least");
}

bool InjectedValues::covers(const QuadCoverage& quad) const {
    return std::ranges::all_of(arrays_, [&](const InjectedArray& array) {
        for (int lane = 0; lane < 4; ++lane)
            if (!pixel_of(array, quad, lane)) return false;
        return true;
    });
}

bool InjectedValues::has(Value value, int light) const {
    const int components = info(value).components;
    const int first = slot_of(value) + std::max(light, 0) * components;
    for (int slot = first; slot < first + components; ++slot)
        if (std::ranges::count(arrays_, slot, &InjectedArray::slot) == 0) return false;
    return true;
}

void InjectedValues::check_used(std::span<const MaterialPlan> plans) const {
    const auto is_used = [&](const InjectedArray& array) {
        const auto v = index_of(array.value);
        return std::ranges::any_of(
            plans, [&](const MaterialPlan& plan) { return plan.values[v] && plan.produced[v]; });
    };
    for (const InjectedArray& array : arrays_) {
        const bool used = std::ranges::any_of(arrays_, [&](const InjectedArray& other) {
            return other.asked == array.asked && is_used(other);
        });
        if (!used)
            throw UsageError(
                fmt::format("--inject: nothing that is rendered reads {}", array.asked->values));
    }
}

std::string injection_text(const std::vector<Injection>& injections) {
    std::string text;
    for (const Injection& injection : injections)
        text += fmt::format("{}{}={}", text.empty() ? "" : " ", injection.values,
                            film_hash(*injection.image));
    return text;
}

}  // namespace quadrel
