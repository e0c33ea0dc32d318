#include "quadrel/scene/camera.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "quadrel/num/functions.hpp"
#include "quadrel/scene/transform.hpp"
#include "scene/planted.hpp"

namespace quadrel {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr Conventions all_conventions[] = {Conventions::gl, Conventions::vulkan, Conventions::d3d};

glm::dvec3 project(const glm::mat4& matrix, const glm::dvec3& p) {
    const glm::dvec4 clip = glm::dmat4(matrix) * glm::dvec4(p, 1);
    return glm::dvec3(clip) / clip.w;
}

bool near_to(double a, double b) { return std::abs(a - b) < 1e-6; }

/// Near and far planes reach the ends of the conventions' depth range, nearer is before farther,
/// and the picture's upper edge is at the conventions' end of y.
testing::AssertionResult projects(const glm::mat4& matrix, const DepthAndShift& lens,
                                  Conventions conventions, const glm::dvec2& upper_right_at_near) {
    const double start = conventions == Conventions::gl ? -1 : 0;
    const glm::dvec3 corner = project(matrix, {upper_right_at_near, -lens.near});
    const double far = std::isinf(lens.far) ? 1e15 : lens.far;
    const double depth_far = project(matrix, {0, 0, -far}).z;
    if (!near_to(corner.z, lens.reversed_z ? 1 : start))
        return testing::AssertionFailure() << "the near plane at depth " << corner.z;
    if (!near_to(depth_far, lens.reversed_z ? start : 1))
        return testing::AssertionFailure() << "the far plane at depth " << depth_far;
    const double y = conventions == Conventions::vulkan ? -1 : 1;
    if (!near_to(corner.x, 1 + lens.shift.x) || !near_to(corner.y, y * (1 + lens.shift.y)))
        return testing::AssertionFailure() << "the corner at " << corner.x << ", " << corner.y;
    return testing::AssertionSuccess();
}

std::vector<DepthAndShift> lenses() {
    return {{},
            {.near = 1, .far = 8},
            {.near = 0.5, .far = 20, .reversed_z = true},
            {.near = 1, .far = 8, .shift = {0.25, -0.5}}};
}

// tan(26.565 degrees) = 1/2: the upper edge is at half the distance.
constexpr double fov_of_half = 53.13010235415598;

TEST(Camera, PerspectiveFollowsTheConventions) {
    for (const Conventions conventions : all_conventions) {
        auto all = lenses();
        all.push_back({.near = 0.5, .far = infinite});
        all.push_back({.near = 0.5, .far = infinite, .reversed_z = true});
        for (const DepthAndShift& lens : all) {
            const glm::mat4 matrix = perspective_matrix(fov_of_half, 2, lens, conventions);
            const glm::dvec2 corner(lens.near, lens.near / 2);
            EXPECT_TRUE(projects(matrix, lens, conventions, corner))
                << int(conventions) << " " << lens.near << " " << lens.far;
        }
    }
}

TEST(Camera, OrthographicFollowsTheConventions) {
    for (const Conventions conventions : all_conventions)
        for (const DepthAndShift& lens : lenses())
            EXPECT_TRUE(projects(orthographic_matrix(4, 1.5, lens, conventions), lens, conventions,
                                 {3, 2}));
}

TEST(Camera, PlantedDefectsAreCaught) {
    const DepthAndShift lens{.near = 1, .far = 8};
    DepthAndShift swapped = lens;
    swapped.reversed_z = true;  // Defect::swapped_depth_ends
    const glm::dvec2 corner(1, 0.5);
    const auto matrix = [](const DepthAndShift& of, Conventions conventions) {
        return perspective_matrix(fov_of_half, 2, of, conventions);
    };
    EXPECT_TRUE(projects(matrix(lens, Conventions::d3d), lens, Conventions::d3d, corner));
    EXPECT_FALSE(projects(matrix(swapped, Conventions::d3d), lens, Conventions::d3d, corner));
    // Defect::wrong_depth_range and Defect::clip_y_up
    EXPECT_FALSE(projects(matrix(lens, Conventions::gl), lens, Conventions::d3d, corner));
    EXPECT_FALSE(projects(matrix(lens, Conventions::d3d), lens, Conventions::vulkan, corner));
    // Defect::transposed_matrix
    EXPECT_FALSE(
        projects(glm::transpose(matrix(lens, Conventions::gl)), lens, Conventions::gl, corner));
}

TEST(Camera, ViewPutsTheTargetAheadAndUpUpwards) {
    const glm::dvec3 eye(1, -2, 3), target(-4, 0.5, 2), up(0.2, 1, -0.3);
    const glm::dmat4 view(view_matrix(eye, target, up));
    const glm::dvec3 at_eye(view * glm::dvec4(eye, 1)), ahead(view * glm::dvec4(target, 1));
    EXPECT_LT(length(at_eye), 1e-6);
    EXPECT_NEAR(ahead.x, 0, 1e-6);
    EXPECT_NEAR(ahead.y, 0, 1e-6);
    EXPECT_NEAR(ahead.z, -length(target - eye), 1e-6);
    const glm::dvec3 above(view * glm::dvec4(up, 0));
    EXPECT_NEAR(above.x, 0, 1e-6);
    EXPECT_GT(above.y, 0);
    EXPECT_NEAR(glm::determinant(glm::dmat3(view)), 1, 1e-6);
}

TEST(Camera, LookingDownTheAxisIsExact) {
    glm::mat4 expected(1.0f);
    expected[3][2] = -3;
    EXPECT_EQ(view_matrix({0, 0, 3}, {0, 0, 0}, {0, 1, 0}), expected);
    const glm::mat4 right_angle = perspective_matrix(90, 1, {}, Conventions::gl);
    EXPECT_EQ(right_angle[1][1], 1.0f);
}

/// A rotation by a multiple of 90 degrees about an axis, in exact bits.
template <class Rotate>
testing::AssertionResult quarter_turns_are_exact(const Rotate& rotate) {
    for (int quarter = -9; quarter <= 9; ++quarter) {
        const double sines[4] = {0, 1, 0, -1};
        const double s = sines[quarter & 3], c = sines[(quarter + 1) & 3];
        const glm::dvec4 turned =
            rotate(90.0 * quarter, glm::dvec3(0, 0, 2)) * glm::dvec4(1, 0, 5, 1);
        if (turned != glm::dvec4(c, s, 5, 1))
            return testing::AssertionFailure() << 90 * quarter << " degrees: " << turned.x << " "
                                               << turned.y << " " << turned.z;
    }
    return testing::AssertionSuccess();
}

glm::dmat4 libm_rotation(double degrees, const glm::dvec3&) {
    glm::dmat4 matrix(1.0);
    const double angle = degrees * 3.14159265358979323846 / 180;
    matrix[0][0] = std::cos(angle);
    matrix[0][1] = std::sin(angle);
    return matrix;
}

TEST(Transform, QuarterTurnsAreExact) {
    EXPECT_TRUE(quarter_turns_are_exact(rotation));
    EXPECT_FALSE(quarter_turns_are_exact(libm_rotation));
    EXPECT_FALSE(quarter_turns_are_exact([](double degrees, const glm::dvec3& axis) {
        return rotation(-degrees, axis);  // Defect::clockwise_rotation
    }));
}

TEST(Transform, RotationsKeepLengthsAndTheirAxis) {
    const glm::dvec3 axis(1, -2, 0.5);
    for (double degrees : {-170.0, -30.0, 0.1, 45.0, 123.4, 359.0, 1e6}) {
        const glm::dmat3 turn(rotation(degrees, axis));
        EXPECT_NEAR(glm::determinant(turn), 1, 1e-14);
        EXPECT_LT(length(turn * axis - axis), 1e-14);
        EXPECT_LT(length((glm::transpose(turn) * turn)[0] - glm::dvec3(1, 0, 0)), 1e-14);
    }
    const glm::dmat4 twice = rotation(20, axis) * rotation(25, axis), once = rotation(45, axis);
    for (int column = 0; column < 4; ++column)
        EXPECT_LT(length(twice[column] - once[column]), 1e-14);
}

}  // namespace
}  // namespace quadrel
