// Stages that run on ranges several times, for what a range forgets: that all differences are along
// one row and one column, and that a place is in one part of where it may be.
#include <algorithm>
#include <array>
#include <cstring>

#include "quadrel/num/range/ranged.hpp"
#include "render/ranges/range_batch.hpp"

namespace quadrel {
namespace {

constexpr std::array differences = {Value::dPdx, Value::dPdy, Value::dUVdx, Value::dUVdy};

bool takes_differences(const PlannedStage& stage) {
    return std::ranges::any_of(differences, [&](Value v) { return stores(stage, v); });
}

/// Lets each lane be what it is in another array, too.
void join_arrays(const RangeTable& table, ValueKind kind, void* values, const void* others) {
    if (kind == ValueKind::real) return table.join(values, others);
    auto* const ends = static_cast<std::int32_t*>(values);
    const auto* const other_ends = static_cast<const std::int32_t*>(others);
    for (int i = 0; i < 2 * RangeBatch::quad_lanes; i += 2) {
        ends[i] = std::min(ends[i], other_ends[i]);
        ends[i + 1] = std::max(ends[i + 1], other_ends[i + 1]);
    }
}

/// What decisions there have been, before a stage.
class Undecidedness {
  public:
    explicit Undecidedness(const RangeContext& context)
        : open_(context.open), joined_(context.joined) {}
    bool has_changed(const RangeContext& context) const {
        return context.open != open_ || context.joined != joined_ || context.too_many;
    }

  private:
    std::int32_t open_;
    std::uint32_t joined_;
};

/// Where a lane's hit may be, in parts along both axes.
class PlaceParts {
  public:
    static constexpr int along_axis = 4, count = along_axis * along_axis;

    PlaceParts(const RangeTable& table, RangeContext& context, void* u, void* v)
        : table_(table),
          context_(context),
          uv_{static_cast<Ranged*>(u), static_cast<Ranged*>(v)},
          places_(context.places),
          questions_(context.questions),
          questions_of_lane_(context.questions_of_lane) {
        for (std::size_t axis = 0; axis < 2; ++axis)
            for (int lane = 0; lane < RangeBatch::quad_lanes; ++lane) {
                const auto i = static_cast<std::size_t>(lane);
                whole_[axis][i] = uv_[axis][lane];
                table.ends(uv_[axis], lane, &ends_[axis][i].lo, &ends_[axis][i].hi);
            }
    }
    /// Whether parts of it say more: where it is a point, or nearly, slopes do not change.
    bool is_worth_it(int lane, const TextureView& heights) const {
        constexpr double least_texels = 1.0 / 64;
        const auto i = static_cast<std::size_t>(lane);
        const double width = std::max(ends_[0][i].width() * heights.width[0],
                                      ends_[1][i].width() * heights.height[0]);
        return whole_[0][i].is_bounded() && whole_[1][i].is_bounded() && width > least_texels;
    }
    /// Lets the lane's hit be in one part, and all others' anywhere.
    void take(int lane, int part) const {
        put_whole();
        const auto i = static_cast<std::size_t>(lane);
        const int numbers[2] = {part % along_axis, part / along_axis};
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const RealInterval& all = ends_[axis][i];
            const auto border = [&](int k) {
                return k == along_axis ? all.hi : all.lo + all.width() * k / along_axis;
            };
            uv_[axis][lane] = Ranged(border(numbers[axis]), border(numbers[axis] + 1));
        }
        table_.name_place(uv_[0], uv_[1]);
    }
    /// As it was.
    void put_back() const {
        put_whole();
        context_.places = places_;
        context_.questions = questions_;
        context_.questions_of_lane = questions_of_lane_;
    }

  private:
    void put_whole() const {
        for (std::size_t axis = 0; axis < 2; ++axis) std::ranges::copy(whole_[axis], uv_[axis]);
    }

    const RangeTable& table_;
    RangeContext& context_;
    Ranged* uv_[2];
    std::int32_t places_, questions_, questions_of_lane_;
    std::array<std::array<Ranged, RangeBatch::quad_lanes>, 2> whole_;
    std::array<std::array<RealInterval, RangeBatch::quad_lanes>, 2> ends_;
};

}  // namespace

/// With the place of each array in `kept`, where they lie one after the other.
template <class Take>
void RangeBatch::for_each_output(const PlannedStage& stage, std::vector<std::byte>& kept,
                                 const Take& take) {
    kept.resize(memory_.size());
    std::byte* next = kept.data();
    for (const Value value : stage.info->outputs)
        for (int i = 0; i < arrays_of(value); ++i)
            if (void* const values = values_[static_cast<std::size_t>(slot_of(value) + i)]) {
                take(info(value).kind, values, next);
                next += array_bytes;
            }
}

/// Whether it makes a frame of the differences of P and UV, all of which an implementation takes
/// along one row and one column.
bool RangeBatch::is_made_of_differences(const MaterialPlan& plan, std::size_t number) const {
    const PlannedStage& stage = plan.stages[number];
    return plan_.budget.derivatives == DerivativeFreedom::quad &&
           stage.info->text.room == std::string_view("frame") && stage.run != nullptr &&
           std::ranges::any_of(differences, [&](Value v) {
               return std::ranges::count(stage.info->inputs, v) != 0;
           });
}

