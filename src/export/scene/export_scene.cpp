#include "export/scene/export_scene.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>

#include "export/scene/manifest.hpp"
#include "export/scene/output_folder.hpp"
#include "film/image_film.hpp"
#include "quadrel/error.hpp"

namespace quadrel {
namespace {

namespace fs = std::filesystem;

/// A file of the folder that is none of `known`; empty if there is none.
std::string foreign_file(const fs::path& folder, const std::set<std::string>& known) {
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string name = entry.path().lexically_relative(folder).generic_string();
        const bool is_folder = entry.is_directory() && !entry.is_symlink();
        if (is_folder ? name != "textures" : known.count(name) == 0) return name;
    }
    return "";
}

/// Files of the export, in the order in which they are written. The folder is synced as a whole.
class Files {
  public:
    explicit Files(const fs::path& folder) : folder_(folder) {}

    void write(const std::string& name, const std::string& bytes) {
        names_.push_back(name);
        std::ofstream out(folder_ / name, std::ios::binary);
        out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        out.close();
        if (!out) throw OutputError(name, std::strerror(errno));
    }
    template <class T>
    void write(const std::string& name, const std::vector<T>& values) {
        write(name,
              std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)));
    }
    const std::vector<std::string>& names() const { return names_; }

  private:
    fs::path folder_;
    std::vector<std::string> names_;
};

void write_texture(const ContentTexture& texture, bool decoded, Files& files) {
    const TextureView& view = texture.texture->view();
    for (int level = 0; level < texture.levels; ++level) {
        files.write(texture.bytes_file(level), texture.bytes(level, texture.layout));
        for (int face = 0; decoded && face < view.faces; ++face)
            files.write(texture.exr_file(level, face),
                        exr_bytes(image_film(texture_level(*texture.texture, level, face), false),
                                  {{"quadrel:mipLevel", fmt::format("{}", level)}}));
    }
}

void write_content(const ExportContent& content, const fs::path& folder) {
    Files files(folder);
    if (!content.textures.empty()) fs::create_directory(folder / "textures");
    for (const ContentMaterial& material : content.materials) {
        files.write(material.vertex_file(content.language), material.program.vertex);
        files.write(material.fragment_file(content.language), material.program.fragment);
    }
    files.write("vertices.bin", content.buffers.vertices);
    files.write("indices.bin", content.buffers.indices);
    for (const ContentTexture& texture : content.textures)
        write_texture(texture, content.has_reference(), files);
    if (content.has_reference())
        files.write("expected.exr", exr_bytes(content.expected, content.expected_attributes));
    files.write("README.md", folder_readme(content));
    Json manifest = manifest_of(content);
    std::vector<std::string> names = files.names();
    names.emplace_back(manifest_name);
    manifest["files"] = names;
    files.write(manifest_name, manifest.dump(2) + "\n");
}

}  // namespace

std::set<std::string> exported_files(const fs::path& folder) {
    std::ifstream in(folder / manifest_name);
    const Json manifest = Json::parse(in, nullptr, false);
    std::set<std::string> files;
    if (!manifest.is_object() || !manifest.contains(manifest_key) || !manifest.contains("files") ||
        !manifest["files"].is_array())
        return files;
    for (const Json& file : manifest["files"])
        if (file.is_string()) files.insert(file.get<std::string>());
    return files;
}

void check_export_folder(const fs::path& folder) {
    const fs::path at = folder_at(folder);
    if (!fs::exists(at)) return;
    if (!fs::is_directory(at))
        throw UsageError(fmt::format("-o: found the file {}, expected a folder", folder.string()));
    const std::set<std::string> known = exported_files(at);
    const std::string foreign = foreign_file(at, known);
    if (foreign.empty()) return;
    throw UsageError(fmt::format("-o: found {} in {}, expected {}", foreign, folder.string(),
                                 known.empty()
                                     ? "a new or empty folder, or an export"
                                     : "nothing there but the export that it would replace"));
}

void export_scene(const Scene& scene, const SceneExport& options, const fs::path& folder) {
    const ExportContent content = export_content(scene, options);
    OutputFolder out(folder);
    try {
        write_content(content, out.path());
    } catch (const fs::filesystem_error& error) {
        throw OutputError(folder.string(), error.code().message());
    }
    out.commit();
}

}  // namespace quadrel
