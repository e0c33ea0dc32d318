// Interpolated values as ranges. No specification says how far an implementation's may be off; this
// is a model, whose three numbers are settings (num/range/error_budget.hpp).
//
// The vertices' values are off by `plane` times the largest of them, and their places by `snapping`
// pixels along each axis. These errors belong to the triangle: what they make of a value is the
// same over a quad but for a little, and so hardly shows in differences between lanes. What is left
// is each lane's own, `evaluation` times the largest value. Outside of the triangle the weights
// grow, and the errors with them. Which vertices and edges a lane has are the reference's.
//
// A value at a vertex that is off by e_v moves the value in a lane by w_v e_v, with its
// barycentrics w; a vertex that is moved by d_v, by l_v g d_v, with its barycentrics l in the
// window and the value's gradient g there. Each such coefficient is, over a quad, a mean, a change
// along x, one along y, and a rest: three named errors, the same in all lanes but for their signs,
// and what is a lane's own.
#pragma once

#include "quadrel/num/range/geometry.hpp"
#include "quadrel/quad/interpolate.hpp"

namespace quadrel {

/// Rows that a vertex stage has made, with its errors; others are what it is given.
template <class Row>
inline constexpr bool is_of_vertex_stage =
    std::is_same_v<Row, PrimitiveData> || std::is_same_v<Row, PrimitiveFrame>;

/// A quad's row: its four lanes are of one triangle.
template <>
class PrimitiveReader<Ranges> {
  public:
    template <class Row>
    PrimitiveReader(const StageCall& call, int first_lane, const Row* rows)
        : first_(reinterpret_cast<const float*>(rows + call.primitive[first_lane])),
          plane_(is_of_vertex_stage<Row> ? range_context().budget.plane : 0) {}

    /// What is the same over a triangle, with the errors of the vertex stage; inputs of that stage
    /// have none.
    Ranges at(int offset) const {
        const double value = first_[offset];
        const double off = plane_ * std::fabs(value);
        return off > 0 ? Ranged(range_detail::widened(value, off)) : Ranged(value);
    }
    PerVertex<Ranges> per_vertex(int offset, int stride) const {
        return {at(offset), at(offset + stride), at(offset + 2 * stride)};
    }
    bool uniform() const { return true; }
    PerVertex<float> uniform_vertex(int offset, int stride) const {
        return {first_[offset], first_[offset + stride], first_[offset + 2 * stride]};
    }

  private:
    const float* first_;
    double plane_;
};

template <>
class Interpolator<Ranges> {
  public:
    Interpolator(const StageCall& call, int first_lane) {
        const PrimitiveReader<Ranges> rows(call, first_lane, call.primitives);
        constexpr int w = static_cast<int>(offsetof(PrimitiveData, w) / sizeof(float));
        const PerVertex<float> of = rows.uniform_vertex(w, 1);
        const double others[3] = {double(of.v1) * of.v2, double(of.v2) * of.v0,
                                  double(of.v0) * of.v1};
        for (int lane = 0; lane < 4; ++lane) {
            RealInterval q[3];
            for (int v = 0; v < 3; ++v)
                q[v] = RealInterval(call.edges[v][first_lane + lane]) *
                       range_detail::near(others[v], others[v]);
            const RealInterval sum = q[0] + q[1] + q[2];
            known_[lane] = !sum.has_zero();
            double screen = 0;
            for (int v = 0; v < 3; ++v) {
                part_[lane][v] = q[v].middle();
                screen += call.edges[v][first_lane + lane];
            }
            for (int v = 0; v < 3; ++v)
                screen_[lane][v] = call.edges[v][first_lane + lane] / screen;
            for (int v = 0; v < 3 && known_[lane]; ++v) weight_[lane][v] = q[v] / sum;
        }
    }

    Barycentrics<Ranges> barycentrics() const {
        const auto unit = [&](int v) {
            return varying({v == 0 ? 1.0 : 0.0, v == 1 ? 1.0 : 0.0, v == 2 ? 1.0 : 0.0});
        };
        return {unit(0), unit(1), unit(2)};
    }

    Ranges at(const PrimitiveReader<Ranges>& rows, int offset, int stride) const {
        const PerVertex<float> v = rows.uniform_vertex(offset, stride);
        return varying({v.v0, v.v1, v.v2});
    }
    template <int n>
    vec<n, Ranges> vector(const PrimitiveReader<Ranges>& rows, int offset) const {
        vec<n, Ranges> result;
        for (int i = 0; i < n; ++i) result[i] = at(rows, offset + i, n);
        return result;
    }
    /// Of what a vertex program gives: its error is the vertex', the same in all lanes.
    Ranges operator()(const PerVertex<Ranges>& value) const {
        for (const Ranges& v : {value.v0, value.v1, value.v2})
            if (!v.lane[0].is_bounded()) return Ranges(Ranged::anything());
        return varying(
            {value.v0.lane[0].range(), value.v1.lane[0].range(), value.v2.lane[0].range()});
    }
    template <glm::length_t n>
    glm::vec<n, Ranges, glm::defaultp> operator()(
        const PerVertex<glm::vec<n, Ranges, glm::defaultp>>& value) const {
        glm::vec<n, Ranges, glm::defaultp> result;
        for (glm::length_t i = 0; i < n; ++i)
            result[i] = (*this)(PerVertex<Ranges>{value.v0[i], value.v1[i], value.v2[i]});
        return result;
    }