/// The stage along either row and either column: of each lane what any of these makes of it. Its
/// own are among them, so that this holds fine differences, too. Where nothing has been undecided
/// so far it is the same in every run of the quad.
void RangeBatch::run_along_rows_and_columns(const MaterialPlan& plan, std::size_t number) {
    if (frame_.known) return take_known_frame(plan.stages[number]);
    const auto differentiate = static_cast<std::size_t>(
        std::ranges::find_if(plan.stages, takes_differences) - plan.stages.begin());
    if (differentiate >= number) return run_stage(plan, number);
    for (int choice = 0; choice < 4 && !context_->too_many; ++choice) {
        context_->row_and_column = choice;
        run_stage(plan, differentiate);
        run_stage(plan, number);
        for_each_output(plan.stages[number], frame_.arrays,
                        [&](ValueKind kind, void* values, std::byte* kept) {
                            if (choice > 0) join_arrays(*plan_.table, kind, values, kept);
                            std::memcpy(kept, values, array_bytes);
                        });
    }
    context_->row_and_column = -1;
    run_stage(plan, differentiate);
    frame_.known = context_->open == 0 && context_->joined == 0 && !context_->too_many;
    frame_.shared_errors = context_->shared_errors;
    frame_.unit_vectors = context_->unit_vectors;
}

void RangeBatch::take_known_frame(const PlannedStage& stage) {
    for_each_output(stage, frame_.arrays, [](ValueKind, void* values, const std::byte* kept) {
        std::memcpy(values, kept, array_bytes);
    });
    context_->shared_errors = std::max(context_->shared_errors, frame_.shared_errors);
    context_->unit_vectors = std::max(context_->unit_vectors, frame_.unit_vectors);
}

/// Whether it makes a normal of what maps have around the hit.
bool RangeBatch::is_made_at_the_hit(const MaterialPlan& plan, std::size_t number) const {
    const PlannedStage& stage = plan.stages[number];
    const auto slot = static_cast<std::size_t>(slot_of(Value::hit_uv));
    return stage.info->text.room == std::string_view("surface") && stage.run != nullptr &&
           std::ranges::count(stage.info->inputs, Value::hit_uv) != 0 && values_[slot] != nullptr &&
           values_[slot + 1] != nullptr;
}

/// Maps change within what a hit's place may be: heights at several places around it hang together
/// the better, the smaller it is. The stage runs for each part of it, of one lane after the other
/// since a stage may take differences, and what all parts make is what there is. Where something is
/// undecided, or becomes so, the place stays whole.
void RangeBatch::run_at_parts_of_the_place(const MaterialPlan& plan, std::size_t number) {
    const PlannedStage& stage = plan.stages[number];
    const SampledTexture* const heights = call_.textures[static_cast<int>(TextureSlot::height)];
    const Undecidedness before(*context_);
    run_stage(plan, number);
    if (heights == nullptr || before.has_changed(*context_)) return;
    for_each_output(stage, at_whole_, [](ValueKind, const void* values, std::byte* kept) {
        std::memcpy(kept, values, array_bytes);
    });
    const auto slot = static_cast<std::size_t>(slot_of(Value::hit_uv));
    const PlaceParts place(*plan_.table, *context_, values_[slot], values_[slot + 1]);
    // What is known as well as this needs no parts, which take as long as a short search.
    constexpr double narrow = 1.0 / 16;
    const auto is_wide = [&](int lane) {
        bool wide = false;
        for_each_output(stage, at_whole_, [&](ValueKind kind, void*, const std::byte* kept) {
            double low = 0, high = 0;
            if (kind == ValueKind::real) plan_.table->ends(kept, lane, &low, &high);
            wide |= !(high - low <= narrow);
        });
        return wide;
    };
    bool all = true;
    for (int lane = 0; lane < quad_lanes && all; ++lane) {
        if (!is_last_run_of(lane) || !place.is_worth_it(lane, heights->view)) continue;
        if (!is_wide(lane)) continue;
        for (int part = 0; part < PlaceParts::count && all; ++part) {
            place.take(lane, part);
            run_stage(plan, number);
            all = !before.has_changed(*context_);
            for_each_output(stage, at_parts_, [&](ValueKind kind, void* values, std::byte* kept) {
                if (part > 0) join_arrays(*plan_.table, kind, values, kept);
                std::memcpy(kept, values, array_bytes);
            });
        }
        if (all) narrow_to_parts(stage, lane);
    }
    place.put_back();
    for_each_output(stage, at_whole_, [](ValueKind, void* values, const std::byte* kept) {
        std::memcpy(values, kept, array_bytes);
    });
}

/// Whether what this run makes of a lane is what is known of it, and not what one that follows the
/// lane makes.
bool RangeBatch::is_last_run_of(int lane) const {
    if (quad_->samples[static_cast<std::size_t>(lane)] == 0) return false;
    if (context_->followed >= 0) return context_->followed == lane;
    return (context_->joined >> lane & 1) == 0 && level_borders(lane).empty();
}

/// What is kept of the whole place in a lane is no more than all parts make.
void RangeBatch::narrow_to_parts(const PlannedStage& stage, int lane) {
    std::byte* whole = at_whole_.data();
    for_each_output(stage, at_parts_, [&](ValueKind kind, const void*, const std::byte* parts) {
        if (kind == ValueKind::real) plan_.table->narrow(whole, parts, lane);
        whole += array_bytes;
    });
}

}  // namespace quadrel
