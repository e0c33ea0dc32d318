#include "render/registry/stage_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

namespace quadrel {
namespace {

using Fault = std::optional<StageFault>;

/// Rooms in the order of the data flow, as the stages that there are name them.
std::vector<std::string> rooms_of(std::span<const StageInfo> stages) {
    std::vector<std::string> rooms;
    for (const StageInfo& stage : stages)
        if (std::find(rooms.begin(), rooms.end(), stage.text.room) == rooms.end())
            rooms.emplace_back(stage.text.room);
    return rooms;
}

/// A scene cannot choose these: they always run.
bool chosen_by_scenes(const std::string& room) {
    return room != "quad" && room != "depth" && room != "oracle" && room != "hit";
}

bool is_word(const char* text) {
    if (text == nullptr || *text == 0) return false;
    for (; *text != 0; ++text) {
        const bool letter = (*text >= 'a' && *text <= 'z') || (*text >= 'A' && *text <= 'Z');
        const bool digit = *text >= '0' && *text <= '9';
        if (!letter && !digit && std::string_view("-_@.").find(*text) == std::string_view::npos)
            return false;
    }
    return true;
}

Fault text_fault(const StageRow& row) {
    const char* id = row.text.id;
    if (!is_word(id)) return StageFault{"", "a stage without a proper id", "letters, digits, -_@."};
    if (id == std::string_view("none")) return StageFault{id, "the id none", "another id"};
    if (row.not_reproduced == nullptr)
        return StageFault{id, "not_reproduced is null", "a text, which may be empty"};
    for (const char* text : {row.text.room, row.text.summary, row.text.source})
        if (text == nullptr || *text == 0)
            return StageFault{id, "an empty text", "id, room, summary and source"};
    return std::nullopt;
}

Fault id_fault(const StageRow& row, std::span<const StageInfo> others) {
    for (const StageInfo& other : others)
        if (other.text.id == std::string_view(row.text.id))
            return StageFault{row.text.id, "the id of another stage", "an id of its own"};
    return std::nullopt;
}

Fault room_fault(const StageRow& row, const std::vector<std::string>& rooms) {
    std::vector<std::string> choices;
    for (const std::string& room : rooms)
        if (chosen_by_scenes(room)) choices.push_back(room);
    if (std::find(choices.begin(), choices.end(), row.text.room) != choices.end())
        return std::nullopt;
    return StageFault{row.text.id, fmt::format("room \"{}\"", row.text.room),
                      fmt::format("one of {}", fmt::join(choices, ", "))};
}

template <class T>
bool in_range(const T* list, std::int32_t count, T end) {
    return count >= 0 && std::all_of(list, list + count, [end](T x) {
               return x >= T(0) && static_cast<int>(x) < static_cast<int>(end);
           });
}

Fault list_fault(const StageRow& row) {
    const bool known = in_range(row.inputs, row.input_count, Value::count) &&
                       in_range(row.outputs, row.output_count, Value::count) &&
                       in_range(row.textures, row.texture_count, TextureSlot::count);
    if (!known) return StageFault{row.text.id, "an unknown value or texture", "known ones"};
    if (row.output_count == 0) return StageFault{row.text.id, "no outputs", "at least one"};
    if (row.run == nullptr || row.set_defaults == nullptr || row.params_size < 0)
        return StageFault{row.text.id, "no function", "one for each number type"};
    return std::nullopt;
}

bool stores(const StageInfo& stage, Value v) {
    return std::find(stage.outputs.begin(), stage.outputs.end(), v) != stage.outputs.end();
}

/// Among the rooms up to `room`, without itself (`end` false) or with it.
bool stored_before(Value v, std::span<const StageInfo> others,
                   const std::vector<std::string>& rooms, const std::string& room) {
    const auto own = std::find(rooms.begin(), rooms.end(), room);
    return std::any_of(others.begin(), others.end(), [&](const StageInfo& stage) {
        return stores(stage, v) && std::find(rooms.begin(), own, stage.text.room) != own;
    });
}

Fault input_fault(const StageRow& row, std::span<const StageInfo> others,
                  const std::vector<std::string>& rooms) {
    for (int i = 0; i < row.input_count; ++i) {
        if (stored_before(row.inputs[i], others, rooms, row.text.room)) continue;
        return StageFault{row.text.id, fmt::format("input {}", info(row.inputs[i]).name),
                          fmt::format("a value that is stored before room {}", row.text.room)};
    }
    return std::nullopt;
}

Fault output_fault(const StageRow& row, std::span<const StageInfo> others) {
    for (int i = 0; i < row.output_count; ++i) {
        const Value v = row.outputs[i];
        const bool of_room = std::any_of(others.begin(), others.end(), [&](const StageInfo& stage) {
            return stage.text.room == std::string_view(row.text.room) && stores(stage, v);
        });
        if (of_room) continue;
        return StageFault{row.text.id, fmt::format("output {}", info(v).name),
                          fmt::format("a value that room {} stores", row.text.room)};
    }
    return std::nullopt;
}

/// Words that -D does not take for another kind of value.
bool is_value_name(const char* text) {
    const std::string_view name = is_word(text) ? text : "";
    const bool begins = !name.empty() && name.find_first_of("0123456789-_@.") != 0;
    return begins && name != "true" && name != "false" && name != "null";
}

bool names_are_sound(const ParameterText& p) {
    const int count = p.value_name_count;
    if (count == 0) return true;
    if (count < 0 || p.value_names == nullptr || !p.integer) return false;
    std::set<std::string> names;
    for (int i = 0; i < count; ++i) {
        const auto [value, name] = p.value_names[i];
        if (!is_value_name(name) || !names.insert(name).second) return false;
        if (value < p.minimum || value > p.maximum) return false;
        if (i > 0 && value <= p.value_names[i - 1].value) return false;
    }
    return true;
}

Fault parameter_fault(const StageRow& row) {
    std::set<std::string> names;
    for (int i = 0; i < row.parameter_count; ++i) {
        const ParameterText& p = row.parameters[i];
        const bool sound = is_word(p.name) && p.unit != nullptr && p.meaning != nullptr &&
                           p.set != nullptr && p.minimum <= p.default_value &&
                           p.default_value <= p.maximum && names.insert(p.name).second;
        if (!sound)
            return StageFault{row.text.id, fmt::format("parameter {}", p.name ? p.name : ""),
                              "a name of its own, a meaning, minimum <= default <= maximum"};
        if (!names_are_sound(p))
            return StageFault{row.text.id, fmt::format("parameter {}", p.name),
                              "names of their own for values that the integer takes, ascending"};
    }
    return std::nullopt;
}

}  // namespace

std::optional<StageFault> find_fault(const StageRow& row, std::span<const StageInfo> others) {
    const std::vector<std::string> rooms = rooms_of(others);
    if (Fault fault = text_fault(row)) return fault;
    if (Fault fault = id_fault(row, others)) return fault;
    if (Fault fault = room_fault(row, rooms)) return fault;
    if (Fault fault = list_fault(row)) return fault;
    if (Fault fault = input_fault(row, others, rooms)) return fault;
    if (Fault fault = output_fault(row, others)) return fault;
    return parameter_fault(row);
}

}  // namespace quadrel
