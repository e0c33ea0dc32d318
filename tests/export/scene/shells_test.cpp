// Exported shells: corners and rows of the table are what Quadrel's own fragments read.
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <set>

#include "export/scene/content.hpp"
#include "export/scene/shells.hpp"
#include "export/scene/small_scenes.hpp"
#include "quadrel/relief/shell/prism_strip.hpp"
#include "render/draw/geometry.hpp"
#include "render/draw/shell.hpp"

namespace quadrel::export_tests {
namespace {

using CornerFloats = std::vector<float>;

class Corner {
  public:
    void add(const float* from, std::size_t count) { all_.insert(all_.end(), from, from + count); }
    void add(float x) { all_.push_back(x); }
    const CornerFloats& all() const { return all_; }

  private:
    CornerFloats all_;
};

/// A row of the table; nothing where it has none of that number, as by a planted error.
void add_texels(const Texture& table, float row, Corner& corner) {
    const auto number = static_cast<std::size_t>(row);
    const TextureView& view = table.view();
    if (!(row >= 0) || number >= static_cast<std::size_t>(view.height[0]) * shell_rows_a_line)
        return;
    corner.add(table.level_texels(0, 0) + number * shell_texels_a_row * 4, shell_texels_a_row * 4);
}
void add_texels(const ShellTexels& texels, Corner& corner) {
    for (const auto& texel : texels) corner.add(texel.data(), 4);
}

/// What an exported corner hands to its fragments.
CornerFloats handed_on(const ShellDrawTriangle& triangle, std::size_t v, ShellKind kind,
                       const Texture* table) {
    const ShellCorner& of = triangle.corner[v];
    Corner corner;
    corner.add(&of.eye.x, 3);
    corner.add(&of.normal.x, 3);
    corner.add(&of.uv.x, 2);
    corner.add(&triangle.face_normal.x, 3);
    if (kind == ShellKind::strips) {
        corner.add(of.strip_nv, 3);
        corner.add(of.strip_tv, 3);
        corner.add(of.strip_bv, 3);
        corner.add(of.strip_height);
        corner.add(of.strip_side);
        return corner.all();
    }
    corner.add(of.corner_weights, 3);
    corner.add(of.shell_depth);
    add_texels(*table, of.shell_row, corner);
    return corner.all();
}

template <class Face>
void add_face(Face face, std::size_t v, std::int32_t moved, Corner& corner) {
    corner.add(face.weights[v], 3);
    corner.add(face.s[v]);
    if constexpr (std::is_same_v<Face, ShellFace>)
        if (face.cell >= 0) face.cell -= moved;
    add_texels(texels_of(face), corner);
}

/// The same of Quadrel's own triangle. `moved`: by how much tetrahedra have other numbers there.
CornerFloats read_by_fragments(const Geometry& geometry, std::size_t t, std::size_t v,
                               ShellKind kind, std::int32_t moved) {
    const PrimitiveData& data = geometry.data[t];
    Corner corner;
    corner.add(data.position[v], 3);
    corner.add(data.normal[v], 3);
    corner.add(data.uv[v], 2);
    corner.add(data.face_normal, 3);
    const PrimitiveVertices& row = geometry.vertices[t];
    if (kind == ShellKind::prisms) add_face(std::bit_cast<PrismFace>(row), v, moved, corner);
    if (kind == ShellKind::tetrahedra) add_face(std::bit_cast<ShellFace>(row), v, moved, corner);
    if (kind == ShellKind::strips) {
        const auto strip = std::bit_cast<PrismStrip>(row);
        corner.add(strip.nv[v], 3);
        corner.add(strip.tv[v], 3);
        corner.add(strip.bv[v], 3);
        corner.add(strip.height[v]);
        corner.add(strip.side[v]);
    }
    return corner.all();
}

/// Corners of drawn triangles that no exported one has; -1 if there are none. `plant` changes what
/// is exported.
template <class Plant>
int wrong_shell_corners(const Scene& scene, const Plant& plant) {
    const Geometry geometry = assemble_geometry(scene, scene_hardware(scene), {false, true});
    const SceneShells shells(scene);
    const auto table = shells.table();
    // Cells come behind all faces there, and first here.
    const auto moved = static_cast<std::int32_t>(geometry.triangles.size());
    int wrong = 0, seen = 0;
    for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
        const ShellKind kind = shell_kind(scene.materials[scene.objects[object].material]);
        std::set<CornerFloats> exported;
        for (ShellDrawTriangle triangle : shells.of(object)) {
            plant(triangle);
            for (std::size_t v = 0; v < 3; ++v)
                exported.insert(handed_on(triangle, v, kind, table.get()));
        }
        for (std::size_t t = 0; t < geometry.triangles.size(); ++t) {
            if (geometry.triangles[t].object != object) continue;
            for (std::size_t v = 0; v < 3; ++v, ++seen)
                wrong += exported.count(read_by_fragments(geometry, t, v, kind, moved)) == 0;
        }
    }
    return seen > 0 ? wrong : -1;
}

TEST(SceneShells, CornersAndRowsAreThoseOfFragments) {
    const SmallScenes scenes;
    for (const char* name : {"rows/frame-shell", "rows/frame-prism", "rows/frame-prism-published",
                             "rows/shadow-shell"}) {
        const Scene scene = scenes.load(name);
        EXPECT_EQ(wrong_shell_corners(scene, [](ShellDrawTriangle&) {}), 0) << name;
        EXPECT_GT(wrong_shell_corners(scene,
                                      [](ShellDrawTriangle& triangle) {
                                          triangle.corner[0].shell_row += 1;
                                          std::swap(triangle.corner[1].strip_tv[0],
                                                    triangle.corner[1].strip_bv[0]);
                                          triangle.corner[2].strip_height += 1;
                                      }),
                  0)
            << name;
    }
}

/// Each link leads to a tetrahedron that leads back.
TEST(SceneShells, LinksLeadBack) {
    const SmallScenes scenes;
    const SceneShells shells(scenes.load("rows/shadow-shell"));
    const auto table = shells.table();
    const auto texel = [&](int row, int k) {
        return table->level_texels(0, 0) + 4 * (shell_texels_a_row * row + k);
    };
    int cells = 0;
    for (const ShellDrawTriangle& triangle : shells.of(0)) {
        const auto face = static_cast<int>(triangle.corner[0].shell_row);
        const int cell = static_cast<int>(texel(face, 2)[3]);
        for (int k = 0; k < 4; ++k) {
            const int link = static_cast<int>(texel(cell, 6)[k]) - ShellCell::first_link;
            if (link < 0) continue;
            EXPECT_EQ(static_cast<int>(texel(link / 4, 6)[link % 4]), ShellCell::link_to(cell, k));
            ++cells;
        }
    }
    EXPECT_GT(cells, 100);
}

}  // namespace
}  // namespace quadrel::export_tests
