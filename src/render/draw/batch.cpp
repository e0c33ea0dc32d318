#include "render/draw/batch.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <new>
#include <span>

#include "quadrel/check.hpp"
#include "render/draw/border_check.hpp"
#include "render/inject/injected_values.hpp"
#include "render/plan/chains.hpp"

namespace quadrel {
namespace {

constexpr std::align_val_t alignment{64};
constexpr int padding_quads = 4;  // the widest packet

/// The evaluation point of each lane, in pixels.
void load_window(const QuadPoints& points, float* const (&window)[2], int lane) {
    for (std::size_t k = 0; k < 4; ++k) {
        window[0][lane + static_cast<int>(k)] = static_cast<float>(points.x[k]) / subpixel_units;
        window[1][lane + static_cast<int>(k)] = static_cast<float>(points.y[k]) / subpixel_units;
    }
}

/// How many quads from the first on lie side by side in one triangle.
int run_length(const QuadCoverage* quads, int count) {
    int n = 1;
    while (n < count && quads[n].triangle == quads->triangle && quads[n].y == quads->y &&
           quads[n].x == quads->x + 2 * n)
        ++n;
    return n;
}

/// Whether the arrays hold numbers of the batch's type, which may be 8 bytes long.
constexpr auto real_slots = [] {
    std::array<bool, slot_count> real{};
    for (int v = 0; v < static_cast<int>(Value::count); ++v)
        for (int i = 0; i < arrays_of(static_cast<Value>(v)); ++i)
            real[static_cast<std::size_t>(slot_of(static_cast<Value>(v)) + i)] =
                info(static_cast<Value>(v)).kind == ValueKind::real;
    return real;
}();

/// Look-ups so far in the textures that the stage reads.
std::uint64_t fetches_of(const PlannedStage& stage, const FetchCounters* counters) {
    std::uint64_t sum = 0;
    if (counters != nullptr)
        for (const TextureSlot slot : stage.info->textures)
            sum += counters[static_cast<int>(slot)].fetches;
    return sum;
}

void run_stage(const PlannedStage& stage, const StageCall& call, StageClock* clock) {
    if (clock == nullptr) return stage.run(&call);
    const std::uint64_t before = fetches_of(stage, call.counters);
    clock->start(stage.info->text.id);
    stage.run(&call);
    clock->lap(fetches_of(stage, call.counters) - before);
}

}  // namespace

void Batch::Free::operator()(std::byte* memory) const { ::operator delete[](memory, alignment); }

Batch::Batch(int scalar_bytes, const ProbeCommand* command)
    : scalar_bytes_(scalar_bytes),
      command_(command),
      values_(slot_count, nullptr),
      values_of_chains_(slot_count, nullptr) {}

void Batch::prepare(const MaterialPlan& plan) {
    const ValueSet& values = plan.values;
    // One size for every array, whatever its kind: alignment stays simple.
    const std::size_t array_bytes = std::size_t(batch_lanes) * scalar_bytes_;
    const std::size_t arrays_an_edge =
        std::max<std::size_t>(1, sizeof(double) / static_cast<std::size_t>(scalar_bytes_));
    std::size_t arrays = 4 + 3 * arrays_an_edge;
    for (std::size_t v = 0; v < values.size(); ++v)
        if (values[v]) arrays += arrays_of(static_cast<Value>(v));
    if (arrays * array_bytes > capacity_) {
        capacity_ = arrays * array_bytes;
        memory_.reset(static_cast<std::byte*>(::operator new[](capacity_, alignment)));
    }
    std::byte* next = memory_.get();
    const auto take = [&](std::size_t count = 1) {
        std::byte* array = next;
        next += count * array_bytes;
        return array;
    };
    for (double*& edge : edges_) edge = reinterpret_cast<double*>(take(arrays_an_edge));
    for (float*& window : window_) window = reinterpret_cast<float*>(take());
    primitive_ = reinterpret_cast<std::int32_t*>(take());
    active_ = reinterpret_cast<std::uint32_t*>(take());
    std::fill(values_.begin(), values_.end(), nullptr);
    std::fill(values_of_chains_.begin(), values_of_chains_.end(), nullptr);
    for (std::size_t v = 0; v < values.size(); ++v) {
        if (!values[v]) continue;
        const int first = slot_of(static_cast<Value>(v));
        for (int i = 0; i < arrays_of(static_cast<Value>(v)); ++i) {
            values_[first + i] = take();
            if (plan.in_arrays[v]) values_of_chains_[first + i] = values_[first + i];
            if (!plan.produced[v]) std::memset(values_[first + i], 0, array_bytes);
        }
    }
    links_.clear();
    for (const PlannedChain& chain : plan.chains) links_.push_back(chain_stages(plan, chain));
}

void Batch::load(const QuadCoverage* quads, int count, const Geometry& geometry, int samples,
                 bool centroid, bool runs) {
    begin_load(quads, count);
    const auto load_one = [&](const QuadCoverage& quad, int q) {
        const ScreenTriangle& triangle = geometry.triangles[quad.triangle].screen;
        load_quad(quad, q, geometry,
                  centroid ? quad_centroids(triangle, quad.x, quad.y, samples)
                           : quad_centres(quad.x, quad.y));
    };
    for (int q = 0; q < count;) {
        const int run = runs && !centroid ? run_length(quads + q, count - q) : 1;
        if (run > 1)
            load_run(quads[q], q, run, geometry);
        else
            load_one(quads[q], q);
        q += run;
    }
    // Padding repeats the last quad, inactive: every address that it computes is valid.
    for (int q = count; q < lanes_ / 4; ++q) load_one(quads[count - 1], q);
    if (scalar_bytes_ == sizeof(Dual)) load_slopes(quads, geometry);
    end_load(count);
}

void Batch::load(const QuadCoverage* quads, int count, const Geometry& geometry,
                 const QuadPlaces& places) {
    QUADREL_CHECK(geometry.planes.empty(), geometry.planes.size());
    begin_load(quads, count);
    for (int q = 0; q < lanes_ / 4; ++q) {
        const QuadCoverage& quad = quads[std::min(q, count - 1)];
        attribute_edges(geometry.triangles[quad.triangle].screen, quad, places.at(quad.x, quad.y),
                        edges_[0] + 4 * q, edges_[1] + 4 * q, edges_[2] + 4 * q);
        std::fill_n(primitive_ + 4 * q, 4, static_cast<std::int32_t>(quad.triangle));
    }
    end_load(count);
}

void Batch::begin_load(const QuadCoverage* quads, int count) {
    quads_ = count;
    loaded_ = quads;
    lanes_ = 4 * ((count + padding_quads - 1) / padding_quads * padding_quads);
}

/// Lanes of real quads are active, helpers included.
void Batch::end_load(int count) {
    std::fill_n(active_, 4 * count, 0xffffffffu);
    std::fill(active_ + 4 * count, active_ + lanes_, 0u);
}

void Batch::load_quad(const QuadCoverage& quad, int q, const Geometry& geometry,
                      const QuadPoints& points) {
    const ScreenTriangle& triangle = geometry.triangles[quad.triangle].screen;
    attribute_edges(triangle, points, edges_[0] + 4 * q, edges_[1] + 4 * q, edges_[2] + 4 * q);
    if (!geometry.planes.empty()) load_window(points, window_, 4 * q);
    std::fill_n(primitive_ + 4 * q, 4, static_cast<std::int32_t>(quad.triangle));
}

/// `count` quads from the given one on, which is the batch's quad q.
void Batch::load_run(const QuadCoverage& quad, int q, int count, const Geometry& geometry) {
    const ScreenTriangle& triangle = geometry.triangles[quad.triangle].screen;
    attribute_edges(triangle, quad.x, quad.y, count, edges_[0] + 4 * q, edges_[1] + 4 * q,
                    edges_[2] + 4 * q);
    if (!geometry.planes.empty())
        for (int i = 0; i < count; ++i)
            load_window(quad_centres(quad.x + 2 * i, quad.y), window_, 4 * (q + i));
    std::fill_n(primitive_ + 4 * q, 4 * count, static_cast<std::int32_t>(quad.triangle));
}

void Batch::load_slopes(const QuadCoverage* quads, const Geometry& geometry) {
    slopes_.resize(static_cast<std::size_t>(lanes_ / 4));
    for (int q = 0; q < lanes_ / 4; ++q)
        slopes_[static_cast<std::size_t>(q)] =
            edge_slopes(geometry.triangles[quads[std::min(q, quads_ - 1)].triangle].screen);
}

void Batch::run(const MaterialPlan& plan, StageCall call, const Geometry& geometry,
                StageClock* clock, const Shortcuts& shortcuts) {
    call.values = values_.data();
    call.lanes = lanes_;
    point_to_quads(call, geometry);
    // Shortcuts take for granted that values are those of the batch's own stages.
    const bool is_own = injected_ == nullptr;
    if (shortcuts.shared_scales && is_own) {
        std::fill(scales_->keys, scales_->keys + lanes_ / 4, 0);
        call.scales = scales_.get();
    }
    const bool is_timed = clock != nullptr && clock->begin_batch(&plan, lanes_);
    // What a chain has broken a promise in is done again, so that the stage is found and named.
    if (!is_timed && shortcuts.chains && is_own && !plan.chains.empty() && run_chains(plan, call))
        return;
    run_stages(plan, 0, plan.stages.size(), call, is_timed ? clock : nullptr);
}

void Batch::point_to_quads(StageCall& call, const Geometry& geometry, int first_quad) const {
    const int lane = 4 * first_quad;
    call.active = active_ + lane;
    for (int i = 0; i < 3; ++i) call.edges[i] = edges_[i] + lane;
    for (int i = 0; i < 2; ++i)
        call.window[i] = geometry.planes.empty() ? nullptr : window_[i] + lane;
    call.planes = geometry.planes.empty() ? nullptr : geometry.planes.data();
    call.primitive = primitive_ + lane;
    call.primitives = geometry.data.data();
    call.frames = geometry.frames.empty() ? nullptr : geometry.frames.data();
    call.vertices = geometry.vertices.empty() ? nullptr : geometry.vertices.data();
    call.edge_slopes = slopes_.empty() ? nullptr : slopes_.data() + first_quad;
}

void Batch::run_beside(StageFunction function, StageCall call, Value output, void* to) const {
    std::vector<void*> arrays = values_;
    for (int i = 0; i < arrays_of(output); ++i)
        arrays[static_cast<std::size_t>(slot_of(output) + i)] =
            static_cast<std::byte*>(to) + std::ptrdiff_t(i) * batch_lanes * scalar_bytes_;
    const NoParams none;
    call.values = arrays.data();
    call.active = active_;
    call.lanes = lanes_;
    call.parameters = &none;
    function(&call);
}

void Batch::run_stages(const MaterialPlan& plan, std::size_t first, std::size_t end,
                       const StageCall& call, StageClock* clock) {
    StageCall own = call;
    for (std::size_t i = first; i < end; ++i) {
        const PlannedStage& stage = plan.stages[i];
        own.parameters = stage.params.data();
        own.light = stage.light;
        run_stage(stage, own, clock);
        check_border(stage);
        if (injected_ != nullptr) inject_after(plan, i);
    }
}

void Batch::inject_after(const MaterialPlan& plan, std::size_t stage) {
    const std::span quads(loaded_, static_cast<std::size_t>(quads_));
    injected_->replace(plan, stage, quads, [&](int slot, int lane, std::uint32_t bits) {
        if (!has(slot)) return;
        const bool wide = real_slots[static_cast<std::size_t>(slot)] && scalar_bytes_ == 8;
        const double number = std::bit_cast<float>(bits);
        set_element(slot, lane, wide ? std::bit_cast<std::uint64_t>(number) : bits);
    });
}

/// Runs the plan by its chains, and stage by stage between them. False if it is to be run again.
bool Batch::run_chains(const MaterialPlan& plan, StageCall call) {
    call.values = values_of_chains_.data();
    std::size_t next = 0;
    for (std::size_t i = 0; i < plan.chains.size(); ++i) {
        run_stages(plan, next, plan.chains[i].first, call, nullptr);
        if (!plan.chains[i].run(&call, links_[i].data())) return false;
        next = plan.chains[i].end;
    }
    run_stages(plan, next, plan.stages.size(), call, nullptr);
    return true;
}

void Batch::check_border(const PlannedStage& stage) const {
    const auto fault = find_border_fault(stage, values_.data(), 4 * quads_, scalar_bytes_);
    if (!fault) return;
    std::optional<QuadContext> context;
    if (command_) context.emplace(*command_, std::span(loaded_ + fault->lane / 4, 1));
    check_failed(__FILE__, __LINE__, "stage keeps its promises", fault->text);
}

std::uint64_t Batch::sum(int slot) const {
    std::uint64_t sum = 0;
    for (int lane = 0; has(slot) && lane < 4 * quads_; ++lane) sum += integer(slot, lane);
    return sum;
}

float Batch::real(int slot, int lane) const {
    if (scalar_bytes_ == sizeof(float)) return static_cast<const float*>(values_[slot])[lane];
    return static_cast<float>(static_cast<const double*>(values_[slot])[lane]);
}

std::uint64_t Batch::element(int slot, int lane) const {
    const bool wide = real_slots[static_cast<std::size_t>(slot)] && scalar_bytes_ == 8;
    const std::size_t bytes = wide ? 8 : 4;
    std::uint64_t bits = 0;
    std::memcpy(&bits, static_cast<const std::byte*>(values_[slot]) + bytes * std::size_t(lane),
                bytes);
    return bits;
}

void Batch::set_element(int slot, int lane, std::uint64_t bits) {
    const bool wide = real_slots[static_cast<std::size_t>(slot)] && scalar_bytes_ == 8;
    const std::size_t bytes = wide ? 8 : 4;
    std::memcpy(static_cast<std::byte*>(values_[slot]) + bytes * std::size_t(lane), &bits, bytes);
}

double Batch::number(int slot, int lane) const {
    if (scalar_bytes_ == sizeof(float)) return static_cast<const float*>(values_[slot])[lane];
    return static_cast<const double*>(values_[slot])[lane];
}

double Batch::difference(int slot, int a, int b) const {
    if (scalar_bytes_ == sizeof(float)) return real(slot, a) - real(slot, b);
    return number(slot, a) - number(slot, b);
}

LaneBits Batch::bits(const ChannelSource& source) const {
    const auto real =
        scalar_bytes_ == sizeof(float) ? LaneBits::Element::single : LaneBits::Element::wide;
    if (source.kind == ChannelSource::Kind::z)
        return {values_[slot_of(Value::hit_P) + 2], real, true};
    const bool integer = info(source.value).kind == ValueKind::integer;
    return {values_[source.slot()], integer ? LaneBits::Element::integer : real};
}

}  // namespace quadrel
