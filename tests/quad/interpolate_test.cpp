// The stages interpolate and differentiate, run by themselves: perspective and helper lanes against
// exact fractions; broadcast and gather of primitives against each other.
#include "quadrel/quad/interpolate.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "built_isas.hpp"
#include "kernels/select.hpp"
#include "quad/planted.hpp"
#include "quad/stage_bench.hpp"
#include "quadrel/quad/differentiate.hpp"

namespace quadrel::quad_tests {
namespace {

/// The triangle (0,0) (8,0) (0,8) in pixels, y down, with w 1, 4, 1 and u 0, 1, 0.
PrimitiveData perspective_triangle() {
    PrimitiveData data{};
    data.w[0] = 1, data.w[1] = 4, data.w[2] = 1;
    data.uv[1][0] = 1;
    for (int v = 0; v < 3; ++v) data.normal[v][2] = 1;
    data.position[1][0] = 8;
    data.position[2][1] = 8;
    data.face_normal[2] = 1;
    return data;
}

/// Edge functions of that triangle at the centres of the quad's pixels, in 1/256 pixel squared.
template <class T>
void set_quad(StageBench<T>& bench, int quad, int x, int y) {
    for (int lane = 0; lane < 4; ++lane) {
        const std::size_t i = static_cast<std::size_t>(4 * quad + lane);
        const double px = x + (lane & 1) + 0.5, py = y + (lane >> 1) + 0.5;
        bench.edges[0][i] = static_cast<T>(65536 * (64 - 8 * px - 8 * py));
        bench.edges[1][i] = static_cast<T>(65536 * 8 * px);
        bench.edges[2][i] = static_cast<T>(65536 * 8 * py);
    }
}

constexpr std::array outputs = {Value::P,    Value::vertex_normal, Value::Ng,
                                Value::uv,   Value::bary,          Value::dPdx,
                                Value::dPdy, Value::dUVdx,         Value::dUVdy};

/// `interpolate` is what is tested; then differentiate.
template <class T>
void run(StageBench<T>& bench, StageFunction interpolate, const PrimitiveData* primitives) {
    bench.call().primitives = primitives;
    for (const Value v : outputs) bench.want(v);
    interpolate(&bench.call());
    run_stage<Differentiate, Quad<T>>(&bench.call());
}

template <class T>
testing::AssertionResult near(const char* what, T found, double numerator, double denominator) {
    const double expected = numerator / denominator;
    const double tolerance = 8 * static_cast<double>(std::numeric_limits<T>::epsilon());
    if (std::abs(static_cast<double>(found) - expected) <= tolerance)
        return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << fmt::format("{} is {}, expected {}/{}", what, found, numerator, denominator);
}

/// u(x, y) of pixels (2,0) (3,0) (2,1) (3,1), dFdx between them, and (7,1), which is outside.
template <class T>
testing::AssertionResult interpolates(StageFunction stage) {
    const PrimitiveData data = perspective_triangle();
    StageBench<T> bench;
    set_quad(bench, 0, 2, 0);
    for (int quad = 1; quad < 4; ++quad) set_quad(bench, quad, 6, 0);
    run(bench, stage, &data);
    const auto u = [&](int lane) { return bench.at(Value::uv, 0, lane); };
    for (const auto& result :
         {near("u(2,0)", u(0), 5, 49), near("u(3,0)", u(1), 7, 43), near("u(2,1)", u(2), 5, 49),
          near("u(3,1)", u(3), 7, 43), near("dFdx", bench.at(Value::dUVdx, 0, 0), 128, 2107),
          near("dFdx", bench.at(Value::dUVdx, 0, 3), 128, 2107),
          near("dFdy", bench.at(Value::dUVdy, 0, 1), 0, 1), near("u(7,1)", u(7), 15, 19),
          near("b0(7,1)", bench.at(Value::bary, 0, 7), -8, 19),
          near("b1(7,1)", bench.at(Value::bary, 1, 7), 15, 19),
          near("b2(7,1)", bench.at(Value::bary, 2, 7), 12, 19),
          near("P.X(7,1)/8", bench.at(Value::P, 0, 7) / T(8), 15, 19),
          near("Ng.Z", bench.at(Value::Ng, 2, 7), 1, 1),
          near("normal.Z", bench.at(Value::vertex_normal, 2, 7), 1, 1)})
        if (!result) return result;
    return testing::AssertionSuccess();
}

/// The same call with other edges or primitives.
template <class T, class Change>
void run_changed(const StageCall* call, const Change& change) {
    StageCall changed = *call;
    std::array<std::array<double, 16>, 3> edges;
    std::vector<PrimitiveData> data(call->primitives, call->primitives + 1);
    for (std::size_t i = 0; i < 3; ++i) {
        std::memcpy(edges[i].data(), call->edges[i], sizeof edges[i]);
        changed.edges[i] = edges[i].data();
    }
    change(edges, data[0]);
    changed.primitives = data.data();
    run_stage<Interpolate, Quad<T>>(&changed);
}

template <class T>
void linear_interpolation(const StageCall* call) {
    run_changed<T>(call, [](auto&, PrimitiveData& data) { data.w[1] = 1; });
}

template <class T>
void clamped_helpers(const StageCall* call) {
    run_changed<T>(call, [](auto& edges, PrimitiveData&) {
        for (auto& edge : edges)
            for (double& e : edge) e = std::max(e, 0.0);
    });
}

TEST(Interpolate, IsPerspectiveCorrectAndExtrapolates) {
    EXPECT_TRUE(interpolates<float>(&run_stage<Interpolate, Quad<float>>));
    EXPECT_TRUE(interpolates<double>(&run_stage<Interpolate, Quad<double>>));
    EXPECT_FALSE(interpolates<float>(&linear_interpolation<float>));
    EXPECT_FALSE(interpolates<double>(&linear_interpolation<double>));
    EXPECT_FALSE(interpolates<float>(&clamped_helpers<float>));
    EXPECT_FALSE(interpolates<double>(&clamped_helpers<double>));
}

StageFunction kernel(const KernelTable& table, const std::string& id) {
    return find_kernel(table, id);
}

/// Three rows of PrimitiveData that differ in every float.
std::vector<PrimitiveData> three_primitives() {
    std::vector<PrimitiveData> data(3, perspective_triangle());
    for (std::size_t p = 0; p < data.size(); ++p) {
        auto* floats = reinterpret_cast<float*>(&data[p]);
        for (int i = 0; i < primitive_floats; ++i)
            floats[i] += 0.37f * static_cast<float>(p + 1) + 0.01f * static_cast<float>(i);
    }
    return data;
}

/// Four quads of the given primitives, on `stage` and on plain floats: the same bits.
testing::AssertionResult same_bits(StageFunction stage, const std::array<int, 4>& primitive) {
    const auto data = three_primitives();
    StageBench<float> truth, tested;
    for (StageBench<float>* bench : {&truth, &tested})
        for (int lane = 0; lane < 16; ++lane) {
            bench->primitive[std::size_t(lane)] = primitive[std::size_t(lane / 4)];
            if (lane % 4 == 0) set_quad(*bench, lane / 4, lane / 2, 2);
        }
    run(truth, &run_stage<Interpolate, Quad<float>>, data.data());
    run(tested, stage, data.data());
    for (const Value v : outputs)
        for (int c = 0; c < info(v).components; ++c)
            for (int lane = 0; lane < 16; ++lane)
                if (std::memcmp(&truth.at(v, c, lane), &tested.at(v, c, lane), 4) != 0)
                    return testing::AssertionFailure()
                           << info(v).name << "[" << c << "], lane " << lane << ": "
                           << tested.at(v, c, lane) << ", expected " << truth.at(v, c, lane);
    return testing::AssertionSuccess();
}

/// Broadcast where the quads of a packet are of one primitive, gather where they are not.
testing::AssertionResult reads_primitives(StageFunction stage) {
    for (const auto& primitive :
         {std::array{0, 0, 0, 0}, std::array{2, 2, 2, 2}, std::array{0, 1, 2, 0},
          std::array{1, 1, 1, 0}, std::array{2, 2, 0, 0}, std::array{0, 2, 2, 2}})
        if (auto same = same_bits(stage, primitive); !same) return same;
    return testing::AssertionSuccess();
}

/// Eight lanes take the primitive of their first.
void first_primitive(const StageCall* call) {
    StageCall changed = *call;
    std::array<std::int32_t, 16> primitive;
    for (std::size_t i = 0; i < 16; ++i) primitive[i] = call->primitive[i / 8 * 8];
    changed.primitive = primitive.data();
    run_stage<Interpolate, Quad<float>>(&changed);
}

TEST(Interpolate, BroadcastAndGatherGiveTheSameBits) {
    for (const std::string& isa : built_isas()) {
        EXPECT_TRUE(reads_primitives(kernel(select_kernels("float", isa), "interpolate"))) << isa;
    }
    EXPECT_FALSE(reads_primitives(&first_primitive));
}

/// What nobody asked for is not stored, and leaves the rest as it is.
TEST(Interpolate, StoresOnlyWhatIsWanted) {
    const PrimitiveData data = perspective_triangle();
    StageBench<float> all, one;
    set_quad(all, 0, 2, 0);
    set_quad(one, 0, 2, 0);
    run(all, &run_stage<Interpolate, Quad<float>>, &data);
    one.call().primitives = &data;
    one.want(Value::bary);
    run_stage<Interpolate, Quad<float>>(&one.call());
    for (int lane = 0; lane < 4; ++lane)
        EXPECT_EQ(one.at(Value::bary, 1, lane), all.at(Value::bary, 1, lane));
}

template <class T>
testing::AssertionResult differentiates(DerivativeMode mode, double dx_odd_row, double dy_odd) {
    StageBench<T> bench;
    bench.frame.derivatives = mode;
    for (const Value v : outputs) bench.want(v);
    for (int lane = 0; lane < 16; ++lane) {
        const double values[] = {1, 5, 12, -8};
        bench.at(Value::P, 1, lane) = static_cast<T>(values[lane % 4] * (1 + lane / 4));
        bench.at(Value::uv, 0, lane) = static_cast<T>(values[lane % 4]);
    }
    run_stage<Differentiate, Quad<T>>(&bench.call());
    for (int quad = 0; quad < 4; ++quad) {
        const int lane = 4 * quad + 3;
        if (bench.at(Value::dPdx, 1, lane) != T(dx_odd_row * (1 + quad)) ||
            bench.at(Value::dPdy, 1, lane) != T(dy_odd * (1 + quad)) ||
            bench.at(Value::dUVdx, 0, lane) != T(dx_odd_row) ||
            bench.at(Value::dUVdy, 0, lane) != T(dy_odd) || bench.at(Value::dPdx, 0, lane) != 0)
            return testing::AssertionFailure() << "in quad " << quad;
    }
    return testing::AssertionSuccess();
}

TEST(Differentiate, FollowsTheMode) {
    EXPECT_TRUE(differentiates<float>(DerivativeMode::fine, -20, -13));
    EXPECT_TRUE(differentiates<double>(DerivativeMode::fine, -20, -13));
    EXPECT_TRUE(differentiates<float>(DerivativeMode::coarse, 4, 11));
    EXPECT_TRUE(differentiates<double>(DerivativeMode::coarse, 4, 11));
    EXPECT_FALSE(differentiates<float>(DerivativeMode::coarse, -20, -13));
}

}  // namespace
}  // namespace quadrel::quad_tests
