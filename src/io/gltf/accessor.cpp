#include "io/gltf/accessor.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <type_traits>

#include "quadrel/error.hpp"
#include "text/not_finite.hpp"

namespace quadrel {
namespace {

/// Elements in a buffer: all of them lie within it.
struct Elements {
    const unsigned char* first = nullptr;
    std::size_t count = 0, stride = 0;
};

std::string place(const char* list, int index) {
    return std::string(list) + "[" + std::to_string(index) + "]";
}

const tinygltf::BufferView& checked_view(const GltfFile& file, int view, const std::string& key) {
    const auto& views = file.model.bufferViews;
    if (view < 0 || static_cast<std::size_t>(view) >= views.size())
        file.fail(key, "buffer view " + std::to_string(view),
                  "one of the " + std::to_string(views.size()));
    const tinygltf::BufferView& found = views[static_cast<std::size_t>(view)];
    const auto buffers = file.model.buffers.size();
    if (found.buffer < 0 || static_cast<std::size_t>(found.buffer) >= buffers)
        file.fail(place("bufferViews", view), "buffer " + std::to_string(found.buffer),
                  "one of the " + std::to_string(buffers));
    return found;
}

std::string multiple_of(std::size_t n) { return "a multiple of " + std::to_string(n); }

/// glTF 2.0, 3.6.2.4: offsets, within the view and within the buffer, are multiples of a
/// component's size. (Strides are multiples of 4 by the schema.)
void check_alignment(const GltfFile& file, const tinygltf::BufferView& view, std::size_t offset,
                     std::size_t component, const std::string& key) {
    if (offset % component != 0)
        file.fail(key + ".byteOffset", std::to_string(offset), multiple_of(component));
    const std::size_t in_buffer = view.byteOffset + offset;
    if (in_buffer % component != 0)
        file.fail(key, "elements from byte " + std::to_string(in_buffer) + " of the buffer",
                  multiple_of(component));
}

/// The same section: each element of a vertex attribute begins at a multiple of 4 in its view.
void check_attribute_alignment(const GltfFile& file, const tinygltf::Accessor& accessor,
                               std::size_t element_size, const std::string& key) {
    constexpr std::size_t step = 4;
    if (accessor.byteOffset % step != 0)
        file.fail(key + ".byteOffset", std::to_string(accessor.byteOffset), multiple_of(step));
    const tinygltf::BufferView& view = checked_view(file, accessor.bufferView, key);
    if (view.byteStride == 0 && element_size % step != 0)
        file.fail(key, std::to_string(element_size) + " bytes per element without a stride",
                  multiple_of(step));
}

/// Only vertex attributes may be `interleaved` with others.
Elements elements_of(const GltfFile& file, int view_index, std::size_t offset, std::size_t count,
                     std::size_t component, std::size_t element_size, bool interleaved,
                     const std::string& key) {
    const tinygltf::BufferView& view = checked_view(file, view_index, key);
    check_alignment(file, view, offset, component, key);
    if (!interleaved && view.byteStride != 0)
        file.fail(place("bufferViews", view_index) + ".byteStride",
                  std::to_string(view.byteStride) + " for other than vertex attributes", "none");
    const auto& data = file.model.buffers[static_cast<std::size_t>(view.buffer)].data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
        file.fail(place("bufferViews", view_index), "an end past the buffer's",
                  "at most " + std::to_string(data.size()) + " bytes");
    const std::size_t stride = view.byteStride ? view.byteStride : element_size;
    const bool fits = count > 0 && stride >= element_size && offset <= view.byteLength &&
                      element_size <= view.byteLength - offset &&
                      count - 1 <= (view.byteLength - offset - element_size) / stride;
    if (!fits)
        file.fail(key, std::to_string(count) + " elements",
                  "at least one, and all within the buffer view of " +
                      std::to_string(view.byteLength) + " bytes");
    return {data.data() + view.byteOffset + offset, count, stride};
}

template <class T>
T load(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

// glTF 2.0, "Animations"/"Accessors": f = c / max for unsigned, max(c / max, -1) for signed.
template <class T>
float load_number(const unsigned char* bytes, bool normalized) {
    const auto value = static_cast<float>(load<T>(bytes));
    if (!normalized) return value;
    return std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
}

float load_component(const unsigned char* bytes, int type, bool normalized) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return load_number<std::int8_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return load_number<std::uint8_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return load_number<std::int16_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load_number<std::uint16_t>(bytes, normalized);
        default:
            return load<float>(bytes);
    }
}

std::uint32_t load_index(const unsigned char* bytes, int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return load<std::uint8_t>(bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load<std::uint16_t>(bytes);
        default:
            return load<std::uint32_t>(bytes);
    }
}

bool is_index_type(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

bool is_number_type(int type) {
    return type >= TINYGLTF_COMPONENT_TYPE_BYTE && type <= TINYGLTF_COMPONENT_TYPE_FLOAT &&
           type != TINYGLTF_COMPONENT_TYPE_INT && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

bool allowed(int type, bool normalized, GltfStored stored) {
    const bool is_float = type == TINYGLTF_COMPONENT_TYPE_FLOAT;
    const bool is_signed =
        type == TINYGLTF_COMPONENT_TYPE_BYTE || type == TINYGLTF_COMPONENT_TYPE_SHORT;
    switch (stored) {
        case GltfStored::positions:
            return true;
        case GltfStored::directions:
            return is_float || (is_signed && normalized);
        case GltfStored::weights:
            return is_float || (!is_signed && normalized);
        case GltfStored::joints:
            return !is_float && !is_signed && !normalized;
        default:
            return is_float;
    }
}

std::size_t component_size(int type) {
    return static_cast<std::size_t>(
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type)));
}

const tinygltf::Accessor& checked_accessor(const GltfFile& file, int index) {
    const auto& accessors = file.model.accessors;
    if (index < 0 || static_cast<std::size_t>(index) >= accessors.size())
        file.fail("accessors", "a reference to accessor " + std::to_string(index),
                  "one of the " + std::to_string(accessors.size()));
    const tinygltf::Accessor& accessor = accessors[static_cast<std::size_t>(index)];
    // Without a buffer view all are 0, however many the file claims.
    const bool stored = accessor.bufferView >= 0;
    const std::size_t most = stored ? std::size_t(1) << 28 : std::size_t(1) << 20;
    if (accessor.count == 0 || accessor.count > most)
        file.fail(place("accessors", index) + ".count", std::to_string(accessor.count),
                  stored ? "1 to 2^28 elements" : "1 to 2^20 elements without a buffer view");
    return accessor;
}

/// The value of a bound as elements are read: as float32, normalised. Infinity beyond float32.
float as_element(double bound, const tinygltf::Accessor& accessor) {
    using Limits = std::numeric_limits<float>;
    const bool fits = std::abs(bound) <= static_cast<double>(Limits::max());
    const float value = fits ? static_cast<float>(bound) : Limits::infinity();
    if (!accessor.normalized) return value;
    switch (accessor.componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return std::max(value / 127.0f, -1.0f);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return value / 255.0f;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return std::max(value / 32767.0f, -1.0f);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return value / 65535.0f;
        default:
            return value;
    }
}

/// Notes an accessor whose bounds are not the least and the greatest of its elements (3.6.2.5).
/// Nobody needs them here, and so nothing is refused.
template <class Number>
void note_wrong_bounds(const GltfFile& file, int index, const std::vector<Number>& values,
                       std::size_t components) {
    const tinygltf::Accessor& accessor = file.model.accessors[static_cast<std::size_t>(index)];
    if (accessor.bufferView < 0 && !accessor.sparse.isSparse) return;
    const auto agrees = [&](const std::vector<double>& bounds, const auto& further) {
        if (bounds.empty()) return true;
        if (bounds.size() != components) return false;
        for (std::size_t c = 0; c < components; ++c) {
            Number found = values[c];
            for (std::size_t i = c; i < values.size(); i += components)
                if (further(values[i], found)) found = values[i];
            const auto stated = static_cast<double>(as_element(bounds[c], accessor));
            const bool whole = std::is_integral_v<Number>;
            if (static_cast<double>(found) != (whole ? bounds[c] : stated)) return false;
        }
        return true;
    };
    if (!agrees(accessor.minValues, std::less<Number>()) ||
        !agrees(accessor.maxValues, std::greater<Number>()))
        file.wrong_bounds.insert(index);
}

void load_element(const unsigned char* bytes, const tinygltf::Accessor& accessor,
                  std::size_t components, float* out) {
    const std::size_t size = component_size(accessor.componentType);
    for (std::size_t i = 0; i < components; ++i)
        out[i] = load_component(bytes + i * size, accessor.componentType, accessor.normalized);
}

/// Calls replace(index, bytes) for the elements that a sparse accessor lists.
template <class Replace>
void for_sparse(const GltfFile& file, const tinygltf::Accessor& accessor, std::size_t element_size,
                bool interleaved, const std::string& key, const Replace& replace) {
    const auto& sparse = accessor.sparse;
    const auto count = static_cast<std::size_t>(std::max(sparse.count, 0));
    const int type = sparse.indices.componentType;
    if (!is_index_type(type)) file.fail(key + ".sparse", "another index type", "unsigned integers");
    const std::size_t index_size = component_size(type);
    const Elements indices = elements_of(file, sparse.indices.bufferView,
                                         static_cast<std::size_t>(sparse.indices.byteOffset), count,
                                         index_size, index_size, false, key + ".sparse.indices");
    const Elements values = elements_of(
        file, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), count,
        component_size(accessor.componentType), element_size, interleaved, key + ".sparse.values");
    std::int64_t last = -1;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t at = load_index(indices.first + i * indices.stride, type);
        if (at >= accessor.count)
            file.fail(key + ".sparse", "index " + std::to_string(at),
                      "below " + std::to_string(accessor.count));
        if (at <= last)
            file.fail(key + ".sparse",
                      "index " + std::to_string(at) + " after " + std::to_string(last),
                      "increasing ones");
        last = at;
        replace(at, values.first + i * values.stride);
    }
}

