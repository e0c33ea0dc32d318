// interpolate: the varyings of every lane, perspective-correct, from the edge functions and the
// vertex data of the lane's primitive. Helper lanes extrapolate.
#pragma once

#include "quadrel/quad/stage.hpp"
#include "quadrel/raster/interpolation.hpp"

namespace quadrel {

/// Reads PrimitiveData for one packet: a broadcast when all its quads belong to one primitive, a
/// gather otherwise; the same bits either way.
template <Number F>
class PrimitiveReader {
  public:
    PrimitiveReader(const StageCall& call, int first_lane)
        : first_(call.primitives + call.primitive[first_lane]),
          all_(reinterpret_cast<const float*>(call.primitives)),
          row_(load_int<F>(call.primitive + first_lane) * Int<F>(primitive_floats)) {
        for (int lane = 4; lane < lanes_of<F>; lane += 4) {
            uniform_ &= call.primitive[first_lane + lane] == call.primitive[first_lane];
        }
    }

    /// The float at `offset` of the lane's row.
    F at(int offset) const {
        if (uniform_) return F(reinterpret_cast<const float*>(first_)[offset]);
        return gather<F>(all_, row_ + Int<F>(offset));
    }
    /// Values of the three vertices, `stride` floats apart.
    PerVertex<F> per_vertex(int offset, int stride) const {
        return {at(offset), at(offset + stride), at(offset + 2 * stride)};
    }
    PerVertex<vec2<F>> per_vertex2(int offset) const {
        return {{at(offset), at(offset + 1)},
                {at(offset + 2), at(offset + 3)},
                {at(offset + 4), at(offset + 5)}};
    }
    PerVertex<vec3<F>> per_vertex3(int offset) const {
        return {{at(offset), at(offset + 1), at(offset + 2)},
                {at(offset + 3), at(offset + 4), at(offset + 5)},
                {at(offset + 6), at(offset + 7), at(offset + 8)}};
    }

  private:
    const PrimitiveData* first_;
    const float* all_;
    Int<F> row_;
    bool uniform_ = true;
};

struct Interpolate : StageDefaults {
    static constexpr StageText text{"interpolate", "quad", "perspective-correct varyings",
                                    "Vulkan specification, basic polygon rasterization"};
    static constexpr std::array<Value, 0> inputs{};
    static constexpr auto outputs =
        values(Value::P, Value::vertex_normal, Value::Ng, Value::uv, Value::bary);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        constexpr auto offset_of = [](std::size_t bytes) {
            return static_cast<int>(bytes / sizeof(float));
        };
        const PrimitiveReader<F> data(io.call(), io.first_lane());
        const PerVertex<F> edges{edge<F>(io, 0), edge<F>(io, 1), edge<F>(io, 2)};
        const auto b = perspective_barycentrics(
            edges, data.per_vertex(offset_of(offsetof(PrimitiveData, w)), 1));
        const auto vector = [&](std::size_t bytes) {
            return interpolate(b, data.per_vertex3(offset_of(bytes)));
        };
        constexpr int ng = offset_of(offsetof(PrimitiveData, face_normal));

        io.template store<Value::P>(vector(offsetof(PrimitiveData, position)));
        if (io.template wanted<Value::vertex_normal>()) {
            io.template store<Value::vertex_normal>(vector(offsetof(PrimitiveData, normal)));
        }
        if (io.template wanted<Value::uv>()) {
            io.template store<Value::uv>(
                interpolate(b, data.per_vertex2(offset_of(offsetof(PrimitiveData, uv)))));
        }
        io.template store<Value::Ng>(vec3<F>(data.at(ng), data.at(ng + 1), data.at(ng + 2)));
        io.template store<Value::bary>(vec3<F>(b.v0, b.v1, b.v2));
    }

  private:
    template <class F, class Io>
    static F edge(Io& io, int i) {
        return load<F>(static_cast<const Scalar<F>*>(io.call().edges[i]) + io.first_lane());
    }
};

}  // namespace quadrel
