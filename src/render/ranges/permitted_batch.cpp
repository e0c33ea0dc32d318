#include "render/ranges/permitted_batch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <memory>
#include <utility>

#include "quadrel/num/math.hpp"
#include "quadrel/num/srgb.hpp"
#include "quadrel/quad/interpolate.hpp"
#include "render/ranges/exact_rows.hpp"

namespace quadrel {
namespace {

constexpr std::size_t batch_size = batch_lanes;
/// Rounding of what moves what must not take it past what is permitted.
constexpr double inside = 1 - 0x1p-10;

/// A component of what `interpolate` makes of three vertices: where these have it, in floats.
struct Varying {
    Value value;
    int component;
    bool of_frame;  ///< of a PrimitiveFrame, else of a PrimitiveData
    std::size_t offset, stride;
};

constexpr auto varyings = [] {
    std::array<Varying, PermittedErrors::varyings> all{};
    std::size_t n = 0;
    const auto add = [&](Value value, int components, bool of_frame, std::size_t bytes) {
        for (int c = 0; c < components; ++c)
            all[n++] = {value, c, of_frame, bytes / sizeof(float) + static_cast<std::size_t>(c),
                        static_cast<std::size_t>(components)};
    };
    add(Value::P, 3, false, offsetof(PrimitiveData, position));
    add(Value::vertex_normal, 3, false, offsetof(PrimitiveData, normal));
    add(Value::uv, 2, false, offsetof(PrimitiveData, uv));
    add(Value::vertex_tangent, 3, true, offsetof(PrimitiveFrame, tangent));
    add(Value::tangent_sign, 1, true, offsetof(PrimitiveFrame, tangent_sign));
    add(Value::vertex_bitangent, 3, true, offsetof(PrimitiveFrame, bitangent));
    add(Value::quadric, 2, true, offsetof(PrimitiveFrame, quadric));
    return all;
}();

bool is_interpolation(const PlannedStage& stage) {
    return stage.info->text.id == std::string_view(Interpolate::text.id);
}

/// Floats of a level.
std::size_t size_of(const TextureView& view, int level) {
    return static_cast<std::size_t>(view.width[level]) *
           static_cast<std::size_t>(view.height[level]) *
           static_cast<std::size_t>(view.channels * view.faces);
}

/// The float in [low, high] that is nearest to x; where there is none, the nearest one.
float float_within(double x, double low, double high) {
    auto rounded = static_cast<float>(x);
    if (rounded > high) rounded = std::nextafter(rounded, -INFINITY);
    if (rounded < low) rounded = std::nextafter(rounded, INFINITY);
    return rounded;
}

/// Whether the gradients of the undisplaced UV are for the stage's look-ups, and for nothing else:
/// with those of positions they make a frame.
bool filters_by_gradients(const PlannedStage& stage) {
    const auto reads = [&](Value v) { return std::ranges::count(stage.info->inputs, v) != 0; };
    return reads(Value::dUVdx) && reads(Value::dUVdy) && !reads(Value::dPdx);
}

/// Between which two lengths of a footprint a level of detail may be made, as levels beside that of
/// the longer gradient. Of one lane: gradients in texels along x and y.
struct FreeLevels {
    double low, high;
};
FreeLevels free_levels(const SamplerState& sampler, LodFreedom freedom, const double (&x)[2],
                       const double (&y)[2]) {
    const double square_x = x[0] * x[0] + x[1] * x[1], square_y = y[0] * y[0] + y[1] * y[1];
    const double longest = std::sqrt(std::max(square_x, square_y));
    const double both = std::sqrt(square_x + square_y);
    if (!(longest > 0x1p-500)) return {0, 0};
    const double own = sampler.lod_form == LodForm::ellipse ? both : longest;
    if (freedom == LodFreedom::exact) return {0, 0};
    if (freedom == LodFreedom::d3d) return {0, log2(both / own)};
    const auto size = [](double v) { return std::fabs(v); };
    const double least = std::max({size(x[0]), size(x[1]), size(y[0]), size(y[1])});
    double most = 0x1.6a09e667f3bccp+0 * std::max(size(x[0]) + size(x[1]), size(y[0]) + size(y[1]));
    if (freedom == LodFreedom::gl)
        most = std::max(most, std::max(size(x[0]), size(y[0])) + std::max(size(x[1]), size(y[1])));
    return {log2(least / longest), log2(most / own)};
}

}  // namespace

/// Arrays as they were, in the end.
class PermittedBatch::KeptValues {
  public:
    explicit KeptValues(const PermittedBatch& batch) : batch_(batch) {}
    KeptValues(const KeptValues&) = delete;
    KeptValues& operator=(const KeptValues&) = delete;
    ~KeptValues() {
        for (const auto& [slot, values] : kept_) std::ranges::copy(values, batch_.floats(slot));
    }
    void keep(int first, int count) {
        for (int slot = first; slot < first + count; ++slot)
            if (const float* const values = batch_.floats(slot); values != nullptr)
                kept_.emplace_back(slot, std::vector<float>(values, values + batch_size));
    }

