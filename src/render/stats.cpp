#include "quadrel/stats.hpp"

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "render/stats_record.hpp"

namespace quadrel {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const PrimitiveCounts& counts) {
    return {{"submitted", counts.submitted}, {"non_finite", counts.non_finite},
            {"outside", counts.outside},     {"clipped", counts.clipped},
            {"zero_area", counts.zero_area}, {"culled", counts.culled},
            {"off_frame", counts.off_frame}, {"drawn", counts.drawn}};
}

Json to_json(const StageStats& stage) {
    return {{"id", stage.id},           {"batches", stage.batches}, {"lanes", stage.lanes},
            {"fetches", stage.fetches}, {"wall_ms", stage.wall_ms}, {"cpu_ms", stage.cpu_ms}};
}

Json to_json(const TextureStats& texture) {
    return {{"material", texture.material}, {"slot", texture.slot},
            {"file", texture.file},         {"width", texture.width},
            {"height", texture.height},     {"levels", texture.levels},
            {"faces", texture.faces},       {"channels", texture.channels}};
}

void record_textures(const PreparedRender& prepared, RenderStats& stats) {
    const Scene& scene = *prepared.scene;
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        for (int slot = 0; slot < texture_slot_count; ++slot) {
            const auto& texture = prepared.plan.textures[m].owned[slot];
            if (!texture) continue;
            const std::string name(slot_name(static_cast<TextureSlot>(slot)));
            const auto found = scene.materials[m].textures.find(name);
            const std::string file = found != scene.materials[m].textures.end()
                                         ? found->second.file.string()
                                         : scene.environment->faces[0].string();
            const TextureView& view = texture->view();
            stats.textures.push_back({scene.materials[m].name, name, file, view.width[0],
                                      view.height[0], view.levels, view.faces, view.channels});
        }
    }
}

}  // namespace

std::uint64_t peak_memory_kib() {
    rusage usage{};
    return getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<std::uint64_t>(usage.ru_maxrss) : 0;
}

void record_plan(const PreparedRender& prepared, const RenderOptions& options, RenderStats& stats) {
    const KernelTable& kernels = *prepared.plan.kernels;
    stats.isa = kernels.isa;
    stats.number = options.number;
    stats.packet_lanes = kernels.lanes;
    stats.pixels = prepared.window.area();
    stats.primitives = prepared.geometry.counts;
    stats.left_out = left_out(prepared);
    record_textures(prepared, stats);
}

void record_drawing(const DrawRecord& record, RenderStats& stats) {
    stats.quads += record.quads;
    stats.covered_lanes += record.covered_lanes;
    stats.helper_lanes += record.helper_lanes;
    for (int slot = 0; slot < texture_slot_count; ++slot) {
        const FetchCounters& fetches = record.fetches[static_cast<std::size_t>(slot)];
        stats.fetches += fetches;
        if (fetches.fetches > 0)
            stats.fetches_by_kind[std::string(slot_name(static_cast<TextureSlot>(slot)))] +=
                fetches.fetches;
    }
    for (const auto& [id, time] : record.stages)
        stats.stages.push_back({id, time.batches, time.lanes, time.fetches,
                                1e-6 * static_cast<double>(time.wall_ns),
                                1e-6 * static_cast<double>(time.cpu_ns)});
    stats.peak_memory_kib = peak_memory_kib();
}

std::string to_json(const RenderStats& stats) {
    Json out{{"isa", stats.isa},
             {"number", stats.number},
             {"packet_lanes", stats.packet_lanes},
             {"pixels", stats.pixels},
             {"quads", stats.quads},
             {"covered_lanes", stats.covered_lanes},
             {"helper_lanes", stats.helper_lanes},
             {"fetches",
              {{"look_ups", stats.fetches.fetches},
               {"nan_coordinates", stats.fetches.nan_coordinates},
               {"huge_coordinates", stats.fetches.huge_coordinates},
               {"by_kind", stats.fetches_by_kind}}},
             {"primitives", to_json(stats.primitives)},
             {"stages", Json::array()},
             {"textures", Json::array()},
             {"left_out", stats.left_out},
             {"plan_ms", stats.plan_ms},
             {"load_ms", stats.load_ms},
             {"draw_ms", stats.draw_ms},
             {"peak_memory_kib", stats.peak_memory_kib}};
    for (const StageStats& stage : stats.stages) out["stages"].push_back(to_json(stage));
    for (const TextureStats& texture : stats.textures) out["textures"].push_back(to_json(texture));
    return out.dump(2) + "\n";
}

}  // namespace quadrel
