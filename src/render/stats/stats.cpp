#include "quadrel/stats.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "render/stats/stats_record.hpp"

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

Json to_json(const TouchedStats& touched) {
    return {{"texels", touched.texels}, {"lines", touched.lines}};
}

Json to_json(const TextureStats& texture) {
    Json out{{"material", texture.material},
             {"slot", texture.slot},
             {"file", texture.file},
             {"width", texture.width},
             {"height", texture.height},
             {"levels", texture.levels},
             {"faces", texture.faces},
             {"channels", texture.channels},
             {"non_finite", texture.non_finite}};
    if (texture.touched.empty()) return out;
    TouchedStats sum;
    Json levels = Json::array();
    for (std::size_t level = 0; level < texture.touched.size(); ++level) {
        const TouchedStats& touched = texture.touched[level];
        if (touched.texels == 0) continue;
        sum += touched;
        Json row{{"level", level}};
        row.update(to_json(touched));
        levels.push_back(row);
    }
    out["touched"] = to_json(sum);
    out["touched"]["levels"] = levels;
    return out;
}

Json to_json(const PhaseTime& time) { return {{"wall_ms", time.wall_ms}, {"cpu_ms", time.cpu_ms}}; }

Json to_json(const MaximaStats& maxima) {
    return {{"maps", maxima.maps}, {"bytes", maxima.bytes}, {"wall_ms", maxima.wall_ms}};
}

Json to_json(const KindStats& kinds) {
    Json json = Json::object();
    for (std::size_t k = 0; k < error_kinds; ++k)
        json[error_kind_name(static_cast<ErrorKind>(k))] = kinds.lanes[k];
    return json;
}

/// A share of nothing is none.
Json share_of(bool rays, double share) { return rays ? Json(share) : Json(); }

Json to_json(const CertifiedStats& certified) {
    const bool rays = certified.by_bounds + certified.exactly + certified.not_proven > 0;
    return {{"share", share_of(rays, certified.share())},
            {"by_bounds", certified.by_bounds},
            {"exactly", certified.exactly},
            {"not_proven", certified.not_proven},
            {"without_ray", certified.without_ray}};
}

Json to_json(const CertifiedPixelStats& pixels) {
    const bool rays = pixels.proven + pixels.open + pixels.apart + pixels.ray_not_proven > 0;
    return {{"share", share_of(rays, pixels.share())},
            {"proven", pixels.proven},
            {"open", pixels.open},
            {"apart", pixels.apart},
            {"ray_not_proven", pixels.ray_not_proven},
            {"without_ray", pixels.without_ray}};
}

Json to_json(const IntegralStats& integral) {
    return {{"samples", integral.samples},
            {"least", integral.least},
            {"most", integral.most},
            {"pixels_above_error", integral.above}};
}

// What is baked comes from the file of the heights, or of the layers.
std::string file_of_slot(const Scene& scene, const Material& material, int slot) {
    const auto kind = static_cast<TextureSlot>(slot);
    if (kind == TextureSlot::environment) return scene.environment->faces[0].string();
    return material.textures.at(std::string(slot_name(source_of(kind)))).file.string();
}

/// Integers of 8 and 16 bits stand for finite numbers alone.
bool may_be_non_finite(TexelFormat format) {
    return format == TexelFormat::half || format == TexelFormat::float32;
}

/// Quicker than looking at each texel.
bool all_finite(const float* values, std::size_t count) {
    std::uint32_t greatest = 0;
    for (std::size_t i = 0; i < count; ++i)
        greatest = std::max(greatest, std::bit_cast<std::uint32_t>(values[i]) & 0x7fffffffu);
    return greatest < 0x7f800000u;
}

std::uint64_t count_non_finite(const Texture& texture) {
    if (!may_be_non_finite(texture.format())) return 0;
    const TextureView& view = texture.view();
    const std::size_t texels = static_cast<std::size_t>(view.width[0]) * view.height[0];
    std::uint64_t count = 0;
    for (int face = 0; face < view.faces; ++face) {
        const float* texel = texture.level_texels(0, face);
        if (all_finite(texel, texels * static_cast<std::size_t>(view.channels))) continue;
        for (std::size_t i = 0; i < texels; ++i, texel += view.channels)
            count += std::any_of(texel, texel + view.channels,
                                 [](float value) { return !std::isfinite(value); });
    }
    return count;
}

void record_textures(const PreparedRender& prepared, RenderStats& stats) {
    const Scene& scene = *prepared.scene;
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        for (int slot = 0; slot < texture_slot_count; ++slot) {
            const auto& texture = prepared.plan.textures[m].owned[slot];
            if (!texture) continue;
            const std::string name(slot_name(static_cast<TextureSlot>(slot)));
            const std::string file = file_of_slot(scene, scene.materials[m], slot);
            const TextureView& view = texture->view();
            stats.textures.push_back({scene.materials[m].name,
                                      name,
                                      file,
                                      view.width[0],
                                      view.height[0],
                                      view.levels,
                                      view.faces,
                                      view.channels,
                                      count_non_finite(*texture),
                                      {}});
        }
    }
}

