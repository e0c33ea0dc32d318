#include "conformance/judge/groups.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string_view>

#include "render/plan/plan.hpp"

namespace quadrel::conformance {
namespace {

struct KnownGroup {
    GroupKind kind;
    const char* name;
    std::vector<std::string_view> channels;  ///< a channel, or what stands before its dot
};

const std::vector<KnownGroup>& known_groups() {
    static const std::vector<KnownGroup> groups{
        {GroupKind::coverage, "coverage", {"A", "depth", "id", "quad"}},
        {GroupKind::geometry, "uv", {"P", "uv", "Ng", "bary"}},
        {GroupKind::derivatives, "derivatives", {"dUVdx", "dUVdy", "dPdx", "dPdy"}},
        {GroupKind::level, "level", {"lod"}},
        {GroupKind::frame,
         "frame",
         {"relief.depth", "T", "B.X", "B.Y", "B.Z", "frame_normal", "J", "r", "K"}},
        {GroupKind::hit, "hit", {"hit", "frag.depth", "Z"}},
        {GroupKind::normal, "normal", {"N"}},
        {GroupKind::shadow, "shadow", {"shadow"}},
        {GroupKind::occlusion, "occlusion", {"occlusion"}},
        {GroupKind::color, "color", {"light", "R", "G", "B"}},
    };
    return groups;
}

bool belongs(const std::string& channel, const KnownGroup& group) {
    return std::ranges::any_of(group.channels, [&](std::string_view name) {
        if (channel == name) return true;
        // "B" is blue, and B.X is not below it.
        return name != "B" && channel.starts_with(name) && channel[name.size()] == '.';
    });
}

/// Values that a search of the scene stores.
ValueSet values_of_searches(const Scene& scene) {
    ValueSet values;
    for (const Material& material : scene.materials)
        for (const PlannedStage& stage : material_stages(scene, material))
            if (std::string_view(stage.info->text.room) == "trace")
                for (const Value v : stage.info->outputs) values.set(static_cast<std::size_t>(v));
    return values;
}

}  // namespace

std::vector<Group> groups_of(const Scene& scene, const Film& reference, const Film& found) {
    const ValueSet of_searches = values_of_searches(scene);
    std::vector<Group> groups;
    for (const KnownGroup& known : known_groups()) groups.push_back({known.kind, known.name, {}});
    for (const Plane& plane : found.planes) {
        if (reference.find(plane.name) == nullptr) continue;
        const auto known = std::ranges::find_if(
            known_groups(), [&](const auto& g) { return belongs(plane.name, g); });
        if (known == known_groups().end())
            throw std::logic_error("no group of channels has " + plane.name);
        const bool is_turned =
            known->kind == GroupKind::frame &&
            of_searches[static_cast<std::size_t>(channel_source(plane.name).value)];
        const GroupKind kind = is_turned ? GroupKind::hit : known->kind;
        std::ranges::find(groups, kind, &Group::kind)->channels.push_back(plane.name);
    }
    std::erase_if(groups, [](const Group& group) { return group.channels.empty(); });
    return groups;
}

std::vector<std::string> injectable(const std::vector<std::string>& channels) {
    std::vector<std::string> names;
    std::set<int> slots;  // shadow.visibility is light 0's
    for (const std::string& name : channels) {
        const ChannelSource source = channel_source(name);
        if (source.kind == ChannelSource::Kind::value && slots.insert(source.slot()).second)
            names.push_back(name);
    }
    return names;
}

}  // namespace quadrel::conformance
