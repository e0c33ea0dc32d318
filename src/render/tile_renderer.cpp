#include "render/tile_renderer.hpp"

#include <algorithm>

namespace quadrel {
namespace {

DepthCompare depth_compare(const Scene& scene) {
    return scene.camera.reversed_z ? DepthCompare::greater : DepthCompare::less;
}

bool discards(const Material& material) { return material.discard_below >= 0; }

}  // namespace

std::vector<Tile> bin_triangles(const Geometry& geometry, const PixelRect& area, int size) {
    const int first_x = area.x0 / size, first_y = area.y0 / size;
    const int columns = (area.x1 - 1) / size - first_x + 1;
    const int rows = (area.y1 - 1) / size - first_y + 1;
    std::vector<Tile> tiles;
    for (int row = first_y; row < first_y + rows; ++row)
        for (int column = first_x; column < first_x + columns; ++column)
            tiles.push_back({intersect(area, {column * size, row * size, (column + 1) * size,
                                              (row + 1) * size}),
                             {}});
    for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t) {
        const PixelRect bounds = intersect(area, geometry.triangles[t].screen.bounds);
        if (bounds.empty()) continue;
        for (int row = bounds.y0 / size; row <= (bounds.y1 - 1) / size; ++row)
            for (int column = bounds.x0 / size; column <= (bounds.x1 - 1) / size; ++column)
                tiles[std::size_t(row - first_y) * columns + (column - first_x)]
                    .triangles.push_back(t);
    }
    return tiles;
}

TileRenderer::TileRenderer(const Scene& scene, const RenderPlan& plan, const Geometry& geometry,
                           const FilmTarget& target, bool recording)
    : scene_(scene),
      plan_(plan),
      geometry_(geometry),
      buffer_({0, 0, 2, 2}, scene.samples, depth_compare(scene)),
      film_(target, scene.samples),
      batch_(plan.scalar_bytes),
      recording_(recording) {}

std::uint32_t TileRenderer::material_of(const QuadCoverage& quad) const {
    return geometry_.triangles[quad.triangle].material;
}

void TileRenderer::render(const Tile& tile) {
    film_.begin(tile.rect);
    if (!tile.triangles.empty()) {
        find_visible(tile);
        shade();
    }
    film_.end();
}

const std::vector<QuadCoverage>& TileRenderer::find_visible(const Tile& tile) {
    buffer_.reset(tile.rect);
    draw_opaque(tile);
    draw_discarding(tile);
    quads_.clear();
    collect_quads(buffer_, quads_);
    return quads_;
}

void TileRenderer::draw_opaque(const Tile& tile) {
    for (const std::uint32_t t : tile.triangles)
        if (!discards(scene_.materials[geometry_.triangles[t].material]))
            rasterize(geometry_.triangles[t].screen, t, buffer_);
}

/// Discarding materials in submission order. At equal depth the earlier triangle wins, as in
/// in-order drawing, although the opaque ones are drawn first.
void TileRenderer::draw_discarding(const Tile& tile) {
    for (const std::uint32_t t : tile.triangles) {
        const DrawnTriangle& triangle = geometry_.triangles[t];
        if (!discards(scene_.materials[triangle.material])) continue;
        quads_.clear();
        collect_passing(triangle.screen, t, buffer_, quads_);
        discard(quads_);
        for (const QuadCoverage& quad : quads_) write_quad(triangle.screen, quad, buffer_);
    }
}

/// Takes the samples of discarded fragments out of the quads (all of one material).
void TileRenderer::discard(std::vector<QuadCoverage>& quads) {
    for (std::size_t first = 0; first < quads.size(); first += batch_quads) {
        const int count =
            static_cast<int>(std::min<std::size_t>(batch_quads, quads.size() - first));
        const std::uint32_t material = material_of(quads[first]);
        run(plan_.discard[material], material, quads.data() + first, count);
        const float limit = scene_.materials[material].discard_below;
        for (int i = 0; i < 4 * count; ++i)
            if (batch_.real(slot_of(Value::opacity), i) < limit)
                quads[first + std::size_t(i / 4)].samples[i % 4] = 0;
    }
}

DrawRecord TileRenderer::record() const {
    DrawRecord record = record_;
    record.stages = clock_.times();
    return record;
}

void TileRenderer::count_quads() {
    record_.quads += quads_.size();
    for (const QuadCoverage& quad : quads_)
        for (const std::uint16_t samples : quad.samples)
            ++(samples != 0 ? record_.covered_lanes : record_.helper_lanes);
}

void TileRenderer::shade() {
    if (recording_) count_quads();
    if (scene_.materials.size() > 1)
        std::stable_sort(quads_.begin(), quads_.end(),
                         [&](const QuadCoverage& a, const QuadCoverage& b) {
                             return material_of(a) < material_of(b);
                         });
    for (std::size_t first = 0; first < quads_.size();) {
        const std::uint32_t material = material_of(quads_[first]);
        std::size_t end = first;
        while (end < quads_.size() && end - first < batch_quads &&
               material_of(quads_[end]) == material)
            ++end;
        const int count = static_cast<int>(end - first);
        run(plan_.materials[material], material, quads_.data() + first, count);
        film_.add(batch_, quads_.data() + first, geometry_, buffer_);
        first = end;
    }
}

void TileRenderer::run(const MaterialPlan& plan, std::uint32_t material, const QuadCoverage* quads,
                       int count) {
    batch_.prepare(plan);
    batch_.load(quads, count, geometry_, scene_.samples, scene_.centroid);
    StageCall call = stage_call(plan_, material);
    if (recording_) call.counters = record_.fetches.data();
    batch_.run(plan, call, geometry_, recording_ ? &clock_ : nullptr);
}

}  // namespace quadrel
