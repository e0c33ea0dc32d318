// What an exported scene consists of, before it is written.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "export/export.hpp"
#include "export/scene/channels.hpp"
#include "export/scene/export_scene.hpp"
#include "export/scene/texture_files.hpp"
#include "export/scene/uniforms.hpp"
#include "export/scene/vertices.hpp"
#include "quadrel/film/film.hpp"

namespace quadrel {

struct PreparedRender;

/// How a texture with faces is looked up.
enum class TextureShape {
    flat,    ///< one face, or layers one below the other
    layers,  ///< an array
    cube
};

struct ContentTexture {
    std::string name;  ///< a word, the beginning of its files' names
    std::shared_ptr<const Texture> texture;
    TextureShape shape = TextureShape::flat;
    TexelLayout layout;
    int levels = 1;  ///< so many are handed over

    /// Files of a level: the bytes, and decoded.
    std::string bytes_file(int level) const;
    std::string exr_file(int level, int face) const;
    /// Sizes of a level as it is handed over, and rows in the file of bytes.
    LevelSide side(int level) const;
    int rows(int level) const;
    /// Whether levels lie in larger ones (side_of_level).
    bool is_padded() const;
    /// The very bytes of a level, in `layout`.
    std::string bytes(int level, const TexelLayout& layout) const;
};

struct ContentSampler {
    std::string uniform;
    std::size_t texture;  ///< of ExportContent
    SamplerState state;
};

struct ContentMaterial {
    std::size_t material;  ///< of the scene
    std::string name;      ///< a word, the beginning of its shaders' names
    Program program;
    std::vector<std::string> stages;  ///< room/id, in their order
    std::vector<ContentSampler> samplers;
    UniformValues uniforms;  ///< of the material alone
    bool discards = false, writes_depth = false;

    std::string vertex_file(const std::string& language) const;
    std::string fragment_file(const std::string& language) const;
};

struct ExportContent {
    const Scene* scene;
    std::string language;
    std::vector<ExportedChannel> channels;
    std::vector<ProgramPass> passes;
    FrameUniforms frame{};
    std::vector<ContentMaterial> materials;  ///< those that a visible object has
    std::vector<ContentTexture> textures;
    VertexBuffers buffers;
    Film expected;  ///< without planes where no reference is asked for
    Attributes expected_attributes;
    std::shared_ptr<const PreparedRender> prepared{};  ///< what it was gathered from

    bool has_reference() const { return !expected.planes.empty(); }
};

/// Loads, bakes, renders and records. Throws as export_scene does.
ExportContent export_content(const Scene& scene, const SceneExport& options);

/// The same channels and textures with shaders of another language, without a reference: nothing is
/// loaded, baked or drawn again. Throws UsageError for samplers that the language has not; of
/// conventions it asks nothing, which whoever draws it must see to.
ExportContent content_in(const ExportContent& content, const std::string& language);

}  // namespace quadrel
