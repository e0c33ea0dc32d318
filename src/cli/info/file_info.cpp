#include "cli/info/file_info.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <limits>

#include "cli/info/mesh_info.hpp"
#include "file/read_file.hpp"
#include "quadrel/film/exr.hpp"
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

Json integer_plane_info(const Plane& plane) {
    const auto [low, high] = std::minmax_element(plane.bits.begin(), plane.bits.end());
    return {{"min", *low}, {"max", *high}};
}

/// Minimum and maximum of the finite values; null if there are none.
Json float_plane_info(const Plane& plane) {
    float low = std::numeric_limits<float>::infinity(), high = -low;
    std::size_t nan = 0, infinite = 0;
    for (const std::uint32_t bits : plane.bits) {
        const float value = std::bit_cast<float>(bits);
        if (std::isnan(value)) {
            ++nan;
        } else if (std::isinf(value)) {
            ++infinite;
        } else {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
    const bool any = low <= high;
    return {{"min", any ? Json(low) : Json()},
            {"max", any ? Json(high) : Json()},
            {"nan", nan},
            {"infinite", infinite}};
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

Json exr_info(const std::string& file, const ImageSelection& selection) {
    if (selection.empty()) {
        const std::vector<ExrPartInfo> parts = exr_parts(file);
        if (parts.size() > 1) return parts_info(parts);
    }
    const ExrFile exr = read_exr(file, selection);
    Json channels = Json::array();
    for (const Plane& plane : exr.film.planes) {
        Json row = {{"name", plane.name}, {"type", stored_text(exr.stored.at(plane.name))}};
        row.update(plane.type == ChannelType::float32 ? float_plane_info(plane)
                                                      : integer_plane_info(plane));
        channels.push_back(row);
    }
    Json info = {{"kind", "EXR image"},
                 {"frame", window_text(exr.film.frame)},
                 {"window", window_text(exr.film.window)},
                 {"channels", channels},
                 {"attributes", exr.attributes},
                 {"hash", film_hash(exr.film)}};
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
        (bare_name && !std::filesystem::exists(path)))
        return scene_info(file);
    return image_info(file, selection);
}

}  // namespace quadrel::cli