void record_maxima(const PreparedRender& prepared, RenderStats& stats) {
    for (const auto& maxima : prepared.plan.maxima) {
        if (!maxima || maxima->made == 0) continue;
        ++stats.maxima.maps;
        stats.maxima.bytes += maxima->bytes();
        stats.maxima.wall_ms += maxima->wall_ms;
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
    for (const ChannelSource& channel : prepared.channels) {
        stats.certified.drawn |= channel.name == "certified";
        stats.certified_pixels.drawn |= certifies_pixels(channel);
        stats.kinds.drawn |= channel.name == "err.kind" && prepared.plan.judged == nullptr;
    }
    stats.integral.drawn = prepared.plan.integral.has_value();
    record_textures(prepared, stats);
    record_maxima(prepared, stats);
}

namespace {

void record_fetches(const DrawRecord& record, RenderStats& stats) {
    stats.fetches = {};
    stats.fetches_by_kind.clear();
    for (int slot = 0; slot < texture_slot_count; ++slot) {
        const FetchCounters& fetches = record.fetches[static_cast<std::size_t>(slot)];
        stats.fetches += fetches;
        if (fetches.fetches > 0)
            stats.fetches_by_kind[std::string(slot_name(static_cast<TextureSlot>(slot)))] +=
                fetches.fetches;
    }
}

void record_certified_pixels(const DrawRecord& record, CertifiedPixelStats& pixels) {
    for (std::size_t code = 0; code < pixel_reasons; ++code) {
        const auto reason = static_cast<Uncertified>(code);
        std::uint64_t& of = reason == Uncertified::proven   ? pixels.proven
                            : reason == Uncertified::no_ray ? pixels.without_ray
                            : reason == oracle::pixel_open  ? pixels.open
                            : reason == oracle::pixel_apart ? pixels.apart
                                                            : pixels.ray_not_proven;
        of += record.certified_pixels[code];
    }
}

}  // namespace

void record_drawing(const DrawRecord& record, RenderStats& stats) {
    stats.quads += record.quads;
    stats.covered_lanes += record.covered_lanes;
    stats.helper_lanes += record.helper_lanes;
    record_fetches(record, stats);
    CertifiedStats& certified = stats.certified;
    certified.by_bounds += record.certified[static_cast<std::size_t>(Certificate::bounds)];
    certified.exactly += record.certified[static_cast<std::size_t>(Certificate::exact)];
    certified.not_proven += record.certified[0] - record.without_ray;
    certified.without_ray += record.without_ray;
    record_certified_pixels(record, stats.certified_pixels);
    if (stats.integral.drawn)
        stats.integral = {true, record.integral.samples, record.integral.least,
                          record.integral.most, record.integral.above};
    for (std::size_t k = 0; k < error_kinds; ++k) stats.kinds.lanes[k] += record.kinds[k];
    for (const auto& [id, time] : record.stages)
        stats.stages.push_back({id, time.batches, time.lanes, time.fetches,
                                1e-6 * static_cast<double>(time.wall_ns),
                                1e-6 * static_cast<double>(time.cpu_ns)});
    stats.peak_memory_kib = peak_memory_kib();
}

void record_marks(const PreparedRender& prepared, const DrawRecord& record,
                  const TouchedTexels& touched, RenderStats& stats) {
    auto row = stats.textures.begin();
    for (std::uint32_t m = 0; m < prepared.plan.textures.size(); ++m)
        for (int slot = 0; slot < texture_slot_count; ++slot) {
            if (touched.marks(m, slot) == nullptr) continue;
            for (int level = 0; level < row->levels; ++level)
                row->touched.push_back(touched.count(m, slot, level));
            ++row;
        }
    record_fetches(record, stats);  // of all steps; drawing has left out what it could
    stats.has_touched = true;
    stats.touched = touched.total();
    stats.trace_steps = record.trace_steps;
    stats.shadow_steps = record.shadow_steps;
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
             {"maxima", to_json(stats.maxima)},
             {"left_out", stats.left_out},
             {"phases",
              {{"plan", to_json(stats.plan)},
               {"load", to_json(stats.load)},
               {"draw", to_json(stats.draw)}}},
             {"peak_memory_kib", stats.peak_memory_kib}};
    if (stats.certified.drawn) out["certified"] = to_json(stats.certified);
    if (stats.certified_pixels.drawn) out["certified_pixel"] = to_json(stats.certified_pixels);
    if (stats.integral.drawn) out["integral"] = to_json(stats.integral);
    if (stats.kinds.drawn) out["errors"] = to_json(stats.kinds);
    if (stats.has_touched) {
        out["touched"] = to_json(stats.touched);
        out["steps"] = {{"trace", stats.trace_steps}, {"shadow", stats.shadow_steps}};
        out["phases"]["mark"] = to_json(stats.mark);
    }
    for (const StageStats& stage : stats.stages) out["stages"].push_back(to_json(stage));
    for (const TextureStats& texture : stats.textures) out["textures"].push_back(to_json(texture));
    return out.dump(2) + "\n";
}

}  // namespace quadrel
