// Numbers out of a glTF file's buffers, every index and length checked.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

// The same switches wherever tinygltf is included.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <tiny_gltf.h>

namespace quadrel {

/// A parsed file and its name.
struct GltfFile {
    std::string name;
    nlohmann::json json;  ///< as it stands in the file, but for the bytes of buffers within it
    tinygltf::Model model;
    /// Accessors whose "min" or "max" their elements contradict, as far as they have been read.
    mutable std::set<int> wrong_bounds;

    /// Throws InputError at `key` (as "accessors[3].count").
    [[noreturn]] void fail(const std::string& key, const std::string& found,
                           const std::string& expected) const;
};

/// What vertex attributes may be stored as (glTF 2.0, 3.7.2.1, and KHR_mesh_quantization).
enum class GltfStored {
    positions,   ///< floats, or integers of 8 or 16 bits
    directions,  ///< floats, or signed integers, normalised
    weights,     ///< floats, or unsigned integers, normalised
    joints,      ///< unsigned integers
    matrices,    ///< floats
};

/// Elements of some components each.
struct GltfNumbers {
    std::size_t components = 1;
    std::vector<float> values;

    std::size_t size() const { return values.size() / components; }
    const float* operator[](std::size_t element) const { return &values[element * components]; }
};

/// How many elements an accessor has. Throws InputError if there is no such accessor, or if the
/// number is absurd.
std::size_t accessor_count(const GltfFile& file, int accessor);

/// Finite numbers, aligned as the specification says (3.6.2.4), normalised integers decoded as the
/// specification says, sparse elements replaced. `interleaved`: they may have a stride, as vertex
/// attributes do and nothing else.
GltfNumbers read_numbers(const GltfFile& file, int accessor, std::size_t components,
                         GltfStored stored, bool interleaved = true);

/// Vertex indices: unsigned bytes, shorts or ints, none of them their type's largest value.
std::vector<std::uint32_t> read_indices(const GltfFile& file, int accessor);

/// 4x4 matrices of floats.
std::vector<glm::dmat4> read_matrices(const GltfFile& file, int accessor);

}  // namespace quadrel
