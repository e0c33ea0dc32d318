#include "render/draw/border_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "quadrel/quad/promises.hpp"
#include "render/plan/names.hpp"

namespace quadrel {
namespace {

/// A rule about integers: allowed_end, for people.
struct Limit {
    Value value;
    const char* text;
    std::uint32_t end = allowed_end(value);
};

constexpr Limit limits[] = {
    {Value::frame_status, "a status, 0 to 7"},
    {Value::hit_status, "a status, 0 to 7"},
    {Value::frame_flags, "flags, 0 to 15"},
    {Value::hit_flags, "flags, 0 to 63"},
    {Value::hit_steps, "a count"},
    {Value::hit_fetches, "a count"},
    {Value::shadow_steps, "a count"},
};

/// The rules, by bit: those of `limits`, and two about real numbers.
constexpr std::size_t depth_rule = std::size(limits), parameter_rule = depth_rule + 1;
static_assert(parameter_rule + 1 == BorderChecks().size());
static_assert(std::all_of(std::begin(limits), std::end(limits),
                          [](const Limit& limit) { return std::has_single_bit(limit.end); }));

/// One array of a batch.
template <class T>
const T* array(void* const* values, Value v, int component = 0) {
    return static_cast<const T*>(values[slot_of(v) + component]);
}

/// Whether beyond(i) is true of a lane. All lanes are looked at, four at a time: a loop without an
/// exit becomes one of wide instructions.
template <class Beyond>
bool any_lane(int lanes, const Beyond& beyond) {
    std::uint32_t found[4] = {};
    for (int i = 0; i < lanes; i += 4)
        for (int k = 0; k < 4; ++k) found[k] |= beyond(i + k);
    return (found[0] | found[1] | found[2] | found[3]) != 0;
}

/// The first lane whose value is not below the limit; -1 if there is none.
int first_beyond(const std::uint32_t* of, int lanes, std::uint32_t limit) {
    if (!any_lane(lanes, [=](int i) { return of[i] & ~(limit - 1); })) return -1;
    return static_cast<int>(std::find_if(of, of + lanes, [&](auto x) { return x >= limit; }) - of);
}

std::optional<BorderFault> check_code(const PlannedStage& stage, const Limit& limit,
                                      void* const* values, int lanes) {
    const int light = std::max(stage.light, 0) * int(info(limit.value).per_light);
    const auto* const of = array<std::uint32_t>(values, limit.value, light);
    const int lane = of ? first_beyond(of, lanes, limit.end) : -1;
    if (lane < 0) return std::nullopt;
    return BorderFault{lane,
                       fmt::format("{} = {} in lane {}, expected {}", info(limit.value).name,
                                   static_cast<std::int32_t>(of[lane]), lane % 4, limit.text)};
}

/// Whether what the search started from is finite, and its relief has depth.
template <class T>
bool sound_ray(void* const* values, int lane) {
    for (const Value v : {Value::uv, Value::K, Value::uv_rate, Value::relief_depth})
        for (int c = 0; c < info(v).components; ++c)
            if (const T* of = array<T>(values, v, c); of && !std::isfinite(of[lane])) return false;
    const T* const depth = array<T>(values, Value::relief_depth);
    return !depth || depth[lane] > 0;
}

template <class T>
std::optional<BorderFault> check_depth(void* const* values, int lanes) {
    const T* const of = array<T>(values, Value::relief_depth);
    if (!of || !any_lane(lanes, [=](int i) { return of[i] < 0 ? 1u : 0u; })) return std::nullopt;
    const int lane = static_cast<int>(std::find_if(of, of + lanes, [](T x) { return x < 0; }) - of);
    return BorderFault{
        lane, fmt::format("relief_depth = {} in lane {}, expected 0 or more", of[lane], lane % 4)};
}

template <class T>
std::optional<BorderFault> check_parameter(void* const* values, int lanes) {
    const T* const s = array<T>(values, Value::hit_s);
    const auto* const status = array<std::int32_t>(values, Value::hit_status);
    if (!s || !status) return std::nullopt;
    if (!any_lane(lanes, [=](int i) { return s[i] != s[i] ? 1u : 0u; })) return std::nullopt;
    for (int i = 0; i < lanes; ++i)
        if (s[i] != s[i] && status[i] == static_cast<int>(Status::hit) && sound_ray<T>(values, i))
            return BorderFault{
                i,
                fmt::format("hit.s is NaN in lane {} with status HIT, expected a number", i % 4)};
    return std::nullopt;
}

template <class T>
std::optional<BorderFault> check_reals(const PlannedStage& stage, void* const* values, int lanes) {
    if (stage.checks[depth_rule])
        if (auto fault = check_depth<T>(values, lanes)) return fault;
    return stage.checks[parameter_rule] ? check_parameter<T>(values, lanes) : std::nullopt;
}

bool as_published(const PlannedStage& stage) {
    return std::string_view(stage.info->text.id).find('@') != std::string_view::npos;
}

std::optional<BorderFault> find_fault(const PlannedStage& stage, void* const* values, int lanes,
                                      int scalar_bytes) {
    for (std::size_t i = 0; i < std::size(limits); ++i)
        if (stage.checks[i])
            if (auto fault = check_code(stage, limits[i], values, lanes)) return fault;
    return scalar_bytes == sizeof(float) ? check_reals<float>(stage, values, lanes)
                                         : check_reals<double>(stage, values, lanes);
}

}  // namespace

BorderChecks border_checks(const PlannedStage& stage, const ValueSet& planned) {
    const auto can_break = [&](Value v) {
        return stores(stage, v) && planned[static_cast<std::size_t>(v)];
    };
    BorderChecks checks;
    for (std::size_t i = 0; i < std::size(limits); ++i) checks[i] = can_break(limits[i].value);
    checks[depth_rule] = can_break(Value::relief_depth) && !as_published(stage);
    checks[parameter_rule] = can_break(Value::hit_s) && !as_published(stage);
    return checks;
}

std::optional<BorderFault> find_border_fault(const PlannedStage& stage, void* const* values,
                                             int lanes, int scalar_bytes) {
    if (stage.checks.none()) return std::nullopt;
    auto fault = find_fault(stage, values, lanes, scalar_bytes);
    if (fault) fault->text = fmt::format("{} stored {}", stage.info->text.id, fault->text);
    return fault;
}

}  // namespace quadrel
