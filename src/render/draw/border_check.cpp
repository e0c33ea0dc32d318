#include "render/draw/border_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "render/plan/names.hpp"

namespace quadrel {
namespace {

/// Allowed values of an integer array: [0, limit).
struct Limit {
    Value value;
    std::uint32_t limit;
    const char* text;
};

constexpr std::uint32_t counts_end = 0x80000000u;  // negative ones are beyond
constexpr Limit limits[] = {
    {Value::frame_status, 8, "a status, 0 to 7"},
    {Value::hit_status, 8, "a status, 0 to 7"},
    {Value::frame_flags, 16, "flags, 0 to 15"},
    {Value::hit_flags, HitFlag::end, "flags, 0 to 63"},
    {Value::hit_steps, counts_end, "a count"},
    {Value::hit_fetches, counts_end, "a count"},
    {Value::shadow_steps, counts_end, "a count"},
};

/// One array of a batch.
template <class T>
const T* array(void* const* values, Value v, int component = 0) {
    return static_cast<const T*>(values[slot_of(v) + component]);
}

/// The largest of all first: a loop without an exit is a loop of packets.
int first_beyond(const std::uint32_t* of, int lanes, std::uint32_t limit) {
    std::uint32_t largest = 0;
    for (int i = 0; i < lanes; ++i) largest = std::max(largest, of[i]);
    if (largest < limit) return -1;
    return static_cast<int>(std::find_if(of, of + lanes, [&](auto x) { return x >= limit; }) - of);
}

std::optional<BorderFault> check_codes(const PlannedStage& stage, void* const* values, int lanes) {
    for (const Limit& limit : limits) {
        if (!stores(stage, limit.value)) continue;
        const auto* const of = array<std::uint32_t>(
            values, limit.value, std::max(stage.light, 0) * int(info(limit.value).per_light));
        const int lane = of ? first_beyond(of, lanes, limit.limit) : -1;
        if (lane >= 0)
            return BorderFault{
                lane, fmt::format("{} = {} in lane {}, expected {}", info(limit.value).name,
                                  static_cast<std::int32_t>(of[lane]), lane % 4, limit.text)};
    }
    return std::nullopt;
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
std::optional<BorderFault> check_reals(const PlannedStage& stage, void* const* values, int lanes) {
    if (const T* of = array<T>(values, Value::relief_depth);
        of && stores(stage, Value::relief_depth))
        for (int i = 0; i < lanes; ++i)
            if (of[i] < 0)
                return BorderFault{
                    i,
                    fmt::format("relief_depth = {} in lane {}, expected 0 or more", of[i], i % 4)};
    const T* const s = array<T>(values, Value::hit_s);
    const auto* const status = array<std::int32_t>(values, Value::hit_status);
    if (!s || !status || !stores(stage, Value::hit_s)) return std::nullopt;
    for (int i = 0; i < lanes; ++i)
        if (s[i] != s[i] && status[i] == static_cast<int>(Status::hit) && sound_ray<T>(values, i))
            return BorderFault{
                i,
                fmt::format("hit.s is NaN in lane {} with status HIT, expected a number", i % 4)};
    return std::nullopt;
}

bool as_published(const PlannedStage& stage) {
    return std::string_view(stage.info->text.id).find('@') != std::string_view::npos;
}

}  // namespace

std::optional<BorderFault> find_border_fault(const PlannedStage& stage, void* const* values,
                                             int lanes, int scalar_bytes) {
    auto fault = check_codes(stage, values, lanes);
    if (!fault && !as_published(stage))
        fault = scalar_bytes == sizeof(float) ? check_reals<float>(stage, values, lanes)
                                              : check_reals<double>(stage, values, lanes);
    if (fault) fault->text = fmt::format("{} stored {}", stage.info->text.id, fault->text);
    return fault;
}

}  // namespace quadrel
