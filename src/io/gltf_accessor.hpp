// Numbers out of a glTF file's buffers, every index and length checked.
#pragma once

#include <array>
#include <cstdint>
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
    tinygltf::Model model;

    /// Throws InputError at `key` (as "accessors[3].count").
    [[noreturn]] void fail(const std::string& key, const std::string& found,
                           const std::string& expected) const;
};

/// How many elements an accessor has. Throws InputError if there is no such accessor, or if the
/// number is absurd.
std::size_t accessor_count(const GltfFile& file, int accessor);

/// An attribute of `components` finite floats a vertex (normalised integers decoded as the
/// specification says), components in the first places of each element.
std::vector<std::array<float, 4>> read_attribute(const GltfFile& file, int accessor,
                                                 int components);

/// Vertex indices: unsigned bytes, shorts or ints.
std::vector<std::uint32_t> read_indices(const GltfFile& file, int accessor);

}  // namespace quadrel
