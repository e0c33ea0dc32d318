#include <fmt/format.h>

#include <cmath>

#include "io/scene/read.hpp"
#include "quadrel/scene/mesh_file.hpp"
#include "quadrel/scene/refine.hpp"
#include "quadrel/scene/shapes.hpp"
#include "text/printable.hpp"

namespace quadrel {
namespace {

// Four million vertices a shape: beyond, a typing mistake is likelier than a wish.
constexpr int most_cells = 2048;
/// Files have one or two sets of texture coordinates, exporters know up to eight.
constexpr int most_uv_set = 63;

Mesh read_quad(Fields& fields) {
    double size = 2;
    int columns = 1, rows = 1;
    fields.read("size", size, above_zero);
    if (fields.has("subdivide")) {
        const SceneValue cells = fields.get("subdivide");
        if (!cells.json().is_array() || cells.json().size() != 2)
            cells.reject("an array of 2 integers");
        columns = cells.element(0).integer(1, most_cells);
        rows = cells.element(1).integer(1, most_cells);
    }
    return make_quad(size, columns, rows);
}

Mesh read_cube(Fields& fields) {
    double size = 2;
    fields.read("size", size, above_zero);
    return make_cube(size);
}

Mesh read_icosahedron(Fields& fields) {
    constexpr Word<bool> words[] = {{"flat", false}, {"keep", false}, {"smooth", true}};
    double radius = 1;
    bool smooth = false;
    fields.read("radius", radius, above_zero);
    fields.read("normals", smooth, words);
    return make_icosahedron(radius, smooth);
}

Mesh read_sphere(Fields& fields) {
    double radius = 1;
    int slices = 32, stacks = 32;
    fields.read("radius", radius, above_zero);
    fields.read("slices", slices, 3, most_cells);
    fields.read("stacks", stacks, 2, most_cells);
    return make_sphere(radius, slices, stacks);
}

Mesh read_torus(Fields& fields) {
    double inner = 0.5, outer = 1;
    int sides = 24, rings = 48;
    fields.read("inner_radius", inner, above_zero);
    fields.read("outer_radius", outer, above_zero);
    fields.read("sides", sides, 3, most_cells);
    fields.read("rings", rings, 3, most_cells);
    if (inner > outer)
        fields.value().fail("inner_radius (the tube's) above outer_radius",
                            "inner_radius <= outer_radius");
    return make_torus(inner, outer, sides, rings);
}

Mesh read_teapot(Fields& fields) {
    double size = 1;
    int tessellation = 10;
    fields.read("size", size, above_zero);
    fields.read("tessellation", tessellation, 1, 256);
    return make_teapot(tessellation, size);
}

Mesh read_billboard(Fields& fields) {
    double size = 2;
    fields.read("size", size, above_zero);
    double radius = std::sqrt(3.0) / 2 * size;
    fields.read("radius", radius, above_zero);
    for (const char* key : {"normals", "refine", "displace"})
        if (fields.has(key))
            fields.get(key).fail(fmt::format("\"{}\" of a billboard", key),
                                 "none: its card is made for each view");
    return make_billboard(size, radius);
}

using ReadShape = Mesh (*)(Fields&);
constexpr Word<ReadShape> shape_words[] = {
    {"quad", read_quad},          {"cube", read_cube},   {"icosahedron", read_icosahedron},
    {"sphere", read_sphere},      {"torus", read_torus}, {"teapot", read_teapot},
    {"billboard", read_billboard}};

/// A material of the file, by its number or name.
MaterialChoice read_choice(const SceneValue& value) {
    constexpr int most = 1 << 20;
    if (value.json().is_string()) return value.string();
    if (!value.json().is_number_integer())
        value.reject("a material's name, or its number from 0; -1: none");
    return value.integer(-1, most);
}

Mesh read_file_mesh(Fields& fields, std::vector<std::string>& notes) {
    const SceneValue file = fields.get("file");
    const std::filesystem::path path = read_path(file);
    MeshFileOptions options;
    if (fields.has("flip_v")) options.flip_v = fields.get("flip_v").boolean();
    fields.read("uv_set", options.uv_set, 0, most_uv_set);
    if (fields.has("material")) options.material = read_choice(fields.get("material"));
    MeshFile read = read_mesh_file(path, options);
    bool materials = true;
    if (fields.has("materials")) materials = fields.get("materials").boolean();
    // What is taken of them another line tells (file_materials.hpp).
    if (!materials && !read.materials.empty()) read.ignored.emplace_back("materials");
    if (!read.ignored.empty())
        notes.push_back(
            file_note(path.string(), fmt::format("ignored: {}", fmt::join(read.ignored, ", "))));
    return std::move(read.mesh);
}

Mesh read_shape_or_file(Fields& fields, std::vector<std::string>& notes) {
    if (fields.has("shape") == fields.has("file"))
        fields.value().fail(
            fields.has("shape") ? "both \"shape\" and \"file\"" : "a mesh of nothing",
            "either \"shape\" or \"file\"");
    if (fields.has("file")) return read_file_mesh(fields, notes);
    return fields.get("shape").word(shape_words)(fields);
}

// "curvature", one level of it, or an object that says how many.
int read_refinement(Fields& fields) {
    if (!fields.has("refine")) return 0;
    constexpr Word<int> words[] = {{"curvature", 1}};
    const SceneValue value = fields.get("refine");
    if (!value.json().is_object()) return value.word(words);
    Fields members(value);
    members.get("by").word(words);
    int levels = 1;
    members.read("levels", levels, 1, most_refinement_levels);
    members.finish("a refinement");
    return levels;
}

Mesh refined(const SceneValue& value, const Mesh& mesh, int levels) {
    const std::size_t triangles = mesh.triangles.size() << (2 * levels);
    if (triangles > max_mesh_vertices)
        value.fail(fmt::format("{} triangles after refinement", triangles),
                   fmt::format("at most {}", max_mesh_vertices));
    return refined_by_curvature(mesh, levels);
}

}  // namespace

Mesh read_mesh(const SceneValue& value, const MeshSources& sources) {
    if (value.json().is_string()) {
        const Json shape{{"shape", value.string()}};
        value.word(shape_words);  // fails at this value, not at the one made here
        return read_mesh(SceneValue(value.document(), shape, value.path()), sources);
    }
    constexpr Word<bool> normals_words[] = {{"keep", false}, {"flat", true}};
    constexpr Word<bool> icosahedron_words[] = {{"flat", true}, {"keep", true}, {"smooth", false}};
    Fields fields(value);
    Mesh mesh = read_shape_or_file(fields, sources.notes);
    const bool icosahedron = fields.has("shape") && fields.get("shape").string() == "icosahedron";
    bool flat = icosahedron;
    if (icosahedron)
        fields.read("normals", flat, icosahedron_words);
    else
        fields.read("normals", flat, normals_words);
    const int levels = read_refinement(fields);
    const bool displace = fields.has("displace");
    if (displace) fields.get("displace");
    fields.finish(fields.has("file") ? "a mesh from a file"
                                     : "the shape " + fields.get("shape").string());
    if (levels > 0) mesh = refined(value, mesh, levels);
    // An icosahedron has flat faces by itself.
    const bool facets = flat && !(icosahedron && levels == 0);
    if (!displace) return facets ? flat_shaded(mesh) : mesh;
    mesh = read_displaced(value.member("displace"), mesh, sources);
    if (facets) mesh.normals.clear();  // less memory, and it shades the same
    return mesh;
}

}  // namespace quadrel
