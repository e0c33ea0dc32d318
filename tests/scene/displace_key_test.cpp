// The key "displace" of scene files: what it takes, and what it says of what it cannot take.
#include <gtest/gtest.h>

#include <string>

#include "io/mesh/mesh_properties.hpp"
#include "quadrel/scene/load.hpp"
#include "scene/support.hpp"

namespace quadrel {
namespace {

const char* const displaced_by =
    R"("height": {"file": ")" QUADREL_DATA_DIR R"(/textures/obstacles_height.exr"})";

Scene scene_of(const TemporaryFolder& folder, const std::string& shape,
               const std::string& displace) {
    return load_scene(folder.write("s.json", R"({"quadrel": 1, "objects": [{"mesh": {)" + shape +
                                                 R"(, "displace": {)" + displace + "}}}]}"));
}

TEST(Displaced, IsAKeyOfMeshes) {
    const TemporaryFolder folder;
    const auto mesh = [&](const std::string& more) {
        return scene_of(folder, R"("shape": "quad")", displaced_by + more).meshes[0];
    };
    EXPECT_EQ(mesh(R"(, "cells": 8)").triangles.size(), 128u);
    const Mesh whole = mesh(R"(, "cells": 8, "depth": 0.3, "seat": 1)");
    const Mesh outset = mesh(R"(, "cells": 8, "depth": 0.3, "seat": 0, "split": "main")");
    for (std::size_t v = 0; v < whole.positions.size(); ++v)
        EXPECT_NEAR(outset.positions[v].z - whole.positions[v].z, 0.3, 1e-6);
    EXPECT_GT(mesh(R"(, "cells": 4, "texture_matrix": {"scale": [2, 2]})").triangles.size(),
              3 * mesh(R"(, "cells": 4, "split": "min")").triangles.size());
    EXPECT_GT(mesh(R"(, "cells": "texels")").triangles.size(), 2u * 128 * 128);
    const std::string some_cells = displaced_by + std::string(R"(, "cells": 12)");
    // One normal a facet: those of the vertices go.
    const Scene flat =
        scene_of(folder, R"("shape": "sphere", "slices": 6, "normals": "flat")", some_cells);
    EXPECT_TRUE(flat.meshes[0].normals.empty());
    EXPECT_TRUE(is_closed(flat.meshes[0]));
    const Scene refined = scene_of(folder, R"("shape": "cube", "refine": "curvature")", some_cells);
    EXPECT_TRUE(is_closed(refined.meshes[0]));
}

TEST(Displaced, BadInputIsNamed) {
    const TemporaryFolder folder;
    folder.write("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const std::string key = "objects[0].mesh.displace";
    const auto load = [&](const std::string& displace, const std::string& shape) {
        return [&folder, displace, shape] { scene_of(folder, shape, displace); };
    };
    const auto quad = [&](const std::string& displace) {
        return load(displace, R"("shape": "quad")");
    };
    const std::string h = displaced_by;
    EXPECT_TRUE(complains(quad(h + R"(, "cells": 8192)"),
                          {key, " triangles (6", "at most 20000000 triangles (991 MiB"}));
    EXPECT_TRUE(complains(quad(h + R"(, "cells": 0)"), {key + ".cells", "0", "1"}));
    EXPECT_TRUE(
        complains(quad(h + R"(, "cells": "pixels")"), {key + ".cells", "pixels", "texels"}));
    EXPECT_TRUE(complains(quad(h + R"(, "split": "max")"), {key + ".split", "max", "main"}));
    EXPECT_TRUE(complains(quad(h + R"(, "seat": 2)"), {key + ".seat", "2", "1"}));
    EXPECT_TRUE(complains(quad(h + R"(, "depth": -1)"), {key + ".depth", "-1", ""}));
    EXPECT_TRUE(complains(quad(h + R"(, "deep": 1)"), {key + ".deep", "", "depth"}));
    EXPECT_TRUE(complains(quad(R"("depth": 1)"), {key, "no \"height\"", ""}));
    EXPECT_TRUE(complains(quad(R"("height": "none")"), {key + ".height", "none", "texture"}));
    EXPECT_TRUE(
        complains(quad(R"("height": {"noise": {}})"), {key + ".height", "noise", "a texture"}));
    EXPECT_TRUE(complains(quad(h + R"(, "texture_matrix": {"scale": [1e9, 1]})"),
                          {key, "cells", "at most 1073741824"}));
    EXPECT_TRUE(complains(load(h, R"("file": "bare.obj")"),
                          {key, "without texture coordinates", "heights"}));
}

}  // namespace
}  // namespace quadrel
