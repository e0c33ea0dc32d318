#include <fmt/format.h>

#include "io/scene/read.hpp"
#include "quadrel/scene/displace.hpp"
#include "text/printable.hpp"

namespace quadrel {
namespace {

constexpr Word<CellSplit> split_words[] = {
    {"main", CellSplit::main}, {"anti", CellSplit::anti}, {"min", CellSplit::min}};
constexpr Word<int> cell_words[] = {{"texels", 0}};

TextureReference read_heights(const SceneValue& value, const MeshSources& sources) {
    if (value.json().is_object() && value.json().contains("noise"))
        value.fail("noise", "a texture: vertices stand at the corners of its cells");
    TextureReference reference = read_slot(value, sources.textures, sources.hardware);
    if (reference.allow_nan)
        value.fail("a texture with allow_nan", "heights that are finite, as vertices are");
    return reference;
}

/// Level 0 of the channel that a material's heights are, too.
std::shared_ptr<const Texture> load_heights(const TextureReference& reference,
                                            TextureCache& cache) {
    TextureOptions options;
    options.swizzle = reference.swizzle.empty() ? "r" : reference.swizzle;
    options.srgb = reference.srgb;
    options.format = reference.format;
    options.mip_rule = MipRule::none;
    options.flip_v = reference.flip_v;
    options.key = reference.key;
    return cache.load(reference.file, options, NotFinite::refuse, reference.selection);
}

std::string with_memory(std::uint64_t triangles, std::uint64_t bytes) {
    return fmt::format("{} triangles ({} MiB of memory when drawn)", triangles, bytes >> 20);
}

void check_size(const SceneValue& value, const DisplacedSize& size) {
    if (!(size.reach <= max_displacement_reach))
        value.fail(fmt::format("texture coordinates of up to {:.3g} cells", size.reach),
                   fmt::format("at most {:.0f} from the origin", max_displacement_reach));
    if (size.triangles <= max_displaced_triangles) return;
    const DisplacedSize most{0, max_displaced_triangles, max_displaced_triangles / 2};
    value.fail(with_memory(size.triangles, size.bytes()),
               "at most " + with_memory(most.triangles, most.bytes()) +
                   ": fewer cells, or a smaller part of the texture");
}

/// Who waits is told what for.
constexpr std::uint64_t worth_a_note = 5'000'000;

}  // namespace

Mesh read_displaced(const SceneValue& value, const Mesh& mesh, const MeshSources& sources) {
    Fields fields(value);
    const TextureReference reference = read_heights(fields.get("height"), sources);
    Displacement displacement;
    fields.read("depth", displacement.depth, Range{.low = 0, .high = 1e12});
    fields.read("seat", displacement.seat, unit_interval);
    if (fields.has("cells")) {
        const SceneValue cells = fields.get("cells");
        displacement.cells = cells.json().is_string() ? cells.word(cell_words)
                                                      : cells.integer(1, max_displacement_cells);
    }
    fields.read("split", displacement.split, split_words);
    if (fields.has("texture_matrix"))
        displacement.texture_matrix = read_texture_matrix(fields.get("texture_matrix"));
    fields.finish("a displacement");
    if (mesh.uvs.empty())
        value.fail("a mesh without texture coordinates", "some, at which to read heights");
    const auto texture = load_heights(reference, sources.cache);
    const SampledTexture heights{texture->view(), reference.sampler};
    displacement.heights = &heights;
    const DisplacedSize size = displaced_size(mesh, displacement);
    check_size(value, size);
    if (size.triangles > worth_a_note)
        sources.notes.push_back(
            file_note(value.document().file.string(),
                      value.path() + ": " + with_memory(size.triangles, size.bytes())));
    return displaced(mesh, displacement);
}

}  // namespace quadrel