  private:
    const PermittedBatch& batch_;
    std::vector<std::pair<int, std::vector<float>>> kept_;
};

/// With each number as `move` makes it of its value and its channel. Made once.
template <class Move>
const SampledTexture* PermittedBatch::MovedMap::moved(const SampledTexture& from,
                                                      const Move& move) {
    const TextureView& view = from.view;
    if (of != view.texels) {
        of = view.texels;
        const int last = view.levels - 1;
        texels.resize(static_cast<std::size_t>(view.offset[last]) + size_of(view, last));
        for (int level = 0; level < view.levels; ++level)
            for (std::size_t i = 0; i < size_of(view, level); ++i) {
                const std::size_t at = static_cast<std::size_t>(view.offset[level]) + i;
                const auto channel = static_cast<int>(i % static_cast<std::size_t>(view.channels));
                texels[at] = static_cast<float>(move(static_cast<double>(of[at]), channel));
            }
    }
    map = from;
    map.view.texels = texels.data();
    return &map;
}

PermittedBatch::PermittedBatch(const RenderPlan& plan, const Geometry& geometry,
                               const ErrorBudget& budget)
    : plan_(plan),
      geometry_(geometry),
      budget_(budget),
      placed_(sizeof(float)),
      values_(slot_count, nullptr),
      exact_(slot_count, nullptr) {
    for (auto& edge : edges_) edge.resize(batch_size);
}

void PermittedBatch::prepare(std::uint32_t material) {
    const MaterialPlan& plan = plan_.materials[material];
    if (prepared_ == &plan) return;
    prepared_ = &plan;
    material_ = material;
    placed_.prepare(plan);
    const auto for_each_array = [&](const auto& take) {
        for (std::size_t v = 0; v < plan.values.size(); ++v)
            for (int i = 0; plan.values[v] && i < arrays_of(static_cast<Value>(v)); ++i)
                take(static_cast<std::size_t>(slot_of(static_cast<Value>(v)) + i));
    };
    std::size_t arrays = 0;
    for_each_array([&](std::size_t) { ++arrays; });
    // One more, where the first is aligned for the widest lanes.
    memory_.assign((arrays + 1) * batch_size, 0.0f);
    exact_memory_.assign(arrays * batch_size, 0.0);
    std::ranges::fill(values_, nullptr);
    std::ranges::fill(exact_, nullptr);
    void* aligned = memory_.data();
    std::size_t room = memory_.size() * sizeof(float);
    auto* next =
        static_cast<float*>(std::align(64, arrays * batch_size * sizeof(float), aligned, room));
    double* next_exact = exact_memory_.data();
    for_each_array([&](std::size_t slot) {
        values_[slot] = next;
        exact_[slot] = next_exact;
        next += batch_size;
        next_exact += batch_size;
    });
}

void PermittedBatch::run(const QuadCoverage& quad, int samples, bool centroid,
                         std::span<const PermittedErrors> implementations,
                         const SharedChoices& shared) {
    prepare(geometry_.triangles[quad.triangle].material);
    implementations_ = implementations;
    shared_ = shared;
    quads_.assign(batch_quads, quad);
    placed_.load(quads_.data(), static_cast<int>(quads_.size()), geometry_, samples, centroid);
    call_ = stage_call(plan_, material_);
    placed_.point_to_quads(call_, geometry_);
    interpolate_exactly(call_, geometry_);
    uniforms_ = *call_.material;
    uniforms_.heights_bounded = 0;
    uniforms_.maxima = nullptr;
    call_.material = &uniforms_;
    frame_ = *call_.frame;
    const bool any_derivative = budget_.derivatives != DerivativeFreedom::exact;
    if (any_derivative) frame_.derivatives = shared.derivatives;
    call_.frame = &frame_;
    call_.values = values_.data();
    call_.lanes = static_cast<std::int32_t>(batch_size);
    snap_vertices();
    for (std::size_t i = 0; i < prepared_->stages.size(); ++i) {
        const PlannedStage& stage = prepared_->stages[i];
        call_.parameters = stage.params.data();
        call_.light = stage.light;
        if (is_interpolation(stage))
            interpolate(stage);
        else
            run_looking_up(stage, i);
        if (any_derivative && stores(stage, Value::dUVdx)) choose_differences();
    }
}

/// The edge functions of triangles whose vertices have been moved: at a place, what they were
/// there less what the vertices' moves come to.
void PermittedBatch::snap_vertices() {
    for (std::size_t q = 0; q < batch_quads; ++q) {
        const double* const edge[3] = {call_.edges[0] + 4 * q, call_.edges[1] + 4 * q,
                                       call_.edges[2] + 4 * q};
        for (std::size_t k = 0; k < 4; ++k) {
            const double sum = edge[0][k] + edge[1][k] + edge[2][k];
            double move[2] = {};
            for (int v = 0; v < 3 && q < implementations_.size(); ++v)
                for (int axis = 0; axis < 2; ++axis)
                    move[axis] += edge[v][k] / sum * inside * budget_.snapping *
                                  static_cast<double>(implementations_[q].snapping(v, axis));
            for (int v = 0; v < 3; ++v)
                edges_[v][4 * q + k] = edge[v][k] - move[0] * (edge[v][1] - edge[v][0]) -
                                       move[1] * (edge[v][2] - edge[v][0]);
        }
    }
    for (int v = 0; v < 3; ++v) call_.edges[v] = edges_[v].data();
}

void PermittedBatch::interpolate(const PlannedStage& stage) {
    StageCall exactly = call_;
    exactly.values = exact_.data();
    find_kernel(scalar_double_kernels(), stage.info->text.id)(&exactly);
    for (const Value value : stage.info->outputs)
        for (int i = 0; i < arrays_of(value); ++i) {
            const auto slot = static_cast<std::size_t>(slot_of(value) + i);
            if (values_[slot] == nullptr) continue;
            const auto* const exact = static_cast<const double*>(exact_[slot]);
            std::transform(exact, exact + batch_size, floats(static_cast<int>(slot)),
                           [](double x) { return static_cast<float>(x); });
        }
    for (int varying = 0; varying < PermittedErrors::varyings; ++varying) move_varying(varying);
}

void PermittedBatch::move_varying(int varying) {
    const Varying& of = varyings[static_cast<std::size_t>(varying)];
    const int slot = slot_of(of.value) + of.component;
    float* const moved = floats(slot);
    if (moved == nullptr || (of.of_frame && call_.frames == nullptr)) return;
    const auto row = call_.primitive[0];
    const auto* const first = of.of_frame ? reinterpret_cast<const float*>(call_.frames + row)
                                          : reinterpret_cast<const float*>(call_.primitives + row);
    double largest = 0;
    for (std::size_t v = 0; v < 3; ++v)
        largest =
            std::max(largest, std::fabs(static_cast<double>(first[of.offset + v * of.stride])));
    const auto exact = [&](int s) {
        return static_cast<const double*>(exact_[static_cast<std::size_t>(s)]);
    };
    for (std::size_t i = 0; i < 4 * implementations_.size(); ++i) {
        const PermittedErrors& errors = implementations_[i / 4];
        double middle = exact(slot)[i], spread = 0;
        for (int v = 0; v < 3; ++v) {
            const double weight = exact(slot_of(Value::bary) + v)[i];
            middle += weight * inside * budget_.plane * largest *
                      static_cast<double>(errors.vertex(varying, v));
            spread += std::fabs(weight);
        }
        const double own = inside * budget_.evaluation * largest * spread;
        const double share = errors.lane(varying, static_cast<int>(i % 4));
        moved[i] = float_within(middle + own * share, middle - own, middle + own);
    }
}

/// Of each lane, along which row or column.
void PermittedBatch::choose_differences() {
    constexpr Value values[] = {Value::dPdx, Value::dPdy, Value::dUVdx, Value::dUVdy};
    for (int d = 0; d < PermittedErrors::differences; ++d)
        for (int component = 0; component < info(values[d]).components; ++component) {
            float* const of = floats(slot_of(values[d]) + component);
            for (std::size_t q = 0; of != nullptr && q < implementations_.size(); ++q) {
                const float own[4] = {of[4 * q], of[4 * q + 1], of[4 * q + 2], of[4 * q + 3]};
                for (std::size_t k = 0; k < 4; ++k)
                    of[4 * q + k] = own[lane_of_difference(d, q, k)];
            }
        }
}

/// Which lane's own difference a lane has.
std::size_t PermittedBatch::lane_of_difference(int difference, std::size_t implementation,
                                               std::size_t lane) const {
    const PermittedErrors& errors = implementations_[implementation];
    const bool along_y = difference % 2 != 0;
    const std::size_t across = along_y ? 1 : 2;  // to the lane in the other row, or column
    if (budget_.derivatives == DerivativeFreedom::each)
        return errors.takes_other(difference, static_cast<int>(lane)) ? lane ^ across : lane;
    if (!errors.is_coarse()) return lane;
    return errors.along_second(along_y) ? across : 0;
}

/// How long gradients of the undisplaced UV are for the stage's look-ups, which makes their level
/// of detail: as the choice has it between all that each of its maps permits in a lane.
void PermittedBatch::stretch_gradients(const PlannedStage& stage) {
    constexpr double most = 16;
    for (std::size_t i = 0; i < 4 * implementations_.size(); ++i) {
        double low = -most, high = most;
        for (const TextureSlot slot : stage.info->textures) {
            const SampledTexture* const texture = call_.textures[static_cast<int>(slot)];
            if (texture == nullptr || texture->view.faces != 1) continue;
            const auto gradient = [&](Value v, int axis) {
                const double size = axis == 0 ? texture->view.width[0] : texture->view.height[0];
                return static_cast<double>(floats(slot_of(v) + axis)[i]) * size;
            };
            const double x[2] = {gradient(Value::dUVdx, 0), gradient(Value::dUVdx, 1)};
            const double y[2] = {gradient(Value::dUVdy, 0), gradient(Value::dUVdy, 1)};
            const FreeLevels lane = free_levels(texture->sampler, budget_.lod_freedom, x, y);
            low = std::max(low, lane.low - budget_.lod);
            high = std::min(high, lane.high + budget_.lod);
        }
        if (low == -most) return;  // it has no map
        const double middle = (low + high) / 2, radius = inside * std::max(0.0, high - low) / 2;
        const double factor = exp2(middle + radius * (2 * shared_.level - 1));
        for (const Value v : {Value::dUVdx, Value::dUVdy})
            for (int axis = 0; axis < 2; ++axis) {
                float& of = floats(slot_of(v) + axis)[i];
                of = static_cast<float>(static_cast<double>(of) * factor);
            }
    }
}

/// Heights that are filtered by a little too much or too little.
void PermittedBatch::move_heights() {
    constexpr auto slot = static_cast<int>(TextureSlot::height);
    const SampledTexture* const texture = plan_.textures[material_].bound(slot);
    if (texture == nullptr || shared_.filtered == 0) return;
    const double factor = 1 + (shared_.filtered > 0 ? 1 : -1) * inside * budget_.filtered;
    call_.textures[slot] = heights_[shared_.filtered > 0 ? 1 : 0].moved(
        *texture, [&](double h, int) { return h * factor; });
}

/// sRGB8 that is decoded as if all codes were a little lower or higher.
void PermittedBatch::move_decoded() {
    constexpr int alpha = 3;
    const double codes = (shared_.srgb > 0 ? 1 : -1) * inside * budget_.srgb / 255;
    if (shared_.srgb == 0 || codes == 0) return;
    for (int slot = 0; slot < texture_slot_count; ++slot) {
        const auto& texture = plan_.textures[material_].owned[static_cast<std::size_t>(slot)];
        if (!texture || texture->format() != TexelFormat::srgb8) continue;
        MovedMap& moved = decoded_[shared_.srgb > 0 ? 1 : 0][static_cast<std::size_t>(slot)];
        call_.textures[slot] =
            moved.moved(*plan_.textures[material_].bound(slot), [&](double x, int channel) {
                const bool is_exact = channel == alpha || x <= 0 || x >= 1;
                return is_exact ? x : srgb_decode(std::max(srgb_encode(x) + codes, 0.0));
            });
    }
}

/// Whether a stage reads maps by filtered look-ups. Noise is computed, and what reads patches of
/// level 0 reads texels. What is found in a warped image does not move with the place it is found
/// at.
bool PermittedBatch::looks_up(const PlannedStage& stage) const {
    if (stage.info->reads_finest_heights_only) return false;
    if (std::ranges::count(stage.info->textures, TextureSlot::prewarp) != 0) return false;
    return std::ranges::any_of(stage.info->textures, [&](TextureSlot slot) {
        if (uniforms_.noise_octaves > 0 && source_of(slot) == TextureSlot::height) return false;
        return plan_.textures[material_].bound(static_cast<int>(slot)) != nullptr;
    });
}

/// How far the stage's coordinates may be off, in UV, whichever of its maps they are of.
std::array<double, 2> PermittedBatch::texel_error(const PlannedStage& stage) const {
    int width = 1, height = 1;
    for (const TextureSlot slot : stage.info->textures)
        if (const SampledTexture* const texture =
                plan_.textures[material_].bound(static_cast<int>(slot));
            texture != nullptr) {
            width = std::max(width, texture->view.width[0]);
            height = std::max(height, texture->view.height[0]);
        }
    return {inside * budget_.address / width, inside * budget_.address / height};
}

void PermittedBatch::run_looking_up(const PlannedStage& stage, std::size_t number) {
    if (!looks_up(stage)) return stage.run(&call_);
    const bool finds = stores(stage, Value::hit_uv);
    KeptValues kept(*this);
    if (filters_by_gradients(stage)) {
        kept.keep(slot_of(Value::dUVdx), 2);
        kept.keep(slot_of(Value::dUVdy), 2);
        stretch_gradients(stage);
    }
    const int from = slot_of(finds ? Value::uv : Value::hit_uv);
    kept.keep(from, 2);
    std::array<std::vector<float>, 2> move;
    for (int axis = 0; axis < 2; ++axis)
        move[static_cast<std::size_t>(axis)] = move_place(stage, number, from, axis);
    const std::array textures = std::to_array(call_.textures);
    move_decoded();
    move_heights();
    stage.run(&call_);
    std::ranges::copy(textures, call_.textures);
    for (int axis = 0; axis < 2 && finds; ++axis) {
        float* const hit = floats(slot_of(Value::hit_uv) + axis);
        const std::vector<float>& by = move[static_cast<std::size_t>(axis)];
        for (std::size_t i = 0; hit != nullptr && i < by.size(); ++i) hit[i] -= by[i];
    }
}

/// Moves the coordinates that look-ups start from along an axis, and says by how much.
std::vector<float> PermittedBatch::move_place(const PlannedStage& stage, std::size_t number,
                                              int slot, int axis) {
    std::vector<float> move(batch_size, 0.0f);
    float* const place = floats(slot + axis);
    if (place == nullptr) return move;
    const double error = texel_error(stage)[static_cast<std::size_t>(axis)];
    for (std::size_t q = 0; q < implementations_.size(); ++q) {
        float largest = 0;
        for (std::size_t i = 4 * q; i < 4 * q + 4; ++i)
            largest = std::max(largest, std::fabs(place[i]));
        if (!(largest < 0x1p60f)) continue;
        // A multiple of what coordinates of twice the size are rounded to: moves are exact.
        int exponent = 0;
        std::frexp(largest, &exponent);
        const double unit = std::ldexp(1.0, exponent - 23);
        const double share = implementations_[q].address(number, axis);
        const auto by = static_cast<float>(std::trunc(share * error / unit) * unit);
        for (std::size_t i = 4 * q; i < 4 * q + 4; ++i) {
            move[i] = by;
            place[i] += by;
        }
    }
    return move;
}

}  // namespace quadrel
