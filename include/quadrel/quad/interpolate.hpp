// interpolate: the varyings of every lane, perspective-correct, from the edge functions and the
// vertex data of the lane's primitive. Helper lanes extrapolate.
#pragma once

#include "quadrel/quad/stage.hpp"
#include "quadrel/raster/interpolation.hpp"

namespace quadrel {

/// What `interpolate` takes from PrimitiveFrame.
inline constexpr auto frame_values =
    values(Value::vertex_tangent, Value::tangent_sign, Value::vertex_bitangent, Value::quadric,
           Value::face_J, Value::object_x, Value::object_y, Value::object_z);

/// Reads PrimitiveData or PrimitiveFrame for one packet: a broadcast when all its quads belong to
/// one primitive, a gather otherwise; the same bits either way.
template <Number F>
class PrimitiveReader {
  public:
    /// `rows`: an array of structs of floats that call.primitive indexes.
    template <class Row>
    PrimitiveReader(const StageCall& call, int first_lane, const Row* rows)
        : first_(reinterpret_cast<const float*>(rows + call.primitive[first_lane])),
          all_(reinterpret_cast<const float*>(rows)),
          row_(load_int<F>(call.primitive + first_lane) *
               Int<F>(static_cast<std::int32_t>(sizeof(Row) / sizeof(float)))) {
        for (int lane = 4; lane < lanes_of<F>; lane += 4) {
            uniform_ &= call.primitive[first_lane + lane] == call.primitive[first_lane];
        }
    }

    /// The float at `offset` of the lane's row.
    F at(int offset) const {
        if (uniform_) return F(first_[offset]);
        return gather<F>(all_, row_ + Int<F>(offset));
    }
    /// Values of the three vertices, `stride` floats apart.
    PerVertex<F> per_vertex(int offset, int stride) const {
        return {at(offset), at(offset + stride), at(offset + 2 * stride)};
    }
    /// The same as plain numbers, where every lane has the same row.
    bool uniform() const { return uniform_; }
    PerVertex<float> uniform_vertex(int offset, int stride) const {
        return {first_[offset], first_[offset + stride], first_[offset + 2 * stride]};
    }

  private:
    const float* first_;
    const float* all_;
    Int<F> row_;
    bool uniform_ = true;
};

/// The value of a varying in each lane of a packet, from its values at the vertices: exactly
/// (raster/interpolation.hpp) or as the frame's hardware does it (raster/planes.hpp).
template <Number F>
class Interpolator {
  public:
    Interpolator(const StageCall& call, int first_lane)
        : call_(call), first_lane_(first_lane), b_(barycentrics_here()) {}

    const Barycentrics<F>& barycentrics() const { return b_; }

    /// Of the floats at `offset` of the rows, `stride` apart from vertex to vertex.
    F at(const PrimitiveReader<F>& rows, int offset, int stride) const {
        if (call_.planes == nullptr && rows.uniform())
            return interpolate_of_one(b_, rows.uniform_vertex(offset, stride));
        return lane_by_lane(rows, offset, stride);
    }
    template <int n>
    vec<n, F> vector(const PrimitiveReader<F>& rows, int offset) const {
        vec<n, F> result;
        for (int i = 0; i < n; ++i) result[i] = at(rows, offset + i, n);
        return result;
    }

    F operator()(const PerVertex<F>& value) const {
        return call_.planes == nullptr ? interpolate(b_, value) : by_planes(value);
    }
    template <glm::length_t n>
    glm::vec<n, F, glm::defaultp> operator()(
        const PerVertex<glm::vec<n, F, glm::defaultp>>& value) const {
        glm::vec<n, F, glm::defaultp> result;
        for (glm::length_t i = 0; i < n; ++i)
            result[i] = (*this)(PerVertex<F>{value.v0[i], value.v1[i], value.v2[i]});
        return result;
    }

