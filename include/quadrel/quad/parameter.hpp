// The parameters of a stage: numbers, described. The numbers of a choice have names.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

namespace quadrel {

/// A value of a choice and what scenes call it: a name that is no number.
struct ValueName {
    std::int32_t value;
    const char* name;
};

/// A parameter of a stage, type-erased: `set` writes a value into a Params.
struct ParameterText {
    const char* name;
    const char* unit;
    const char* meaning;
    double minimum, maximum, default_value;
    bool integer;
    void (*set)(void* params, double value);
    const ValueName* value_names;  ///< of a choice, in ascending order of values; else null
    std::int32_t value_name_count;
};

inline std::span<const ValueName> value_names(const ParameterText& parameter) {
    return {parameter.value_names, static_cast<std::size_t>(parameter.value_name_count)};
}

/// What the value is called; empty where it has no name.
inline std::string_view name_of_value(const ParameterText& parameter, double value) {
    for (const ValueName& row : value_names(parameter))
        if (row.value == value) return row.name;
    return {};
}

namespace detail {
template <class T>
struct MemberOf;
template <class P, class M>
struct MemberOf<M P::*> {
    using Struct = P;
    using Type = M;
};
}  // namespace detail

/// Describes Params member `member`.
template <auto member>
constexpr ParameterText parameter(const char* name, const char* unit, const char* meaning,
                                  double minimum, double maximum, double default_value) {
    using Of = detail::MemberOf<decltype(member)>;
    return {name,
            unit,
            meaning,
            minimum,
            maximum,
            default_value,
            std::is_integral_v<typename Of::Type>,
            [](void* params, double value) {
                static_cast<typename Of::Struct*>(params)->*member =
                    static_cast<typename Of::Type>(value);
            },
            nullptr,
            0};
}

/// Describes Params member `member`, an integer that means one of a few things. `names` live as
/// long as the process, in ascending order of values.
template <auto member, std::size_t n>
constexpr ParameterText choice(const char* name, const char* meaning, const ValueName (&names)[n],
                               std::int32_t default_value) {
    static_assert(std::is_integral_v<typename detail::MemberOf<decltype(member)>::Type>);
    ParameterText text =
        parameter<member>(name, "1", meaning, names[0].value, names[n - 1].value, default_value);
    text.value_names = names;
    text.value_name_count = static_cast<std::int32_t>(n);
    return text;
}

inline constexpr ValueName off_on[] = {{0, "off"}, {1, "on"}};

struct NoParams {};
inline constexpr std::array<ParameterText, 0> no_parameters{};

}  // namespace quadrel
