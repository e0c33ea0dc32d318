#include "render/ranges/range_batch.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "quadrel/film/presence.hpp"
#include "quadrel/num/range/ranged.hpp"
#include "quadrel/relief/cells.hpp"
#include "quadrel/relief/trace/oracle/common_hit.hpp"
#include "render/inject/injected_values.hpp"
#include "render/ranges/exact_rows.hpp"

namespace quadrel {
namespace {

constexpr double no_border = std::numeric_limits<double>::infinity();

constexpr FragmentRange unknown{-no_border, no_border, 0, no_border, no_border};

/// Before the first of several.
constexpr FragmentRange no_range{no_border, -no_border, 0};
constexpr LaneWays no_way{{no_range, no_range}};

/// Whether coordinates of a range may lie in two cells of an axis.
bool may_change_cell(const FragmentRange& range, int texels, double centre, const GridAxis& axis) {
    if (!(range.low <= range.high)) return false;
    const auto cell = [&](double u) {
        const double x = std::floor(u * texels - centre), first = axis.first;
        return axis.periodic ? x : std::clamp(x, first, first + axis.count - 1);
    };
    return cell(range.low) != cell(range.high);
}

/// What a decision in a stage of that room is about.
std::uint32_t kind_of(const StageInfo& stage) {
    const std::string_view room = stage.text.room;
    return room == "trace" || room == "clip" ? Undecided::hit : Undecided::branch;
}

/// How many stages have run when the last of them has written an array.
std::size_t stages_until_written(const MaterialPlan& plan, int slot) {
    for (std::size_t k = plan.stages.size(); k > 0; --k)
        for (const Value value : plan.stages[k - 1].info->outputs)
            if (slot >= slot_of(value) && slot < slot_of(value) + arrays_of(value)) return k;
    return 0;
}

bool is_integer(int slot) {
    const auto end = std::ranges::upper_bound(first_slots, slot);
    return value_table[static_cast<std::size_t>(end - first_slots.begin() - 1)].kind ==
           ValueKind::integer;
}

/// A lane's element of an array of integers, which holds both ends.
void put_integer(void* values, int lane, std::uint32_t bits) {
    auto* const ends = static_cast<std::int32_t*>(values) + 2 * static_cast<std::ptrdiff_t>(lane);
    ends[0] = ends[1] = static_cast<std::int32_t>(bits);
}

/// Ranges that meet become one; what is left is disjoint.
FragmentRange joined(std::vector<FragmentRange>& ways) {
    std::ranges::sort(ways, {}, &FragmentRange::low);
    FragmentRange all = ways.front();
    all.paths = 1;
    all.gap_low = all.gap_high = all.high;
    for (const FragmentRange& way : ways) {
        if (way.low > all.high) {
            ++all.paths;
            if (!(way.low - all.high <= all.gap_high - all.gap_low)) {
                all.gap_low = all.high;
                all.gap_high = way.low;
            }
        }
        all.high = std::max(all.high, way.high);
    }
    return all;
}

}  // namespace

RangeBatch::RangeBatch(const RangePlan& plan)
    : plan_(plan),
      values_(slot_count, nullptr),
      results_(plan.slots.size() * batch_lanes),
      ways_(plan.slots.size()),
      through_(plan.slots.size()),
      undecided_(batch_lanes),
      uncertified_(batch_lanes, Uncertified::no_ray) {}

void RangeBatch::prepare(const MaterialPlan& plan) {
    if (prepared_ == &plan) return;
    prepared_ = &plan;
    std::size_t arrays = 0;
    for (std::size_t v = 0; v < plan.values.size(); ++v)
        if (plan.values[v]) arrays += static_cast<std::size_t>(arrays_of(static_cast<Value>(v)));
    memory_.assign(arrays * array_bytes, std::byte());
    std::ranges::fill(values_, nullptr);
    std::byte* next = memory_.data();
    for (std::size_t v = 0; v < plan.values.size(); ++v) {
        if (!plan.values[v]) continue;
        const auto value = static_cast<Value>(v);
        for (int i = 0; i < arrays_of(value); ++i, next += array_bytes) {
            values_[static_cast<std::size_t>(slot_of(value) + i)] = next;
            if (info(value).kind == ValueKind::real)
                std::fill_n(reinterpret_cast<Ranged*>(next), quad_lanes, Ranged(0.0, 0.0));
        }
    }
    for (std::size_t s = 0; s < plan_.slots.size(); ++s)
        through_[s] = stages_until_written(plan, plan_.slots[s]);
}

void RangeBatch::run(std::uint32_t material, const StageCall& call, const Batch& drawn,
                     const QuadCoverage* quads, const Geometry& geometry,
                     const InjectedValues* injected) {
    injected_ = injected;
    drawn_ = &drawn;
    const MaterialPlan& plan = plan_.materials[material];
    prepare(plan);
    known_ = &plan_.known[material];
    context_ = plan_.table->context();
    context_->budget = plan_.budget;
    context_->maps = plan_.maps;
    context_->srgb_map_count = static_cast<std::int32_t>(plan_.srgb_maps.size());
    context_->srgb_maps = plan_.srgb_maps.data();
    const SampledTexture* const heights = call.textures[static_cast<int>(TextureSlot::height)];
    context_->leveled_map = heights != nullptr ? heights->view.texels : nullptr;
    material_ = *call.material;
    material_.heights_bounded = 0;
    material_.maxima = nullptr;
    for (int q = 0; q < drawn.quads(); ++q) {
        call_ = call;
        call_.material = &material_;
        call_.counters = nullptr;
        call_.log = nullptr;
        drawn.point_to_quads(call_, geometry, q);
        interpolate_exactly(call_, geometry);
        call_.values = values_.data();
        call_.lanes = quad_lanes;
        surface_ = plan_.surfaces[material];
        discarding_ = plan_.discarding[material];
        quad_ = quads + q;
        quad_number_ = q;
        quad_known_ = injected != nullptr && injected->covers(quads[q]);
        run_quad(plan, q, quads[q]);
        for (int lane = 0; plan_.certifies && lane < quad_lanes; ++lane)
            if (quads[q].samples[static_cast<std::size_t>(lane)] != 0)
                uncertified_[static_cast<std::size_t>(quad_lanes * q + lane)] =
                    certify(material, drawn, quad_lanes * q + lane);
    }
}

void RangeBatch::run_stages(const MaterialPlan& plan) {
    context_->begin_run();
    context_->row_and_column = -1;
    stages_run_ = 0;
    for (std::size_t i = 0; i < plan.stages.size(); ++i) {
        if (is_made_of_differences(plan, i))
            run_along_rows_and_columns(plan, i);
        else if (is_made_at_the_hit(plan, i))
            run_at_parts_of_the_place(plan, i);
        else
            run_stage(plan, i);
        if (context_->too_many) return;
        ++stages_run_;
        if (stores(plan.stages[i], Value::hit_uv)) name_place();
    }
}

void RangeBatch::run_stage(const MaterialPlan& plan, std::size_t number) {
    const PlannedStage& stage = plan.stages[number];
    context_->kind = kind_of(*stage.info);
    call_.parameters = stage.params.data();
    call_.light = stage.light;
    // Helper lanes are not injected: ranges, where the stage has some.
    if (stage.run == nullptr || (quad_known_ && (*known_)[number]))
        take_drawn(stage);
    else
        stage.run(&call_);
    if (injected_ != nullptr) inject_after(plan, number);
}

/// What a stage that has no function for ranges has drawn, as it is.
void RangeBatch::take_drawn(const PlannedStage& stage) {
    const int first = quad_lanes * quad_number_;
    for (const Value value : stage.info->outputs)
        for (int i = 0; i < arrays_of(value); ++i) {
            const int slot = slot_of(value) + i;
            void* const values = values_[static_cast<std::size_t>(slot)];
            if (values == nullptr || !drawn_->has(slot)) continue;
            for (int lane = 0; lane < quad_lanes; ++lane)
                if (info(value).kind == ValueKind::integer) {
                    put_integer(values, lane, drawn_->integer(slot, first + lane));
                } else {
                    const double number = drawn_->number(slot, first + lane);
                    static_cast<Ranged*>(values)[lane] = Ranged(number, number);
                }
        }
}

void RangeBatch::inject_after(const MaterialPlan& plan, std::size_t stage) {
    const auto put = [&](int slot, int lane, std::uint32_t bits) {
        void* const values = values_[static_cast<std::size_t>(slot)];
        if (values == nullptr) return;
        if (is_integer(slot)) {
            put_integer(values, lane, bits);
            return;
        }
        const double number = std::bit_cast<float>(bits);
        static_cast<Ranged*>(values)[lane] = Ranged(number, number);
    };
    injected_->replace(plan, stage, std::span(quad_, 1), put);
}

/// What reads maps beside the hit reads them at places that move together.
void RangeBatch::name_place() {
    const auto slot = static_cast<std::size_t>(slot_of(Value::hit_uv));
    if (values_[slot] != nullptr && values_[slot + 1] != nullptr)
        plan_.table->name_place(values_[slot], values_[slot + 1]);
}

void RangeBatch::run_quad(const MaterialPlan& plan, int quad, const QuadCoverage& coverage) {
    ++context_->quad;
    std::fill_n(context_->undecided, quad_lanes, 0u);
    frame_.known = false;
    lanes_.fill(no_way);
    mark_coverage(coverage);
    context_->begin_lane(-1);
    run_stages(plan);
    for (int lane = 0; lane < quad_lanes; ++lane) record(quad, lane);
    if (context_->too_many) return give_up(quad);
    const std::uint32_t several = context_->joined;
    std::array<std::vector<double>, quad_lanes> borders;
    for (int lane = 0; lane < quad_lanes; ++lane)
        borders[static_cast<std::size_t>(lane)] = level_borders(lane);
    for (int lane = 0; lane < quad_lanes; ++lane) {
        const auto i = static_cast<std::size_t>(lane);
        if (((several >> lane & 1) != 0 || !borders[i].empty()) && coverage.samples[i] != 0)
            follow(plan, quad, lane, borders[i]);
    }
    mark_cells();
    mark_presence();
    for (int lane = 0; lane < quad_lanes; ++lane)
        undecided_[static_cast<std::size_t>(quad_lanes * quad + lane)] = context_->undecided[lane];
}

/// An edge of the triangle that snapping may move past the pixel's centre. Its function changes
/// from pixel to pixel by as much as it does where the edge is moved by one.
void RangeBatch::mark_coverage(const QuadCoverage& coverage) {
    for (int lane = 0; lane < quad_lanes; ++lane) {
        if (coverage.samples[static_cast<std::size_t>(lane)] == 0) continue;
        for (const double* const edge : call_.edges) {
            const double across = std::fabs(edge[1] - edge[0]) + std::fabs(edge[2] - edge[0]);
            if (std::fabs(edge[lane]) <= plan_.budget.snapping * across)
                context_->undecided[lane] |= Undecided::coverage;
        }
    }
}

/// Where the hits of a lane's ways lie in several cells of the height map.
void RangeBatch::mark_cells() {
    const SampledTexture* const map = call_.textures[static_cast<int>(TextureSlot::height)];
    if (!surface_ || map == nullptr) return;
    const bool blocks = *surface_ == oracle::Surface::block;
    const int width = map->view.width[0], height = map->view.height[0];
    const Grid grid =
        blocks ? texel_grid(width, height, map->sampler) : cell_grid(width, height, map->sampler);
    const double centre = blocks ? 0 : 0.5;
    for (int lane = 0; lane < quad_lanes; ++lane) {
        const auto& [u, v] = lanes_[static_cast<std::size_t>(lane)].hit;
        if (may_change_cell(u, width, centre, grid.u) || may_change_cell(v, height, centre, grid.v))
            context_->undecided[lane] |= Undecided::cell;
    }
}

/// Where some ways of a lane discard its fragment and others keep it.
void RangeBatch::mark_presence() {
    for (int lane = 0; lane < quad_lanes; ++lane) {
        const LaneWays& ways = lanes_[static_cast<std::size_t>(lane)];
        if (ways.kept && ways.discarded) context_->undecided[lane] |= undecided_presence;
    }
}

/// Whether all rays that the pixel's exact one may be end where the drawn ray is proven to.
Uncertified RangeBatch::certify(std::uint32_t material, const Batch& drawn, int lane) const {
    const auto reason =
        static_cast<Uncertified>(drawn.integer(slot_of(Value::certified_reason), lane));
    if (reason != Uncertified::proven) return reason;
    const auto range = [&](Value v, int component) -> RealInterval {
        const auto slot = std::ranges::find(plan_.slots, slot_of(v) + component);
        const FragmentRange& of =
            results_[static_cast<std::size_t>(slot - plan_.slots.begin()) * batch_lanes +
                     static_cast<std::size_t>(lane)];
        return {of.low, of.high};
    };
    for (const Value v : {Value::uv, Value::K})
        for (int component = 0; component < 2; ++component)
            if (!std::isfinite(range(v, component).width())) return oracle::pixel_open;
    const oracle::Field field{call_.textures[static_cast<int>(TextureSlot::height)],
                              call_.textures[static_cast<int>(TextureSlot::max_mip)],
                              *plan_.surfaces[material]};
    const oracle::CommonHit hit =
        oracle::common_hit(field, {range(Value::uv, 0), range(Value::uv, 1), range(Value::K, 0),
                                   range(Value::K, 1), 1 - static_cast<double>(material_.seat)});
    if (hit.reason != Uncertified::proven) return hit.reason;
    const auto status = static_cast<Status>(drawn.integer(slot_of(Value::oracle_status), lane));
    const auto cell = [&](int axis) {
        return drawn.number(slot_of(Value::oracle_cell) + axis, lane);
    };
    const bool same = hit.status == status &&
                      (status != Status::hit || (cell(0) == hit.cell_x && cell(1) == hit.cell_y));
    return same ? Uncertified::proven : oracle::pixel_apart;
}

/// Of what stages write that the last run has not got through, nothing is known.
void RangeBatch::give_up(int quad) {
    for (std::size_t s = 0; s < plan_.slots.size(); ++s)
        for (int lane = 0; through_[s] > stages_run_ && lane < quad_lanes; ++lane)
            result(s, quad_lanes * quad + lane) = unknown;
    for (int lane = 0; lane < quad_lanes; ++lane)
        undecided_[static_cast<std::size_t>(quad_lanes * quad + lane)] =
            context_->undecided[lane] | (discarding_.any() ? undecided_presence : 0);
}

/// What the last run has left says of a lane's fragment.
void RangeBatch::record_presence(LaneWays& ways, int lane) const {
    bool may_be_kept = true, may_be_discarded = false;
    if (const void* const status = values_[static_cast<std::size_t>(slot_of(Value::hit_status))];
        discarding_.by_status && status != nullptr) {
        const auto* const ends =
            static_cast<const std::int32_t*>(status) + 2 * static_cast<std::ptrdiff_t>(lane);
        constexpr auto clip = static_cast<std::int32_t>(Status::clip);
        may_be_discarded |= ends[0] <= clip && clip <= ends[1];
        may_be_kept &= ends[0] != clip || ends[1] != clip;
    }
    if (const void* const opacity = values_[static_cast<std::size_t>(slot_of(Value::opacity))];
        discarding_.below >= 0 && opacity != nullptr) {
        double low = 0, high = 0;
        plan_.table->ends(opacity, lane, &low, &high);
        may_be_discarded |= !(low >= discarding_.below);
        may_be_kept &= !(high < discarding_.below);
    }
    ways.kept |= may_be_kept;
    ways.discarded |= may_be_discarded;
}

/// The ranges of a lane that the last run has left.
void RangeBatch::record(int quad, int lane) {
    for (std::size_t s = 0; s < plan_.slots.size(); ++s) {
        FragmentRange range;
        plan_.table->ends(values_[static_cast<std::size_t>(plan_.slots[s])], lane, &range.low,
                          &range.high);
        range.gap_low = range.gap_high = range.high;
        if (context_->followed < 0)
            result(s, quad_lanes * quad + lane) = range;
        else
            ways_[s].push_back(range);
    }
    record_presence(lanes_[static_cast<std::size_t>(lane)], lane);
    const int uv = slot_of(Value::hit_uv);
    for (int axis = 0; axis < 2; ++axis) {
        const void* const values = values_[static_cast<std::size_t>(uv + axis)];
        if (values == nullptr) return;
        FragmentRange way,
            &all = lanes_[static_cast<std::size_t>(lane)].hit[static_cast<std::size_t>(axis)];
        plan_.table->ends(values, lane, &way.low, &way.high);
        all = {std::min(all.low, way.low), std::max(all.high, way.high)};
    }
}

/// One way after another, if they are no more than `most`; else none.
bool RangeBatch::follow_ways(const MaterialPlan& plan, int quad, int lane, int most) {
    const LaneWays lane_before = lanes_[static_cast<std::size_t>(lane)];
    const std::size_t before = ways_.empty() ? 0 : ways_.front().size();
    context_->begin_lane(lane);
    int count = 0;
    do {
        run_stages(plan);
        record(quad, lane);
    } while (!context_->too_many && ++count < most && context_->next_way());
    const bool all = !context_->too_many && (count < most || !context_->next_way());
    if (all) return true;
    for (auto& ways : ways_) ways.resize(before);
    lanes_[static_cast<std::size_t>(lane)] = lane_before;
    return false;
}

/// Where a lane's height map may be read at levels from `from` to `to`. Where that has too many
/// ways, the sides of decisions are taken together, but for those between constants: first of all
/// decisions but the search's, whose hits may lie far apart, then of these as well.
bool RangeBatch::follow_levels(const MaterialPlan& plan, int quad, int lane, double from,
                               double to) {
    context_->level_from = from;
    context_->level_to = to;
    bool all = false;
    for (const std::uint32_t kinds : {0u, ~Undecided::hit, RangeContext::all_kinds}) {
        context_->together = kinds;
        all = follow_ways(plan, quad, lane, most_ways);
        if (all) break;
    }
    context_->together = 0;
    context_->level_from = -no_border;
    context_->level_to = no_border;
    return all;
}

/// The ends of the parts that the last run's levels are gone through in; between whole levels,
/// since look-ups in more than two do not hang together. None where levels are known, or nothing is
/// known of them.
std::vector<double> RangeBatch::level_borders(int lane) const {
    std::vector<double> borders;
    if (!context_->level_known[lane]) return borders;
    const RealInterval& all = context_->clamped_level[lane];
    const double step = all.width() <= most_levels_apart ? levels_at_once : 1;
    for (double k = std::floor(all.lo / step) + 1; k * step < all.hi; ++k)
        borders.push_back(k * step);
    return borders;
}

/// Part by part and way by way. Where even that is too much, all is taken together, as it is
/// already.
void RangeBatch::follow(const MaterialPlan& plan, int quad, int lane,
                        const std::vector<double>& borders) {
    for (auto& ways : ways_) ways.clear();
    const LaneWays together = lanes_[static_cast<std::size_t>(lane)];
    lanes_[static_cast<std::size_t>(lane)] = no_way;
    bool all = true;
    for (std::size_t part = 0; part <= borders.size() && all; ++part)
        all = follow_levels(plan, quad, lane, part == 0 ? -no_border : borders[part - 1],
                            part == borders.size() ? no_border : borders[part]);
    if (!all) lanes_[static_cast<std::size_t>(lane)] = together;
    for (std::size_t s = 0; all && s < plan_.slots.size(); ++s)
        result(s, quad_lanes * quad + lane) = joined(ways_[s]);
}

const FragmentRange& RangeBatch::range(const ChannelSource& channel, int lane) const {
    const auto slot = std::ranges::find(plan_.slots, channel.slot()) - plan_.slots.begin();
    return results_[static_cast<std::size_t>(slot) * batch_lanes + static_cast<std::size_t>(lane)];
}

}  // namespace quadrel
