// The parts of a scene file's reader, one per file.
#pragma once

#include <map>
#include <string>

#include "file/file_store.hpp"
#include "io/document/value.hpp"
#include "quadrel/scene/scene.hpp"

namespace quadrel {

/// Frame-wide keys: size, samples, conventions, hardware and so on.
void read_settings(Fields& scene, Scene& out);

/// The camera for the settings already read into `scene`.
Camera read_camera(const SceneValue& value, const Scene& scene);

/// A texture given in place. The sampler's hardware terms are those of `hardware`.
TextureReference read_texture(const SceneValue& value, Hardware hardware);
Environment read_environment(const SceneValue& value, Hardware hardware);

using TextureTable = std::map<std::string, TextureReference>;

Material read_material(const SceneValue& value, const std::string& name,
                       const TextureTable& textures, Hardware hardware);

/// The texture of a material's slot, or of what else reads one: by name, or given in place.
TextureReference read_slot(const SceneValue& value, const TextureTable& textures,
                           Hardware hardware);
/// 16 numbers row by row, or scale, rotate and offset.
glm::mat4 read_texture_matrix(const SceneValue& value);

/// What meshes are made with.
struct MeshSources {
    const TextureTable& textures;
    Hardware hardware;
    TextureCache& cache;
    std::vector<std::string>& notes;  ///< get what is ignored of files
};

/// A shape or file.
Mesh read_mesh(const SceneValue& value, const MeshSources& sources);

/// `mesh` as the object of a "displace" says.
Mesh read_displaced(const SceneValue& value, const Mesh& mesh, const MeshSources& sources);

Light read_light(const SceneValue& value);

/// The matrix of a "transform": 16 numbers row by row, or a list of steps, the first one first.
glm::mat4 read_transform(const SceneValue& value);
/// 16 finite numbers, row by row.
glm::dmat4 read_matrix(const SceneValue& value);

/// A file that the scene names, relative to the scene file. Throws InputError if it is missing.
std::filesystem::path read_path(const SceneValue& value);

/// Canonical JSON (sorted keys, whole numbers as integers) with every file path replaced by
/// "sha256:" and the content's hash; the bytes of images stay in `images`, to be decoded.
std::string canonical_scene(const SceneDocument& document, FileStore& images);

}  // namespace quadrel
