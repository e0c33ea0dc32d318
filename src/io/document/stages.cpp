#include "io/document/stages.hpp"

#include "quadrel/scene/presets.hpp"

namespace quadrel {

const Json* member_of(const Json* object, const std::string& key) {
    return object != nullptr && object->is_object() && object->contains(key) ? &(*object)[key]
                                                                             : nullptr;
}

std::string text_of(const Json* value) {
    return value != nullptr && value->is_string() ? value->get<std::string>() : "";
}

std::string named_stage(const Json* owner, const std::string& room) {
    const Json* stage = member_of(owner, room);
    if (stage != nullptr) return text_of(stage->is_object() ? member_of(stage, "id") : stage);
    const Preset* preset = find_preset(text_of(member_of(owner, "preset")));
    if (preset == nullptr) return "";
    return room == "frame" ? preset->frame : room == "trace" ? preset->trace : "";
}

}  // namespace quadrel
