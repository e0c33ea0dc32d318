// Every function and operator: the same bits from Quad<float> and every instruction-set module,
// from a quad and a plain number, and from every build (committed hashes).
#include "num/same_bits.hpp"

#include "num/expected_hashes.hpp"
#include "num/module_loader.hpp"
#include "num/planted.hpp"

namespace quadrel::num_tests {
namespace {

template <class T>
const Inputs<T>& inputs() {
    static const Inputs<T> in = make_inputs<T>();
    return in;
}

class Module : public testing::TestWithParam<std::string> {};

template <class Rows>
void expect_same_rows(const Rows& truth, const OperationTable& tested) {
    ASSERT_EQ(truth.size(), tested.size);
    for (std::size_t i = 0; i < tested.size; ++i) {
        EXPECT_TRUE(same_bits(truth[i], tested.rows[i], inputs<float>()));
    }
}

TEST_P(Module, GivesTheBitsOfQuads) {
    if (!cpu_has(GetParam())) GTEST_SKIP() << "this CPU lacks " << GetParam();
    const TableFunction table = load_module(GetParam());
    expect_same_rows(common_rows<Quad<float>>, table(0));
    expect_same_rows(packet_rows<Quad<float>>, table(1));
}
TEST_P(Module, IsAsWideAsItsRegisters) {
    if (!cpu_has(GetParam())) GTEST_SKIP() << "this CPU lacks " << GetParam();
    const int width = GetParam() == "avx512" ? 16 : GetParam() == "avx2" ? 8 : 4;
    EXPECT_EQ(load_module(GetParam())(0).lanes, width);
}
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Module);
INSTANTIATE_TEST_SUITE_P(Every, Module, testing::ValuesIn(built_isas()),
                         [](const auto& tested) { return tested.param; });

TEST(SameBits, PlainFloatIsALaneOfAQuad) {
    for (std::size_t i = 0; i < common_rows<float>.size(); ++i) {
        EXPECT_TRUE(same_bits(common_rows<Quad<float>>[i], common_rows<float>[i], inputs<float>()));
    }
}
TEST(SameBits, PlainDoubleIsALaneOfAQuad) {
    for (std::size_t i = 0; i < common_rows<double>.size(); ++i) {
        EXPECT_TRUE(
            same_bits(common_rows<Quad<double>>[i], common_rows<double>[i], inputs<double>()));
    }
}

// ---- Committed hashes ---------------------------------------------------------------------------

const ExpectedHash* find_hash(const std::string& name) {
    for (const ExpectedHash& expected : expected_hashes) {
        if (name == expected.name) return &expected;
    }
    return nullptr;
}

testing::AssertionResult has_committed_hashes(const Operation<float>& of_float,
                                              const Operation<double>& of_double) {
    const ExpectedHash* expected = find_hash(of_float.name);
    const std::uint64_t f = hash_of(of_float, inputs<float>());
    const std::uint64_t d = hash_of(of_double, inputs<double>());
    if (expected != nullptr && f == expected->of_float && d == expected->of_double) {
        return testing::AssertionSuccess();
    }
    return testing::AssertionFailure()
           << fmt::format("{{\"{}\", {:#018x}, {:#018x}}},", of_float.name, f, d);
}

TEST(CommittedHashes, HoldInThisBuild) {
    for (std::size_t i = 0; i < common_rows<float>.size(); ++i) {
        EXPECT_TRUE(
            has_committed_hashes(common_rows<Quad<float>>[i], common_rows<Quad<double>>[i]));
    }
    for (std::size_t i = 0; i < packet_rows<Quad<float>>.size(); ++i) {
        EXPECT_TRUE(
            has_committed_hashes(packet_rows<Quad<float>>[i], packet_rows<Quad<double>>[i]));
    }
}

// ---- Planted errors -----------------------------------------------------------------------------

using F = Quad<float>;

F fused(F x, F y, F z) {
    return map_lanes<F>([](float a, float b, float c) { return std::fma(a, b, c); }, x, y, z);
}
template <class Op>
testing::AssertionResult passes(const char* name, Op op) {
    for (const auto& truth : common_rows<F>) {
        if (std::string(truth.name) == name)
            return same_bits(truth, row<F>(name, op), inputs<float>());
    }
    for (const auto& truth : packet_rows<F>) {
        if (std::string(truth.name) == name)
            return same_bits(truth, row<F>(name, op), inputs<float>());
    }
    return testing::AssertionSuccess() << "no such row";
}

testing::AssertionResult passes_same_bits(Planted error) {
    switch (error) {
        case Planted::fused_multiply_add:
            return passes("dot2", [](F a, F b, F c) { return fused(b, a, a * c); });
        case Planted::dot_right_to_left:
            return passes("dot3", [](F a, F b, F c) { return a * b + (b * c + c * a); });
        case Planted::reciprocal_division:
            return passes("a/b", [](F a, F b, F) { return a * (F(1) / b); });
        case Planted::denormals_flushed:
            return passes("a*b", [](F a, F b, F) {
                const F product = a * b;
                return select(abs(product) < F(0x1p-126f), F(0), product);
            });
        case Planted::min_as_minps:
            return passes("min", [](F a, F b, F) { return select(a < b, a, b); });
        case Planted::to_int_as_cvttps:
            return passes("to_int", [](F a, F, F) {
                const QuadInt indefinite(-0x7fffffff - 1);
                return select(abs(a) < F(2147483648.0f), to_int(a), indefinite);
            });
        case Planted::round_half_away:
            return passes("round_even",
                          [](F a, F, F) { return copysign(floor(abs(a) + F(0.5f)), a); });
        case Planted::arithmetic_shift_lost:
            return passes("int shift_right", [](F a, F, F) {
                return map_lanes<QuadInt>(
                    [](std::int32_t i) {
                        return static_cast<std::int32_t>(static_cast<std::uint32_t>(i) >> 7);
                    },
                    as_int(a));
            });
        case Planted::lane_shift_lost:
            return passes("int shift_right by lanes", [](F a, F b, F) {
                return shift_right(as_int(a), QuadInt(as_int(b).lane[0] & 31));
            });
        case Planted::table_of_eight:
            return passes("look_up16",
                          [](F a, F, F) { return looked_up(as_float(as_int(a) & QuadInt(7))); });
        case Planted::columns_swapped:
            return passes("dFdx_fine", [](F a, F, F) { return -dFdx_fine(a); });
        case Planted::changed_constant: {
            const auto changed = [](auto x, auto, auto) { return x * decltype(x)(0x1.1df46cp-6f); };
            return has_committed_hashes(row<F>("radians", changed),
                                        row<Quad<double>>("radians", changed));
        }
        default:
            return testing::AssertionSuccess() << "not planted here";
    }
}

TEST(SameBits, CatchesPlantedErrors) {
    for (const Planted error :
         {Planted::fused_multiply_add, Planted::dot_right_to_left, Planted::reciprocal_division,
          Planted::denormals_flushed, Planted::min_as_minps, Planted::to_int_as_cvttps,
          Planted::round_half_away, Planted::arithmetic_shift_lost, Planted::lane_shift_lost,
          Planted::table_of_eight, Planted::columns_swapped, Planted::changed_constant}) {
        EXPECT_FALSE(passes_same_bits(error)) << "planted error " << static_cast<int>(error);
    }
}

}  // namespace
}  // namespace quadrel::num_tests
