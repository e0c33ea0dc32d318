// Billboards: whatever the camera and the transform, the card faces the eye, goes through the
// object's origin, covers its sphere and no more than that needs, and has the UV that it says.
#include "scene/billboard.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "quadrel/error.hpp"
#include "quadrel/scene/camera.hpp"
#include "quadrel/scene/shapes.hpp"
#include "quadrel/scene/transform.hpp"
#include "random.hpp"

namespace quadrel::test {
namespace {

using Draw = std::function<Mesh(const Scene&, const Object&)>;

Mesh drawn(const Scene& scene, const Object& object) {
    Mesh card;
    return drawn_mesh(scene, object, card);
}

constexpr double board_size = 1.5, board_radius = 1.25;

Scene board_scene(const glm::dmat4& transform, bool parallel) {
    Scene scene;
    scene.file = "boards.json";
    scene.camera.view = view_matrix({0.5, 1, 7}, {0, 0.2, 0}, {0.2, 1, 0});
    scene.camera.projection =
        parallel ? orthographic_matrix(8, 1.5, {.near = 1, .far = 50}, Conventions::gl)
                 : perspective_matrix(60, 1.5, {}, Conventions::gl);
    scene.meshes.push_back(make_billboard(board_size, board_radius));
    Object object;
    object.transform = glm::mat4(transform);
    scene.objects.push_back(object);
    return scene;
}

/// Corners of the card and points of its sphere, in eye space, as the eye sees them: over the depth
/// in perspective.
testing::AssertionResult faces_and_covers(const Scene& scene, bool parallel, const Draw& draw) {
    const Object& object = scene.objects[0];
    const Mesh card = draw(scene, object);
    const glm::dmat4 to_eye(scene.camera.view * object.transform);
    const auto eye_of = [&](const glm::dvec3& p) { return glm::dvec3(to_eye * glm::dvec4(p, 1)); };
    const glm::dvec3 origin = eye_of(glm::dvec3(0));
    const glm::dvec3 towards = parallel ? glm::dvec3(0, 0, 1) : normalize(-origin);
    std::vector<glm::dvec3> corners;
    for (const glm::vec3& p : card.positions) corners.push_back(eye_of(glm::dvec3(p)));
    const double scale = length(corners[1] - corners[0]);
    for (std::size_t i = 0; i < 4; ++i) {
        if (!(std::abs(dot(corners[i] - origin, towards)) < 1e-5 * scale))
            return testing::AssertionFailure() << "does not face the eye";
        const glm::dvec2 uv = (glm::dvec2(card.uvs[i]) - 0.5) * board_size;
        const double reach = length(glm::dvec3(card.positions[i]));
        if (!(std::abs(length(uv) - reach) < 1e-5 * reach))
            return testing::AssertionFailure() << "uv of another size";
    }
    if (!(dot(corners[1] - corners[0], corners[3] - corners[0]) < 1e-5 * scale * scale))
        return testing::AssertionFailure() << "not square";
    // The sphere in the card's plane, from the eye: within the square, and up to its sides.
    Random random(5);
    const glm::dvec3 right = normalize(corners[1] - corners[0]),
                     up = normalize(corners[3] - corners[0]);
    double most = 0;
    for (int n = 0; n < 20000; ++n) {
        const glm::dvec3 v(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        if (length(v) > 1 || length(v) < 0.1) continue;
        const glm::dvec3 p = eye_of(normalize(v) * board_radius);
        // Along the ray to the plane of the card.
        const glm::dvec3 way = parallel ? towards : p;
        const glm::dvec3 seen = p + way * (dot(origin - p, towards) / dot(way, towards));
        most =
            std::max({most, std::abs(dot(seen - origin, right)), std::abs(dot(seen - origin, up))});
    }
    const double half = scale / 2;
    if (!(most <= half * (1 + 1e-5))) return testing::AssertionFailure() << "does not cover it";
    if (!(most >= half * 0.97)) return testing::AssertionFailure() << "larger than need be";
    return testing::AssertionSuccess();
}

std::vector<glm::dmat4> transforms() {
    return {glm::dmat4(1),
            translation({1, 2, -3}) * rotation(70, {1, 2, 3}) * scaling(glm::dvec3(0.7)),
            translation({-4, 0, 2}) * scaling(glm::dvec3(-1.2, 1.2, 1.2)),
            translation({0.3, -2, 3}) * rotation(180, {0, 1, 0})};
}

TEST(Billboard, FacesTheEyeAndCoversItsSphere) {
    for (const bool parallel : {false, true})
        for (const glm::dmat4& transform : transforms())
            EXPECT_TRUE(faces_and_covers(board_scene(transform, parallel), parallel, drawn));
    const Scene scene = board_scene(transforms()[1], false);
    EXPECT_FALSE(faces_and_covers(scene, false, [](const Scene& s, const Object& object) {
        return s.meshes[object.mesh];
    })) << "as it stands in the scene";
    EXPECT_FALSE(faces_and_covers(scene, false, [](const Scene& s, const Object& object) {
        Mesh card = drawn(s, object);
        for (glm::vec3& p : card.positions) p *= 0.95f;
        for (glm::vec2& uv : card.uvs) uv = (uv - 0.5f) * 0.95f + 0.5f;
        return card;
    })) << "as large as the sphere is from far away";
    EXPECT_FALSE(faces_and_covers(scene, false, [](const Scene& s, const Object& object) {
        Scene moved = s;
        moved.camera.view = glm::mat4(translation({0.5, 0, 0})) * moved.camera.view;
        return drawn(moved, object);
    })) << "for another camera";
}

TEST(Billboard, OtherMeshesAreTheirOwn) {
    Scene scene = board_scene(glm::dmat4(1), false);
    scene.meshes[0] = make_quad(2, 3, 2);
    Mesh card;
    EXPECT_EQ(&drawn_mesh(scene, scene.objects[0], card), &scene.meshes[0]);
}

TEST(Billboard, WhatNoCardCanShowIsRefused) {
    const auto refused = [](const glm::dmat4& transform) {
        const Scene scene = board_scene(transform, false);
        try {
            drawn(scene, scene.objects[0]);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_NE(refused(scaling({1, 1, 1.1})).find("stretches or shears"), std::string::npos);
    EXPECT_NE(refused(translation({0.5, 1, 6.5})).find("from the eye"), std::string::npos);
    EXPECT_EQ(refused(translation({0.5, 1, 5.5})), "");
}

}  // namespace
}  // namespace quadrel::test
