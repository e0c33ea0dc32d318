// A batch of doubles whose real values vary along two axes, for stages on dual numbers: the same
// batch on duals, and moved a step along an axis in double.
#pragma once

#include "quadrel/num/dual.hpp"
#include "relief/stage_inputs.hpp"

namespace quadrel::test {

class DualBatch {
  public:
    /// `from` must outlive this object. Values vary by some hundredths of their size a unit.
    DualBatch(Batch<double>& from, Random& random)
        : from_(from), slopes_(static_cast<std::size_t>(from.lanes / 4)) {
        for (auto& slot : values_) slot.resize(static_cast<std::size_t>(from.lanes));
        for (int v = 0; v < static_cast<int>(Value::count); ++v)
            fill(static_cast<Value>(v), random);
        for (int q = 0; q < from.lanes / 4; ++q)
            for (int i = 0; i < 3; ++i) {
                const double size = 0.02 * edge_size(q);
                slopes_[std::size_t(q)].dx[i] = size * random.uniform(-1, 1);
                slopes_[std::size_t(q)].dy[i] = size * random.uniform(-1, 1);
            }
    }

    /// Runs a stage on duals.
    void run(StageFunction function, const void* params) {
        std::array<void*, slot_count> arrays;
        for (std::size_t slot = 0; slot < arrays.size(); ++slot)
            arrays[slot] = values_[slot].data();
        StageCall call{};
        call.values = arrays.data();
        call.active = from_.active.data();
        call.lanes = from_.lanes;
        call.parameters = params;
        call.material = &from_.material;
        call.frame = &from_.frame;
        for (int slot = 0; slot < texture_slot_count; ++slot)
            call.textures[slot] = from_.bound(static_cast<TextureSlot>(slot));
        for (std::size_t i = 0; i < 3; ++i) call.edges[i] = from_.edges[i].data();
        call.primitive = from_.primitive.data();
        call.primitives = from_.primitives.data();
        call.frames = from_.frames.data();
        call.vertices = from_.vertices.data();
        call.edge_slopes = slopes_.data();
        function(&call);
    }

    /// The doubles a step `t` along axis 0 or 1.
    Batch<double> moved(int axis, double t) {
        Batch<double> to = from_;
        to.own_depth = true;
        for (int v = 0; v < static_cast<int>(Value::count); ++v) {
            const auto value = static_cast<Value>(v);
            if (info(value).kind == ValueKind::integer) continue;
            const int n = info(value).components;
            for (int lane = 0; lane < to.lanes; ++lane)
                for (int i = 0; i < arrays_of(value); ++i)
                    to.real(value, lane, i % n, i / n) += t * along(real(value, lane, i), axis);
        }
        for (std::size_t i = 0; i < 3; ++i)
            for (int lane = 0; lane < to.lanes; ++lane) {
                const EdgeSlopes& slopes = slopes_[std::size_t(lane / 4)];
                to.edges[i][std::size_t(lane)] += t * (axis == 0 ? slopes.dx[i] : slopes.dy[i]);
            }
        return to;
    }

    Dual& real(Value v, int lane, int component = 0) {
        return values_[static_cast<std::size_t>(slot_of(v) + component)][std::size_t(lane)];
    }
    std::int32_t integer(Value v, int lane) { return integers(slot_of(v))[lane]; }
    static double along(const Dual& x, int axis) { return axis == 0 ? x.dx : x.dy; }

    /// Changes every lane's rates and edge slopes: (along x, along y) in place.
    template <class Change>
    void change_axes(const Change& change) {
        for (int v = 0; v < static_cast<int>(Value::count); ++v)
            for (int i = 0; i < arrays_of(static_cast<Value>(v)); ++i)
                if (info(static_cast<Value>(v)).kind == ValueKind::real)
                    for (Dual& x :
                         values_[static_cast<std::size_t>(slot_of(static_cast<Value>(v)) + i)])
                        change(x.dx, x.dy);
        for (EdgeSlopes& slopes : slopes_)
            for (int i = 0; i < 3; ++i) change(slopes.dx[i], slopes.dy[i]);
    }
    std::vector<EdgeSlopes>& slopes() { return slopes_; }

  private:
    std::int32_t* integers(int slot) {
        return reinterpret_cast<std::int32_t*>(values_[static_cast<std::size_t>(slot)].data());
    }
    double edge_size(int quad) const {
        double sum = 0;
        for (const auto& edge : from_.edges) sum += std::abs(edge[std::size_t(4 * quad)]);
        return sum;
    }
    void fill(Value v, Random& random) {
        for (int i = 0; i < arrays_of(v); ++i)
            for (int lane = 0; lane < from_.lanes; ++lane) {
                if (info(v).kind == ValueKind::integer) {
                    integers(slot_of(v) + i)[lane] = from_.integer(v, lane, i);
                    continue;
                }
                const int n = info(v).components;
                const double x = from_.real(v, lane, i % n, i / n);
                const double size = 0.03 * (0.01 + std::abs(x));
                values_[static_cast<std::size_t>(slot_of(v) + i)][std::size_t(lane)] = {
                    x, size * random.uniform(-1, 1), size * random.uniform(-1, 1)};
            }
    }

    Batch<double>& from_;
    std::array<std::vector<Dual>, slot_count> values_;
    std::vector<EdgeSlopes> slopes_;
};

}  // namespace quadrel::test
