#include "render/draw/tile_renderer.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "quadrel/film/presence.hpp"
#include "raster/solid_tile.hpp"
#include "render/inject/injected_values.hpp"
#include "render/ranges/presence.hpp"

namespace quadrel {
namespace {

DepthCompare depth_compare(const Scene& scene) {
    return scene.camera.reversed_z ? DepthCompare::greater : DepthCompare::less;
}

/// Whether shading decides over coverage or depth.
bool draws_in_order(const Material& material) {
    return material.discard_below >= 0 || clips(material) || writes_depth(material);
}

/// Whether a fragment's depth goes into the film.
bool shows_depth(const std::vector<ChannelSource>& channels) {
    return std::any_of(channels.begin(), channels.end(), [](const ChannelSource& channel) {
        return channel.kind == ChannelSource::Kind::depth;
    });
}

}  // namespace

std::vector<Tile> bin_triangles(const Geometry& geometry, const PixelRect& area, int size) {
    std::vector<std::uint32_t> all(geometry.triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    return bin_triangles(geometry, all, area, size);
}

std::vector<Tile> bin_triangles(const Geometry& geometry, std::span<const std::uint32_t> triangles,
                                const PixelRect& area, int size) {
    const int first_x = area.x0 / size, first_y = area.y0 / size;
    const int columns = (area.x1 - 1) / size - first_x + 1;
    const int rows = (area.y1 - 1) / size - first_y + 1;
    std::vector<Tile> tiles;
    for (int row = first_y; row < first_y + rows; ++row)
        for (int column = first_x; column < first_x + columns; ++column)
            tiles.push_back({intersect(area, {column * size, row * size, (column + 1) * size,
                                              (row + 1) * size}),
                             {}});
    for (const std::uint32_t t : triangles) {
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
                           const FilmTarget& target, Recording recording,
                           const TouchedTexels* touched)
    : scene_(scene),
      plan_(plan),
      geometry_(geometry),
      buffer_({0, 0, 2, 2}, scene.samples, depth_compare(scene)),
      target_(target),
      film_(target, scene.samples, plan.shortcuts.film_rows),
      command_(scene, *plan.kernels, plan.isa),
      batch_(plan.scalar_bytes, &command_),
      recording_(recording),
      touched_(touched),
      solid_tiles_(plan.shortcuts.solid_tiles && !shows_depth(*target.channels) && !plan.integral) {
    if (plan.injected)
        for (const std::string& option : plan.injected->options()) command_.add("--inject", option);
    if (!plan.exact.empty()) exact_.emplace(&command_);
    if (!plan.errors.empty())
        errors_.emplace(plan.scalar_bytes, &command_, plan.judged.get(), plan.truths);
    if (!plan.bounds.materials.empty()) bounds_.emplace(plan.bounds);
    if (!plan.limits.materials.empty()) limits_.emplace(plan.limits);
    if (plan.integral) integral_.emplace(*plan.integral, target.background);
    for (const ChannelSource& channel : *target.channels) {
        if (channel.name == "err.kind") kind_ = &channel;
        if (channel.kind == ChannelSource::Kind::undecided)
            undecided_ = static_cast<std::size_t>(&channel - target.channels->data());
        certifies_pixels_ = certifies_pixels_ || certifies_pixels(channel);
    }
}

std::uint32_t TileRenderer::material_of(const QuadCoverage& quad) const {
    return geometry_.triangles[quad.triangle].material;
}

void TileRenderer::render(const Tile& tile) {
    const bool writes = recording_ != Recording::marks, times = keeps_time();
    if (times) clock_.begin();
    if (integral_) {
        integrate(tile);
    } else {
        quads_.clear();
        discarded_.clear();
        solid_ = false;
        if (!tile.triangles.empty()) find_visible(tile);
        if (writes) film_.begin(tile.rect, solid_);
        shade();
        if (writes && undecided_) mark_presence(tile);
        if (writes) film_.end();
    }
    if (times) clock_.end();
}

const std::vector<QuadCoverage>& TileRenderer::find_visible(const Tile& tile) {
    const auto triangle = find_solid(tile);
    solid_ = triangle.has_value();
    if (triangle) {
        quads_.clear();
        append_whole_quads(tile.rect, *triangle, scene_.samples, quads_);
        return quads_;
    }
    buffer_.reset(tile.rect);
    draw_opaque(tile);
    draw_in_order(tile);
    quads_.clear();
    collect_quads(buffer_, quads_);
    return quads_;
}

/// The only triangle in the tile, if it is seen at every pixel. Errs towards none.
std::optional<std::uint32_t> TileRenderer::find_solid(const Tile& tile) const {
    const PixelRect& rect = tile.rect;
    if (!solid_tiles_ || rect.width() % 2 != 0 || rect.height() % 2 != 0) return {};
    std::optional<std::uint32_t> only;
    for (const std::uint32_t t : tile.triangles) {
        const DrawnTriangle& triangle = geometry_.triangles[t];
        const Cover cover = cover_of(triangle.screen, rect, scene_.samples);
        if (cover == Cover::none) continue;
        if (cover == Cover::some || only || draws_in_order(scene_.materials[triangle.material]))
            return {};
        only = t;
    }
    if (only && passes_cleared(geometry_.triangles[*only].screen, rect, scene_.samples,
                               depth_compare(scene_)))
        return only;
    return {};
}

void TileRenderer::draw_opaque(const Tile& tile) {
    for (const std::uint32_t t : tile.triangles)
        if (!draws_in_order(scene_.materials[geometry_.triangles[t].material])) draw_triangle(t);
}

void TileRenderer::draw_triangle(std::uint32_t t) {
    const ScreenTriangle& triangle = geometry_.triangles[t].screen;
    if (integral_)
        rasterize(triangle, t, integral_->places(), buffer_);
    else
        rasterize(triangle, t, buffer_);
}

/// Quads of the triangle whose samples are covered and pass the test.
void TileRenderer::collect_covered(std::uint32_t t, DepthTest test) {
    const ScreenTriangle& triangle = geometry_.triangles[t].screen;
    if (integral_)
        collect_passing(triangle, t, integral_->places(), buffer_, quads_, test);
    else
        collect_passing(triangle, t, buffer_, quads_, test);
}

void TileRenderer::write_kept(const ScreenTriangle& triangle, const QuadCoverage& quad) {
    if (integral_)
        write_quad(triangle, quad, integral_->places(), buffer_);
    else
        write_quad(triangle, quad, buffer_);
}

/// Materials that discard or write depth, in submission order. At equal depth the earlier triangle
/// wins, as in in-order drawing, although the opaque ones are drawn first.
void TileRenderer::draw_in_order(const Tile& tile) {
    for (const std::uint32_t t : tile.triangles) {
        const DrawnTriangle& triangle = geometry_.triangles[t];
        const Material& material = scene_.materials[triangle.material];
        if (!draws_in_order(material)) continue;
        quads_.clear();
        collect_covered(t, writes_depth(material) ? DepthTest::late : DepthTest::early);
        for (std::size_t first = 0; first < quads_.size(); first += batch_quads)
            draw_batch(triangle,
                       std::span(quads_).subspan(
                           first, std::min<std::size_t>(batch_quads, quads_.size() - first)));
    }
}

/// Decides over the fragments of up to batch_quads quads of one triangle, and writes their depths.
void TileRenderer::draw_batch(const DrawnTriangle& triangle, std::span<QuadCoverage> quads) {
    const Material& material = scene_.materials[triangle.material];
    run(plan_.discard[triangle.material], triangle.material, quads.data(),
        static_cast<int>(quads.size()));
    for (std::size_t q = 0; q < quads.size(); ++q) {
        std::array<float, 4> depth{};
        QuadCoverage discarded{quads[q].x, quads[q].y, quads[q].triangle, {}};
        for (int lane = 0; lane < 4; ++lane) {
            const int i = 4 * static_cast<int>(q) + lane;
            if (is_discarded(material, i))
                std::swap(quads[q].samples[static_cast<std::size_t>(lane)],
                          discarded.samples[static_cast<std::size_t>(lane)]);
            if (writes_depth(material))
                depth[static_cast<std::size_t>(lane)] = batch_.real(slot_of(Value::frag_depth), i);
        }
        if (undecided_ && discarded.is_any()) discarded_.push_back(discarded);
        if (writes_depth(material))
            write_quad_depth(quads[q], depth, buffer_);
        else
            write_kept(triangle.screen, quads[q]);
    }
}

/// Whether lane `i` of the batch that ran the discard plan is demoted.
bool TileRenderer::is_discarded(const Material& material, int i) const {
    if (material.discard_below >= 0 &&
        batch_.real(slot_of(Value::opacity), i) < material.discard_below)
        return true;
    return clips(material) && batch_.integer(slot_of(Value::hit_status), i) ==
                                  static_cast<std::uint32_t>(Status::clip);
}

DrawRecord TileRenderer::record() const {
    DrawRecord record = record_;
    record.stages = clock_.times();
    record.pixels += film_.pixels();
    return record;
}

void TileRenderer::count_quads() {
    std::uint64_t covered = solid_ ? 4 * quads_.size() : 0;
    for (std::size_t q = 0; !solid_ && q < quads_.size(); ++q)
        for (const std::uint16_t samples : quads_[q].samples) covered += samples != 0;
    record_.quads += quads_.size();
    record_.covered_lanes += covered;
    record_.helper_lanes += 4 * quads_.size() - covered;
}

void TileRenderer::shade() {
    if (recording_ == Recording::counts) count_quads();
    if (scene_.materials.size() > 1)
        std::stable_sort(quads_.begin(), quads_.end(),
                         [&](const QuadCoverage& a, const QuadCoverage& b) {
                             return material_of(a) < material_of(b);
                         });
    for (std::size_t first = 0; first < quads_.size();) {
        const std::uint32_t material = material_of(quads_[first]);
        std::size_t end = std::min(first + batch_quads, quads_.size());
        if (scene_.materials.size() > 1)  // they are sorted
            while (material_of(quads_[end - 1]) != material) --end;
        const int count = static_cast<int>(end - first);
        run(plan_.materials[material], material, quads_.data() + first, count);
        if (recording_ == Recording::counts)
            count_certified(material, {quads_.data() + first, end - first});
        if (integral_) {
            integral_->add(batch_, quads_.data() + first);
        } else if (recording_ != Recording::marks) {
            const Judges judges = run_judges(material, quads_.data() + first, count);
            film_.add(batch_, quads_.data() + first, geometry_, buffer_, judges);
            const std::span<const QuadCoverage> drawn(quads_.data() + first, end - first);
            if (recording_ == Recording::counts && judges.errors != nullptr)
                count_kinds(*judges.errors, drawn);
            if (recording_ == Recording::counts && certifies_pixels_)
                count_certified_pixels(*judges.bounds, material, drawn);
        }
        first = end;
    }
}

void TileRenderer::add_undecided(int x, int y, std::uint32_t bits) {
    if (const std::ptrdiff_t pixel = target_.index(x, y); pixel >= 0)
        target_.film->planes[*undecided_].bits[static_cast<std::size_t>(pixel)] |= bits;
}

/// Pixels where other implementations may have a fragment and this one has none, or the other way
/// round.
void TileRenderer::mark_presence(const Tile& tile) {
    const PixelRect& rect = tile.rect;
    Presence presence(rect, plan_.limits.budget.snapping);
    for (const DrawnTriangle& triangle : geometry_.triangles) presence.add(triangle.screen);
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x)
            if (presence.is_open(x, y)) add_undecided(x, y, undecided_presence);
    mark_discarded();
}

/// Of discarded fragments where nothing else is: whether other implementations may keep them.
void TileRenderer::mark_discarded() {
    for (QuadCoverage& quad : discarded_)
        for (int lane = 0; lane < 4; ++lane)
            if (const int x = lane_x(quad, lane), y = lane_y(quad, lane);
                !buffer_.rect().contains(x, y) || buffer_.triangle(x, y, 0) != no_triangle)
                quad.samples[static_cast<std::size_t>(lane)] = 0;
    std::erase_if(discarded_, [](const QuadCoverage& quad) { return !quad.is_any(); });
    for (const QuadCoverage& quad : discarded_) {
        const std::uint32_t material = material_of(quad);
        run(plan_.materials[material], material, &quad, 1);
        const QuadContext context(command_, {&quad, 1});
        limits_->run(material, stage_call(plan_, material), batch_, &quad, geometry_,
                     plan_.injected.get());
        for (int lane = 0; lane < 4; ++lane)
            if (quad.samples[static_cast<std::size_t>(lane)] != 0)
                add_undecided(lane_x(quad, lane), lane_y(quad, lane),
                              limits_->undecided(lane) & undecided_presence);
    }
}

/// The quads on other number types and with the judge's stages, where channels ask.
Judges TileRenderer::run_judges(std::uint32_t material, const QuadCoverage* quads, int count) {
    Judges judges;
    if (!exact_ && !errors_ && !bounds_ && !limits_) return judges;
    const QuadContext context(command_, {quads, static_cast<std::size_t>(count)});
    const StageCall call = stage_call(plan_, material);
    const auto run = [&](auto& batch, const auto& plans) {
        batch->run(plans[material], call, quads, count, geometry_, scene_.samples, scene_.centroid);
        return &*batch;
    };
    const auto run_ranges = [&](RangeBatch& batch) {
        batch.run(material, call, batch_, quads, geometry_, plan_.injected.get());
        return &batch;
    };
    if (exact_) {
        judges.exact = run(exact_, plan_.exact);
        exact_->observe(*target_.channels, batch_);
    }
    if (errors_) judges.errors = run(errors_, plan_.errors);
    if (bounds_) judges.bounds = run_ranges(*bounds_);
    if (limits_) judges.limits = run_ranges(*limits_);
    return judges;
}

void TileRenderer::run(const MaterialPlan& plan, std::uint32_t material, const QuadCoverage* quads,
                       int count) {
    const std::span<const QuadCoverage> all(quads, static_cast<std::size_t>(count));
    const QuadContext context(command_, all);
    try {
        run_stages(plan, material, all);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        name_failing_quad(plan, material, all, error.what());
    }
    if (recording_ == Recording::marks) count_steps(plan);
}

void TileRenderer::run_stages(const MaterialPlan& plan, std::uint32_t material,
                              std::span<const QuadCoverage> quads) {
    if (prepared_ != &plan) batch_.prepare(plan);
    prepared_ = &plan;
    if (integral_)
        batch_.load(quads.data(), static_cast<int>(quads.size()), geometry_, integral_->places());
    else
        batch_.load(quads.data(), static_cast<int>(quads.size()), geometry_, scene_.samples,
                    scene_.centroid, plan_.shortcuts.edge_runs);
    // Coverage is the reference's own: what is decided before it is known what is seen.
    batch_.inject(&plan == &plan_.materials[material] ? plan_.injected.get() : nullptr);
    StageCall call = stage_call(plan_, material);
    if (recording_ == Recording::marks) mark(material);
    if (recording_ == Recording::counts || recording_ == Recording::marks)
        call.counters = record_.fetches.data();
    // A marking pass sees each stage's own values.
    batch_.run(plan, call, geometry_, keeps_time() ? &clock_ : nullptr,
               recording_ == Recording::marks ? no_shortcuts : plan_.shortcuts);
}

/// Stages do not throw: whatever did is a mistake of ours. Runs the quads one by one until it is
/// thrown again.
void TileRenderer::name_failing_quad(const MaterialPlan& plan, std::uint32_t material,
                                     std::span<const QuadCoverage> quads, std::string message) {
    std::span<const QuadCoverage> failing = quads;
    for (std::size_t q = 0; q < quads.size() && failing.size() == quads.size(); ++q) {
        try {
            run_stages(plan, material, quads.subspan(q, 1));
        } catch (const std::exception& error) {
            failing = quads.subspan(q, 1);
            message = error.what();
        }
    }
    throw std::runtime_error(message + "; " + QuadContext(command_, failing).text());
}

/// Directs the marks of the next batch to the textures of its material.
void TileRenderer::mark(std::uint32_t material) {
    for (int slot = 0; slot < texture_slot_count; ++slot)
        record_.fetches[static_cast<std::size_t>(slot)].marks = touched_->marks(material, slot);
}

/// count(lane) for every lane of the batch that is seen.
template <class Count>
void TileRenderer::for_each_seen(std::span<const QuadCoverage> quads, const Count& count) const {
    for (int lane = 0; lane < 4 * static_cast<int>(quads.size()); ++lane) {
        const auto q = static_cast<std::size_t>(lane / 4);
        const auto k = static_cast<std::size_t>(lane % 4);
        if (solid_ || quads[q].samples[k] != 0) count(lane);
    }
}

/// Whether there is nothing to prove. Noise has heights that are not proven.
bool TileRenderer::lacks_ray(std::uint32_t material, Uncertified reason) const {
    const Material& of = scene_.materials[material];
    const bool has_heights = of.noise || of.textures.contains("height");
    return reason == Uncertified::no_ray || (reason == Uncertified::no_height_map && !has_heights);
}

/// What is proven of the fragments that are seen, where certificates are drawn.
void TileRenderer::count_certified(std::uint32_t material, std::span<const QuadCoverage> quads) {
    constexpr auto certified = static_cast<std::size_t>(Value::certified);
    if (!plan_.materials[material].values[certified]) return;
    for_each_seen(quads, [&](int lane) {
        ++record_.certified[batch_.integer(slot_of(Value::certified), lane)];
        record_.without_ray += lacks_ray(
            material, Uncertified(batch_.integer(slot_of(Value::certified_reason), lane)));
    });
}

/// The same of their pixels.
void TileRenderer::count_certified_pixels(const RangeBatch& ranges, std::uint32_t material,
                                          std::span<const QuadCoverage> quads) {
    for_each_seen(quads, [&](int lane) {
        const Uncertified reason = ranges.uncertified(lane);
        const auto code = lacks_ray(material, reason) ? Uncertified::no_ray : reason;
        ++record_.certified_pixels[static_cast<std::size_t>(code)];
    });
}

/// Of the fragments that are seen, where their kinds are drawn. An image is no larger than the
/// window, beyond which quads may reach: it is not counted.
void TileRenderer::count_kinds(const ErrorBatch& errors, std::span<const QuadCoverage> quads) {
    if (kind_ == nullptr || plan_.judged != nullptr) return;
    for_each_seen(quads,
                  [&](int lane) { ++record_.kinds[errors.bits(*kind_, batch_, lane, 0, 0)]; });
}

void TileRenderer::count_steps(const MaterialPlan& plan) {
    for (const PlannedStage& stage : plan.stages) {
        if (stores(stage, Value::hit_steps))
            record_.trace_steps += batch_.sum(slot_of(Value::hit_steps));
        if (stores(stage, Value::shadow_steps))
            record_.shadow_steps += batch_.sum(slot_of(Value::shadow_steps) + stage.light);
    }
}

}  // namespace quadrel