  private:
    Barycentrics<F> barycentrics_here() const {
        const PrimitiveReader<F> rows(call_, first_lane_, call_.primitives);
        constexpr int w = static_cast<int>(offsetof(PrimitiveData, w) / sizeof(float));
        const EdgeValues<F> edges{edge(0), edge(1), edge(2)};
        return rows.uniform() ? perspective_barycentrics_of_one<F>(edges, rows.uniform_vertex(w, 1))
                              : perspective_barycentrics<F>(edges, rows.per_vertex(w, 1));
    }
    Wide<F> edge(int i) const {
        const Wide<F> value = load_wide<F>(call_.edges[i] + first_lane_);
        if constexpr (Differentiated<F>) {
            const EdgeSlopes& slopes = call_.edge_slopes[first_lane_ / 4];
            return with_derivatives(value, slopes.dx[i], slopes.dy[i]);
        } else {
            return value;
        }
    }
    /// The evaluation point in pixels; along each axis it changes by itself.
    vec2<F> window() const {
        const vec2<F> at(load<F>(call_.window[0] + first_lane_),
                         load<F>(call_.window[1] + first_lane_));
        if constexpr (Differentiated<F>)
            return {with_derivatives(at.x, 1, 0), with_derivatives(at.y, 0, 1)};
        else
            return at;
    }
    /// Not inline: one packet in many has lanes of two triangles.
    [[gnu::noinline]] F lane_by_lane(const PrimitiveReader<F>& rows, int offset, int stride) const {
        return (*this)(rows.per_vertex(offset, stride));
    }
    /// Not inline: it would be many times as long as the exact way beside it.
    [[gnu::noinline]] F by_planes(const PerVertex<F>& value) const {
        const PrimitiveReader<F> row(call_, first_lane_, call_.planes);
        const auto at = [&](int offset) { return row.at(offset); };
        const vec2<F> p = window();
        if (call_.frame->interpolation == Interpolation::llvmpipe)
            return llvmpipe_value(value, p.x, p.y, at);
        const F zero(0), one(1);
        return swiftshader_value(value, p.x, p.y, select(lane_is_right<F>(), one, zero),
                                 select(lane_is_below<F>(), one, zero), at);
    }

    const StageCall& call_;
    int first_lane_;
    Barycentrics<F> b_;
};

/// Of the packet that a stage sees.
template <class Io>
Interpolator<typename Io::Number> interpolator(const Io& io) {
    return {io.call(), io.first_lane()};
}

struct Interpolate : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"interpolate", "quad", "perspective-correct varyings",
                                    "Vulkan specification, basic polygon rasterization"};
    static constexpr std::array<Value, 0> inputs{};
    static constexpr auto outputs =
        values(Value::P, Value::vertex_normal, Value::Ng, Value::uv, Value::bary,
               Value::vertex_tangent, Value::tangent_sign, Value::vertex_bitangent, Value::quadric,
               Value::face_J, Value::object_x, Value::object_y, Value::object_z);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        constexpr auto offset_of = [](std::size_t bytes) {
            return static_cast<int>(bytes / sizeof(float));
        };
        const PrimitiveReader<F> data(io.call(), io.first_lane(), io.call().primitives);
        const Interpolator<F> interpolated = interpolator(io);
        const auto vector = [&](std::size_t bytes) {
            return interpolated.template vector<3>(data, offset_of(bytes));
        };
        constexpr int ng = offset_of(offsetof(PrimitiveData, face_normal));

        io.template store<Value::P>(vector(offsetof(PrimitiveData, position)));
        if (io.template wanted<Value::vertex_normal>()) {
            io.template store<Value::vertex_normal>(vector(offsetof(PrimitiveData, normal)));
        }
        if (io.template wanted<Value::uv>()) {
            io.template store<Value::uv>(
                interpolated.template vector<2>(data, offset_of(offsetof(PrimitiveData, uv))));
        }
        io.template store<Value::Ng>(vec3<F>(data.at(ng), data.at(ng + 1), data.at(ng + 2)));
        const Barycentrics<F>& b = interpolated.barycentrics();
        io.template store<Value::bary>(
            vec3<F>(from_wide<F>(b.b0), from_wide<F>(b.b1), from_wide<F>(b.b2)));
        if (io.call().frames != nullptr) store_frame(io, interpolated);
    }

  private:
    /// Tangents, and what is the same over a whole triangle.
    template <class Io, class F>
    static void store_frame(Io& io, const Interpolator<F>& interpolated) {
        const PrimitiveReader<F> row(io.call(), io.first_lane(), io.call().frames);
        const auto at = [](std::size_t bytes) { return static_cast<int>(bytes / sizeof(float)); };
        const auto constant = [&](int offset) {
            return vec3<F>(row.at(offset), row.at(offset + 1), row.at(offset + 2));
        };
        constexpr std::size_t J = offsetof(PrimitiveFrame, J);
        constexpr std::size_t axes = offsetof(PrimitiveFrame, object_axes);
        io.template store<Value::vertex_tangent>(
            interpolated.template vector<3>(row, at(offsetof(PrimitiveFrame, tangent))));
        io.template store<Value::tangent_sign>(
            interpolated.at(row, at(offsetof(PrimitiveFrame, tangent_sign)), 1));
        io.template store<Value::vertex_bitangent>(
            interpolated.template vector<3>(row, at(offsetof(PrimitiveFrame, bitangent))));
        io.template store<Value::quadric>(
            interpolated.template vector<2>(row, at(offsetof(PrimitiveFrame, quadric))));
        io.template store<Value::face_J>(
            std::array<vec3<F>, 2>{constant(at(J)), constant(at(J) + 3)});
        io.template store<Value::object_x>(constant(at(axes)));
        io.template store<Value::object_y>(constant(at(axes) + 3));
        io.template store<Value::object_z>(constant(at(axes) + 6));
    }
};

}  // namespace quadrel
