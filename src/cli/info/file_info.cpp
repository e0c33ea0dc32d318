#include "cli/info/file_info.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <fstream>

#include "cli/info/mesh_info.hpp"
#include "file/read_file.hpp"
#include "film/plane_summary.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/render.hpp"
#include "quadrel/scene/load.hpp"
#include "quadrel/scene/mesh_file.hpp"
#include "quadrel/texture/image.hpp"
#include "render/plan/names.hpp"
#include "texture/texel_format.hpp"

namespace quadrel::cli {
namespace {

bool begins_like_exr(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    char magic[4] = {};
    return stream.read(magic, 4) && std::string_view(magic, 4) == "\x76\x2f\x31\x01";
}

std::string window_text(const Window& window) {
    return fmt::format("{}x{} at {},{}", window.width(), window.height(), window.x0, window.y0);
}

const char* stored_text(StoredType type) {
    if (type == StoredType::half) return "half";
    return type == StoredType::float32 ? "float" : "uint";
}

/// Minimum and maximum are null if no value is finite.
Json summary_json(const PlaneSummary& summary, ChannelType type) {
    if (type == ChannelType::uint32) return {{"min", summary.least}, {"max", summary.most}};
    const bool any = summary.low <= summary.high;
    return {{"min", any ? Json(summary.low) : Json()},
            {"max", any ? Json(summary.high) : Json()},
            {"nan", summary.nan},
            {"infinite", summary.infinite}};
}

/// Several parts of which none was named: an overview of them, and the first one's attributes.
Json parts_info(const std::vector<ExrPartInfo>& parts) {
    Json rows = Json::array();
    for (const ExrPartInfo& part : parts)
        rows.push_back({{"part", rows.size()},
                        {"name", part.name},
                        {"frame", window_text(part.frame)},
                        {"window", window_text(part.window)},
                        {"channels", fmt::format("{}", fmt::join(part.channels, " "))}});
    return {{"kind", "EXR image of several parts"},
            {"parts", rows},
            {"attributes", parts[0].attributes}};
}

Json channel_rows(const ExrFile& exr, const std::vector<PlaneSummary>& summaries) {
    Json rows = Json::array();
    for (std::size_t i = 0; i < summaries.size(); ++i) {
        const Plane& plane = exr.film.planes[i];
        Json row = {{"name", plane.name}, {"type", stored_text(exr.stored.at(plane.name))}};
        row.update(summary_json(summaries[i], plane.type));
        rows.push_back(row);
    }
    return rows;
}

/// Whether a part may not fit into memory at a time.
bool is_large(const std::vector<ExrPartInfo>& parts) {
    return std::any_of(parts.begin(), parts.end(), [](const ExrPartInfo& part) {
        return part.window.area() * part.channels.size() >
               static_cast<std::size_t>(most_film_values);
    });
}

Json exr_info(const std::string& file, const ImageSelection& selection) {
    const std::vector<ExrPartInfo> parts = exr_parts(file);
    if (selection.empty() && parts.size() > 1) return parts_info(parts);
    std::vector<PlaneSummary> summaries;
    const auto add = [&](const Film& film) {
        summaries.resize(film.planes.size());
        tbb::parallel_for(std::size_t(0), summaries.size(),
                          [&](std::size_t i) { summaries[i].add(film.planes[i]); });
    };
    ExrFile exr;
    std::string hash = "none: more than 2^31 values";
    if (is_large(parts)) {
        exr = read_exr_in_bands(file, selection, add);
    } else {
        exr = read_exr(file, selection);
        add(exr.film);
        hash = film_hash(exr.film);
    }
    Json info = {{"kind", "EXR image"},
                 {"frame", window_text(exr.film.frame)},
                 {"window", window_text(exr.film.window)},
                 {"channels", channel_rows(exr, summaries)},
                 {"attributes", exr.attributes},
                 {"hash", hash}};
    if (exr.parts.size() > 1) info["parts"] = exr.parts;
    return info;
}

Json image_info(const std::string& file, const ImageSelection& selection) {
    const Image image = load_image(file, NotFinite::count, "", selection);
    return {{"kind", "image"},
            {"size", fmt::format("{}x{}", image.width, image.height)},
            {"channels", image.channels},
            {"format", format_name(image.format)},
            {"not_finite", image.not_finite}};
}

Json object_info(const Scene& scene, const Object& object) {
    const Mesh& mesh = scene.meshes.at(object.mesh);
    return {{"name", object.name},
            {"triangles", mesh.triangles.size()},
            {"vertices", mesh.positions.size()},
            {"material", scene.materials.at(object.material).name}};
}

Json texture_rows(const Scene& scene) {
    Json rows = Json::array();
    for (const Material& material : scene.materials)
        for (const auto& [slot, texture] : material.textures)
            rows.push_back({{"material", material.name},
                            {"slot", slot},
                            {"file", texture.file.string()},
                            {"flip_v", texture.flip_v}});
    return rows;
}

Json scene_info(const std::string& file) {
    const Scene scene = load_scene(file);
    explain(scene, {});  // throws where it could not be rendered
    Json objects = Json::array();
    for (const Object& object : scene.objects) objects.push_back(object_info(scene, object));
    return {{"kind", "scene"},
            {"file", scene.file.string()},
            {"size", fmt::format("{}x{}", scene.width, scene.height)},
            {"samples", scene.samples},
            {"conventions", name_of(scene.conventions)},
            {"lights", scene.lights.size()},
            {"objects", objects},
            {"textures", texture_rows(scene)},
            {"hash", scene.hash}};
}

}  // namespace

Json file_info(const std::string& file, const ImageSelection& selection) {
    const std::filesystem::path path(file);
    std::error_code error;
    if (std::filesystem::is_fifo(path, error))
        throw InputError(file, "", reason_not_to_read(path), "a file");
    if (begins_like_exr(file)) return exr_info(file, selection);
    if (is_mesh_file(path)) return mesh_info(file);
    const bool bare_name = path.extension().empty() && !path.has_parent_path();
    if (path.extension() == ".json" || path.extension() == ".glib" ||
        (bare_name && !std::filesystem::exists(path, error) && !error))
        return scene_info(file);
    return image_info(file, selection);
}

}  // namespace quadrel::cli