// Graphics interfaces take it for the end of a primitive.
void check_index(const GltfFile& file, std::uint32_t index, int type, const std::string& key) {
    const std::uint32_t largest = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE    ? 0xff
                                  : type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? 0xffff
                                                                                   : 0xffffffff;
    if (index == largest)
        file.fail(key, "index " + std::to_string(index) + ", its type's largest",
                  "smaller ones: it restarts primitives");
}

}  // namespace

void GltfFile::fail(const std::string& key, const std::string& found,
                    const std::string& expected) const {
    throw InputError(name, key, found, expected);
}

std::size_t accessor_count(const GltfFile& file, int index) {
    return checked_accessor(file, index).count;
}

GltfNumbers read_numbers(const GltfFile& file, int index, std::size_t components, GltfStored stored,
                         bool interleaved) {
    const tinygltf::Accessor& accessor = checked_accessor(file, index);
    const std::string key = place("accessors", index);
    const int in_type = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    if (!is_number_type(accessor.componentType) || in_type != static_cast<int>(components))
        file.fail(key, "elements of another type",
                  std::to_string(components) + " floats (or 8- or 16-bit integers) each");
    if (!allowed(accessor.componentType, accessor.normalized, stored))
        file.fail(key + ".componentType",
                  std::to_string(accessor.componentType) +
                      (accessor.normalized ? ", normalised" : ", not normalised"),
                  "a type that this attribute may have");
    const std::size_t size = component_size(accessor.componentType) * components;
    GltfNumbers out{components, std::vector<float>(accessor.count * components)};
    if (accessor.bufferView >= 0) {
        if (interleaved) check_attribute_alignment(file, accessor, size, key);
        const Elements elements =
            elements_of(file, accessor.bufferView, accessor.byteOffset, accessor.count,
                        size / components, size, interleaved, key);
        for (std::size_t i = 0; i < elements.count; ++i)
            load_element(elements.first + i * elements.stride, accessor, components,
                         &out.values[i * components]);
    }
    if (accessor.sparse.isSparse)
        for_sparse(file, accessor, size, interleaved, key,
                   [&](std::size_t at, const unsigned char* bytes) {
                       load_element(bytes, accessor, components, &out.values[at * components]);
                   });
    for (std::size_t i = 0; i < out.values.size(); ++i)
        if (!std::isfinite(out.values[i]))
            file.fail(key,
                      not_finite_name(static_cast<double>(out.values[i])) + " in element " +
                          std::to_string(i / components),
                      "finite numbers");
    note_wrong_bounds(file, index, out.values, components);
    return out;
}

