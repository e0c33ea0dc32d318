#include "render/errors/error_batch.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include "quadrel/num/math.hpp"
#include "render/plan/names.hpp"

namespace quadrel {

/// A value that an image lacks is NaN.
class JudgedValues {
  public:
    JudgedValues(const Batch& batch, int lane) : batch_(&batch), lane_(lane) {}
    JudgedValues(const JudgedImage& image, int x, int y)
        : image_(&image), pixel_(image.film().index(x, y)) {}

    double number(Value v, int component = 0) const {
        const int slot = slot_of(v) + component;
        if (image_ == nullptr) return batch_->number(slot, lane_);
        const Plane* plane = image_->plane(slot);
        return plane ? plane->as_float(pixel_) : std::numeric_limits<double>::quiet_NaN();
    }

    FoundHit hit() const {
        return {status(), number(Value::hit_s), number(Value::hit_uv), number(Value::hit_uv, 1)};
    }

    /// Whether it says where the hit is at all.
    bool has_hit() const {
        return image_ == nullptr || image_->plane(slot_of(Value::hit_s)) != nullptr ||
               image_->plane(slot_of(Value::hit_uv)) != nullptr;
    }

  private:
    Status status() const {
        if (image_ == nullptr)
            return static_cast<Status>(batch_->integer(slot_of(Value::hit_status), lane_));
        const Plane* coverage = image_->coverage();
        if (coverage != nullptr && !(coverage->as_float(pixel_) > 0)) return Status::none;
        const Plane* plane = image_->plane(slot_of(Value::hit_status));
        if (plane == nullptr) return Status::hit;
        if (plane->type == ChannelType::uint32) return static_cast<Status>(plane->bits[pixel_]);
        return static_cast<Status>(to_int(static_cast<double>(plane->as_float(pixel_))));
    }

    const Batch* batch_ = nullptr;
    const JudgedImage* image_ = nullptr;
    int lane_ = 0;
    std::size_t pixel_ = 0;
};

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// In degrees, of vectors of any length; NaN where one has none.
double angle_between(const vec3<double>& a, const vec3<double>& b) {
    constexpr double degrees_a_radian = 57.29577951308232;
    const vec3<double> across = cross(a, b);
    const double along = dot(a, b), apart = std::sqrt(dot(across, across));
    if (along == 0 && apart == 0) return not_a_number;
    return atan2(apart, along) * degrees_a_radian;
}

std::uint32_t float_bits(double x) {
    return canonical_bits(std::bit_cast<std::uint32_t>(static_cast<float>(x)));
}

bool is_integer(ErrorMeasure measure) {
    return measure == ErrorMeasure::cell || measure == ErrorMeasure::kind ||
           measure == ErrorMeasure::certified;
}

/// Where there is no truth.
std::uint32_t bits_unjudged(ErrorMeasure measure) {
    if (measure == ErrorMeasure::kind) return static_cast<std::uint32_t>(ErrorKind::not_judged);
    return is_integer(measure) ? 0 : float_bits(not_a_number);
}

}  // namespace

JudgedImage::JudgedImage(const Film& film) : film_(film), coverage_(film.find("A")) {
    for (const Value v : {Value::hit_s, Value::hit_uv, Value::hit_status, Value::N,
                          Value::shadow_visibility, Value::color})
        for (int c = 0; c < info(v).components; ++c) {
            const std::string name = component_name(v, c);
            const bool first_light = v == Value::shadow_visibility;
            const Plane* plane = film.find(name);
            if (plane == nullptr && first_light) plane = film.find(std::string(info(v).name));
            planes_[static_cast<std::size_t>(slot_of(v) + c)] = plane;
        }
}

ErrorBatch::ErrorBatch(int scalar_bytes, const ProbeCommand* command, const JudgedImage* image,
                       KnownTruths* truths)
    : batches_{Batch(scalar_bytes, command), Batch(scalar_bytes, command),
               Batch(scalar_bytes, command)},
      image_(image),
      truths_(truths) {}

void ErrorBatch::run(const ErrorPlan& plan, const StageCall& call, const QuadCoverage* quads,
                     int count, const Geometry& geometry, int samples, bool centroid) {
    plan_ = &plan;
    call_ = call;
    call_.counters = nullptr;  // look-ups of what is drawn are counted
    call_.log = nullptr;
    for (std::size_t k = 0; k < batches_.size(); ++k) {
        if (!plan.runs[k]) continue;
        if (prepared_[k] != &*plan.runs[k]) batches_[k].prepare(*plan.runs[k]);
        prepared_[k] = &*plan.runs[k];
        batches_[k].load(quads, count, geometry, samples, centroid);
        KnownTruths* const truths =
            k == static_cast<std::size_t>(JudgedRun::truth) && samples == 1 ? truths_ : nullptr;
        if (truths != nullptr && truths->load(quads, count, batches_[k])) continue;
        batches_[k].run(*plan.runs[k], call_, geometry);
        if (truths != nullptr) truths->store(quads, count, batches_[k]);
    }
}

