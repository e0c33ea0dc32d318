// What the tests of glTF's geometry share.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "io/gltf/gltf_files.hpp"
#include "quadrel/scene/mesh_file.hpp"
#include "scene/support.hpp"

namespace quadrel {

/// Reads files that a test has made.
class GltfGeometry : public testing::Test {
  protected:
    MeshFile read(const GltfBuilder& gltf, const MeshFileOptions& options = {}) const {
        return read_mesh_file(folder.write("m.glb", gltf.binary()), options);
    }
    Mesh mesh(const GltfBuilder& gltf, int uv_set = 0) const {
        MeshFileOptions options;
        options.uv_set = uv_set;
        return read(gltf, options).mesh;
    }
    TemporaryFolder folder;
};

inline nlohmann::json& primitive_of(GltfBuilder& gltf, std::size_t index = 0) {
    return gltf.json["meshes"][0]["primitives"][index];
}

/// Equal but for rounding.
template <class Vector>
testing::AssertionResult near(const std::vector<Vector>& found, const std::vector<Vector>& expected,
                              double tolerance = 1e-6) {
    if (found.size() != expected.size())
        return testing::AssertionFailure() << found.size() << " elements";
    for (std::size_t i = 0; i < found.size(); ++i)
        for (int c = 0; c < Vector::length(); ++c)
            if (!(std::abs(found[i][c] - expected[i][c]) <= tolerance))
                return testing::AssertionFailure()
                       << "element " << i << "[" << c << "]: " << found[i][c];
    return testing::AssertionSuccess();
}

}  // namespace quadrel