std::vector<std::uint32_t> read_indices(const GltfFile& file, int index) {
    const tinygltf::Accessor& accessor = checked_accessor(file, index);
    const std::string key = place("accessors", index);
    const int type = accessor.componentType;
    if (!is_index_type(type) || accessor.type != TINYGLTF_TYPE_SCALAR)
        file.fail(key, "elements of another type", "unsigned integers");
    std::vector<std::uint32_t> out(accessor.count);
    if (accessor.bufferView >= 0) {
        const std::size_t size = component_size(type);
        const Elements elements = elements_of(file, accessor.bufferView, accessor.byteOffset,
                                              accessor.count, size, size, false, key);
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = load_index(elements.first + i * elements.stride, type);
    }
    if (accessor.sparse.isSparse)
        for_sparse(
            file, accessor, component_size(type), false, key,
            [&](std::size_t at, const unsigned char* bytes) { out[at] = load_index(bytes, type); });
    for (const std::uint32_t value : out) check_index(file, value, type, key);
    note_wrong_bounds(file, index, out, 1);
    return out;
}

std::vector<glm::dmat4> read_matrices(const GltfFile& file, int index) {
    const GltfNumbers numbers = read_numbers(file, index, 16, GltfStored::matrices, false);
    std::vector<glm::dmat4> out(numbers.size());
    for (std::size_t i = 0; i < out.size(); ++i)
        for (int k = 0; k < 16; ++k) out[i][k / 4][k % 4] = static_cast<double>(numbers[i][k]);
    return out;
}

}  // namespace quadrel
