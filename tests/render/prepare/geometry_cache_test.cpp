// Geometry that is kept from frame to frame: never that of another scene.
#include "render/prepare/geometry_cache.hpp"

#include <gtest/gtest.h>

#include "render/prepare/changes.hpp"

namespace quadrel::render_tests {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;

using KeyOf = std::function<std::string(const Scene&, const GeometryParts&)>;

std::string key_of(const Scene& scene, const GeometryParts& parts) {
    return geometry_key(scene, scene_hardware(scene), parts);
}

/// That it changes with the geometry, and with nothing else.
AssertionResult tells_scenes_apart(const KeyOf& key) {
    Scene scene = varied_scene();
    for (const Change& change : scene_changes()) {
        const std::string before = key(scene, {});
        change.apply(scene);
        if ((key(scene, {}) != before) != change.moves) return AssertionFailure() << change.name;
    }
    if (key(scene, {true, false}) == key(scene, {})) return AssertionFailure() << "frames";
    if (key(scene, {false, true}) == key(scene, {})) return AssertionFailure() << "vertices";
    if (key(scene, {false, false, true}) == key(scene, {})) return AssertionFailure() << "quadrics";
    if (key(scene, {false, false, false, true}) == key(scene, {}))
        return AssertionFailure() << "all";
    return AssertionSuccess();
}

TEST(GeometryKey, ChangesWithTheGeometryAlone) { EXPECT_TRUE(tells_scenes_apart(key_of)); }

TEST(GeometryKey, WhatItForgetsIsNoticed) {
    EXPECT_FALSE(tells_scenes_apart([](Scene scene, const GeometryParts& parts) {
        scene.camera = {};
        return key_of(scene, parts);
    }));
    EXPECT_FALSE(tells_scenes_apart([](Scene scene, const GeometryParts& parts) {
        scene.meshes[0].uvs.clear();
        return key_of(scene, parts);
    }));
    EXPECT_FALSE(tells_scenes_apart([](const Scene& scene, const GeometryParts& parts) {
        return key_of(scene, parts) + std::to_string(scene.background.r);
    }));
}

TEST(GeometryKey, TellsZerosOfBothSignsApart) {
    Scene scene = varied_scene();
    scene.meshes[0].positions[0].x = 0.0f;
    const std::string before = key_of(scene, {});
    scene.meshes[0].positions[0].x = -0.0f;
    EXPECT_NE(key_of(scene, {}), before);
}

TEST(GeometryCache, AssemblesOnlyWhatHasChanged) {
    Scene scene = varied_scene();
    GeometryCache cache;
    const auto take = [&] { return cache.take(scene, scene_hardware(scene), {}); };
    cache.give_back(take());
    Geometry again = take();
    EXPECT_EQ(cache.assembled(), 1);
    EXPECT_EQ(again.triangles.size(),
              assemble_geometry(scene, scene_hardware(scene)).triangles.size());
    take();
    EXPECT_EQ(cache.assembled(), 2) << "what was not given back is gone";
    cache.give_back(take());
    scene.width += 2;
    cache.give_back(take());
    EXPECT_EQ(cache.assembled(), 4);
}

}  // namespace
}  // namespace quadrel::render_tests
