#include "cli/shell/values.hpp"

#include <CLI/CLI.hpp>
#include <set>

#include "cli/bake_layers.hpp"
#include "cli/common/arguments.hpp"
#include "cli/explain/explanations.hpp"
#include "cli/shell/scene_keys.hpp"
#include "quadrel/bake/bake.hpp"
#include "quadrel/film/channels.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/relief/registry.hpp"
#include "quadrel/scene/load.hpp"

namespace quadrel::cli {
namespace {

using Add = void (*)(const TypedLine& line, Candidates& to);

void add_scenes(const TypedLine& line, Candidates& to) {
    for (const std::string& name : installed_scenes()) to.add(line.before + name);
    to.add_files({".json", ".glib"});
}

void add_scenes_and_images(const TypedLine& line, Candidates& to) {
    add_scenes(line, to);
    to.add_files();
}

void add_definitions(const TypedLine& line, Candidates& to) {
    const std::string scene = line.positional.empty() ? "" : line.positional.front();
    add_assignments(line.begun, line.before, scene, line.defines, to);
}

/// Every channel, and the groups that their names begin with.
std::vector<Candidate> channel_words() {
    std::vector<Candidate> words;
    std::set<std::string> groups;
    for (const ChannelInfo& channel : channel_table()) {
        if (channel.name.find('<') != std::string::npos) continue;
        const std::size_t dot = channel.name.rfind('.');
        const std::string group = channel.name.substr(0, dot);
        const bool is_group = dot != std::string::npos && find_channel(group) == nullptr;
        if (is_group && groups.insert(group).second) words.push_back({group, "group of channels"});
        words.push_back({channel.name, channel.meaning});
    }
    return words;
}

/// The last of a list, behind those before it.
void add_channels(const TypedLine& line, Candidates& to) {
    const std::size_t comma = line.begun.rfind(',');
    const std::string kept = comma == std::string::npos ? "" : line.begun.substr(0, comma + 1);
    for (const Candidate& channel : channel_words())
        to.add(line.before + kept + channel.word, channel.meaning);
}

/// "CHANNEL=", in front of a number or a file.
void add_channel_names(const TypedLine& line, Candidates& to) {
    for (const Candidate& channel : channel_words())
        to.add(line.before + channel.word + "=", channel.meaning);
}

void add_injections(const TypedLine& line, Candidates& to) {
    if (line.begun.find('=') == std::string::npos)
        add_channel_names(line, to);
    else
        to.add_files({".exr"});
}

void add_kinds(const TypedLine& line, Candidates& to) {
    for (const BakeKindInfo& kind : bake_kinds()) to.add(line.before + kind.name, kind.text);
    to.add(line.before + depth_layers_kind, "depths of a closed mesh, front and back in turn");
}

void add_compressions(const TypedLine& line, Candidates& to) {
    for (const auto& [name, compression] : exr_compressions)
        to.add(line.before + std::string(name));
}

void add_limits(const TypedLine& line, Candidates& to) {
    for (const char* const name : {"vulkan", "d3d", "gl", "webgpu", "rounding"})
        to.add(line.before + name);
}

/// As ID, or as ROOM/ID where that is begun.
void add_stage_ids(const TypedLine& line, Candidates& to) {
    const bool by_room = line.begun.find('/') != std::string::npos;
    for (const StageInfo& stage : all_stages())
        to.add(line.before + (by_room ? std::string(stage.text.room) + "/" : "") + stage.text.id,
               stage.text.summary);
}

void add_explained(const TypedLine& line, Candidates& to) {
    add_key_paths(line.begun, to);
    for (const std::string& name : explained_names()) to.add(name);
}

void add_meshes(const TypedLine& line, Candidates& to) {
    for (const char* const shape : {"cube", "icosahedron", "sphere", "torus"})
        to.add(line.before + shape);
    to.add_files({".obj", ".gltf", ".glb"});
}

void add_any_files(const TypedLine&, Candidates& to) { to.add_files(); }

void add_plugins(const TypedLine&, Candidates& to) { to.add_files({".so"}); }

void add_exrs(const TypedLine&, Candidates& to) { to.add_files({".exr"}); }

void add_jsons(const TypedLine&, Candidates& to) { to.add_files({".json"}); }

void add_verb_names(const TypedLine& line, Candidates& to) {
    const CLI::App* program = line.at;
    while (program->get_parent() != nullptr) program = program->get_parent();
    for (const CLI::App* const verb : program->get_subcommands(nullptr))
        to.add(verb->get_name(), verb->get_description());
}

struct NamedValues {
    std::string_view name;  ///< of an option or argument, whatever verb has it
    Add add;
};

constexpr NamedValues by_name[] = {{"--define", add_definitions},
                                   {"--each", add_definitions},
                                   {"--channels", add_channels},
                                   {"--abs", add_channel_names},
                                   {"--rel", add_channel_names},
                                   {"--ulp", add_channel_names},
                                   {"--map", add_channel_names},
                                   {"--fraction", add_channel_names},
                                   {"--inject", add_injections},
                                   {"--kind", add_kinds},
                                   {"--limits", add_limits},
                                   {"--compression", add_compressions},
                                   {"--stage", add_stage_ids},
                                   {"--plugin", add_plugins},
                                   {"--mesh", add_meshes},
                                   {"--blame", add_scenes},
                                   {"--merge", add_any_files},
                                   {"--output", add_any_files},
                                   {"--packed", add_any_files},
                                   {"scene", add_scenes},
                                   {"file", add_scenes_and_images},
                                   {"inputs", add_scenes_and_images},
                                   {"reference", add_scenes_and_images},
                                   {"test", add_any_files},
                                   {"image", add_any_files},
                                   {"images", add_any_files},
                                   {"heights", add_any_files},
                                   {"names", add_explained},
                                   {"plan", add_jsons},
                                   {"parts", add_exrs},
                                   {"page", add_verb_names}};

std::string name_of(const CLI::Option& option) {
    return option.nonpositional()
               ? "--" + (option.get_lnames().empty() ? "" : option.get_lnames()[0])
               : option.get_name(true);
}

/// "OUT.exr": files that end so.
std::string ending_of(const std::string& type) {
    const std::size_t dot = type.rfind('.');
    return type.starts_with("OUT.") && dot != type.npos ? type.substr(dot) : "";
}

}  // namespace

std::vector<std::string> listed_words(const std::string& type) {
    const std::size_t begin = type.find('{'), end = type.find('}');
    if (begin == type.npos || end == type.npos || end < begin) return {};
    return parse_list("", type.substr(begin + 1, end - begin - 1));
}

void add_values_of(const CLI::Option& option, const TypedLine& line, Candidates& to) {
    const std::string type = option.get_type_name(), ending = ending_of(type);
    const std::vector<std::string> words = listed_words(type);
    for (const std::string& word : words) to.add(line.before + word);
    if (!words.empty()) return;
    if (!ending.empty()) return to.add_files({ending});
    const std::string name = name_of(option);
    for (const NamedValues& row : by_name)
        if (row.name == name) row.add(line, to);
}

}  // namespace quadrel::cli