JudgedValues ErrorBatch::judged(ErrorPart part, const Batch& drawn, int lane, int x, int y) const {
    const auto run = judged_run(part);
    if (run) return {batch(*run), lane};
    if (image_ != nullptr) return {*image_, x, y};
    return {drawn, lane};
}

TrueHit ErrorBatch::true_hit(int lane) const {
    const Batch& truth = batch(JudgedRun::truth);
    const auto number = [&](Value v, int component = 0) {
        return truth.number(slot_of(v) + component, lane);
    };
    const ErrorJudge& judge = *plan_->judge;
    TrueHit hit;
    hit.ray = {number(Value::uv), number(Value::uv, 1), number(Value::K), number(Value::K, 1),
               1 - static_cast<double>(call_.material->seat)};
    hit.status = static_cast<Status>(truth.integer(slot_of(Value::hit_status), lane));
    hit.s = number(Value::hit_s);
    hit.u = number(Value::hit_uv);
    hit.v = number(Value::hit_uv, 1);
    if (judge.layers > 0) {
        hit.of_layers(*call_.textures[static_cast<int>(TextureSlot::layers)], judge.layers);
        return hit;
    }
    hit.field = {call_.textures[static_cast<int>(TextureSlot::height)],
                 call_.textures[static_cast<int>(TextureSlot::max_mip)], judge.surface};
    hit.cell_x = number(Value::oracle_cell);
    hit.cell_y = number(Value::oracle_cell, 1);
    hit.place_x = number(Value::oracle_place);
    hit.place_y = number(Value::oracle_place, 1);
    hit.gradient_u = number(Value::oracle_gradient);
    hit.gradient_v = number(Value::oracle_gradient, 1);
    hit.condition = number(Value::oracle_condition);
    hit.bound = number(Value::oracle_bound);
    return hit;
}

std::uint32_t ErrorBatch::bits(const ChannelSource& channel, const Batch& drawn, int lane, int x,
                               int y) const {
    if (!plan_->judge || !true_hit(lane).is_judged()) return bits_unjudged(channel.measure);
    const JudgedValues values = judged(channel.part, drawn, lane, x, y);
    if (is_integer(channel.measure)) return integer(channel.measure, values, lane);
    return float_bits(real(channel, values, lane));
}

std::uint32_t ErrorBatch::integer(ErrorMeasure measure, const JudgedValues& values,
                                  int lane) const {
    if (measure == ErrorMeasure::certified && plan_->judge->layers > 0) return 0;
    if (measure == ErrorMeasure::certified)
        return batch(JudgedRun::truth).integer(slot_of(Value::certified), lane);
    if (measure == ErrorMeasure::cell)
        return values.has_hit() && in_other_cell(true_hit(lane), values.hit());
    const ErrorKind kind =
        values.has_hit() ? judge_hit(true_hit(lane), values.hit()) : ErrorKind::not_judged;
    return static_cast<std::uint32_t>(kind);
}

double ErrorBatch::real(const ChannelSource& channel, const JudgedValues& values, int lane) const {
    switch (channel.measure) {
        case ErrorMeasure::s:
            return difference(Value::hit_s, 0, values, lane);
        case ErrorMeasure::uv:
            return texels_apart(true_hit(lane), values.hit());
        case ErrorMeasure::normal:
            return degrees(values, lane);
        case ErrorMeasure::shadow:
            return plan_->shadows ? difference(Value::shadow_visibility, 0, values, lane) : 0;
        case ErrorMeasure::color:
            return difference(Value::color, channel.component, values, lane);
        case ErrorMeasure::K:
            return frame_error(values, lane);
        case ErrorMeasure::cell:
        case ErrorMeasure::kind:
        case ErrorMeasure::certified:
            break;
    }
    return not_a_number;
}

double ErrorBatch::difference(Value v, int component, const JudgedValues& values, int lane) const {
    return values.number(v, component) -
           batch(JudgedRun::truth).number(slot_of(v) + component, lane);
}

double ErrorBatch::degrees(const JudgedValues& values, int lane) const {
    const JudgedValues truth(batch(JudgedRun::truth), lane);
    const auto normal = [](const JudgedValues& of) {
        return vec3<double>(of.number(Value::N), of.number(Value::N, 1), of.number(Value::N, 2));
    };
    return angle_between(normal(values), normal(truth));
}

double ErrorBatch::frame_error(const JudgedValues& values, int lane) const {
    const JudgedValues truth(batch(JudgedRun::truth), lane);
    const auto shift = [](const JudgedValues& of) {
        return vec2<double>(of.number(Value::K), of.number(Value::K, 1));
    };
    const vec2<double> off = shift(values) - shift(truth);
    const double apart = std::sqrt(dot(off, off)),
                 exact = std::sqrt(dot(shift(truth), shift(truth)));
    return apart == 0 ? 0 : apart / exact;
}

}  // namespace quadrel