  private:
    struct Vertices {
        RealInterval v[3];
    };

    /// The value in a lane by exact arithmetic of the vertices' middles.
    RealInterval middle(const Vertices& of, int lane) const {
        return weight_[lane][0] * RealInterval(of.v[0].middle()) +
               weight_[lane][1] * RealInterval(of.v[1].middle()) +
               weight_[lane][2] * RealInterval(of.v[2].middle());
    }
    /// What errors of the triangle make of a value: over the whole quad alike, from its middle to
    /// either side along x and along y, and what is left in a lane.
    struct QuadError {
        double common = 0, along_x = 0, along_y = 0, own = 0;

        /// An error up to +-`off` that lanes have with these coefficients.
        void add(const double (&in_lane)[4], double off) {
            const double a = in_lane[0], b = in_lane[1], c = in_lane[2], d = in_lane[3];
            common += std::fabs(a + b + c + d) / 4 * off;
            along_x += std::fabs(b - a + d - c) / 4 * off;
            along_y += std::fabs(c - a + d - b) / 4 * off;
            own += std::fabs(a - b - c + d) / 4 * off;
        }
    };
    /// `most`: the vertices' errors, `snapping`: of their places. With a quarter more for what is
    /// not linear in the places, and for the vertices that clipping makes far outside of the frame.
    /// A lane that has no value has lane 0's coefficients, or none.
    QuadError quad_error(const Vertices& of, const double (&most)[3], double snapping) const {
        QuadError error;
        double slope[4][2] = {};
        for (int lane = 0; lane < 4 && snapping > 0; ++lane)
            for (int axis = 0; axis < 2 && known_[lane]; ++axis)
                slope[lane][axis] = window_slope(of, lane, axis);
        for (int v = 0; v < 3; ++v) {
            double weight[4] = {}, move[2][4] = {};
            for (int lane = 0; lane < 4; ++lane) {
                const int from = known_[lane] ? lane : 0;
                if (!known_[from]) continue;
                weight[lane] = weight_[from][v].middle();
                for (int axis = 0; axis < 2; ++axis)
                    move[axis][lane] = screen_[from][v] * slope[from][axis];
            }
            error.add(weight, most[v]);
            for (const auto& along : move) error.add(along, 1.25 * snapping);
        }
        return error;
    }
    /// d value / d window along an axis: of the quotient of two functions that are linear there.
    double window_slope(const Vertices& of, int lane, int axis) const {
        double above = 0, below = 0;
        for (int v = 0; v < 3; ++v) {
            const double slope = part_[axis + 1][v] - part_[0][v];
            above += slope * (of.v[v].middle() - middle(of, lane).middle());
            below += part_[lane][v];
        }
        return below != 0 ? above / below : 0;
    }

    Ranges varying(const Vertices& of) const {
        RangeContext& context = range_context();
        const ErrorBudget& errors = context.budget;
        double largest = 0;
        for (const RealInterval& v : of.v) largest = std::max(largest, v.magnitude());
        double most[3];
        for (int v = 0; v < 3; ++v) most[v] = next_up(of.v[v].width() / 2) + errors.plane * largest;
        const QuadError shared = quad_error(of, most, errors.snapping);
        const double parts = shared.common + shared.along_x + shared.along_y;
        const std::int32_t group = ++context.shared_errors;
        Ranges result(Ranged::anything());
        for (int lane = 0; lane < 4; ++lane) {
            if (!known_[lane]) continue;
            Ranged value(middle(of, lane));
            if (!value.is_bounded()) continue;
            double spread = 0, slack = shared.own;
            for (int v = 0; v < 3; ++v) {
                const double weight = std::fabs(weight_[lane][v].middle());
                slack += weight * largest * 0x1p-50 + weight_[lane][v].width() * most[v];
                spread += weight;
            }
            value.part[0] = shared.common;
            value.part[1] = lane % 2 == 0 ? -shared.along_x : shared.along_x;
            value.part[2] = lane < 2 ? -shared.along_y : shared.along_y;
            const RealInterval own =
                range_detail::widened({value.lo, value.hi}, errors.evaluation * largest * spread +
                                                                slack + parts * 0x1p-48);
            value.lo = own.lo;
            value.hi = own.hi;
            value.named = parts > 0 ? group : 0;
            value.mass = std::max(std::fabs(own.lo), std::fabs(own.hi)) + parts * 1.01;
            result.lane[lane] = value;
        }
        return result;
    }

    bool known_[4];
    RealInterval weight_[4][3];
    double part_[4][3];    ///< of these, before they are divided by their sum: linear in the window
    double screen_[4][3];  ///< barycentrics in the window
};

}  // namespace quadrel
