// How the exported functions get at a fragment's values.
#pragma once

#include "export/exported.hpp"
#include "quadrel/num/vec.hpp"

namespace quadrel::export_tests {

inline float component(const FragmentArrays& arrays, int slot) {
    return static_cast<const float*>(arrays.inputs[slot])[arrays.lane];
}
inline int load_int(const FragmentArrays& arrays, int slot) {
    return static_cast<const std::int32_t*>(arrays.inputs[slot])[arrays.lane];
}
template <int n>
auto load(const FragmentArrays& arrays, int slot) {
    if constexpr (n == 1) {
        return component(arrays, slot);
    } else {
        vec<n, float> result;
        for (int i = 0; i < n; ++i) result[i] = component(arrays, slot + i);
        return result;
    }
}
/// Of floats one after the other.
template <int n>
auto vector_at(const float* from) {
    if constexpr (n == 1) {
        return *from;
    } else {
        vec<n, float> result;
        for (int i = 0; i < n; ++i) result[i] = from[i];
        return result;
    }
}
inline void put(float* to, float value) { *to = value; }
template <int n>
void put(float* to, const vec<n, float>& value) {
    for (int i = 0; i < n; ++i) to[i] = value[i];
}
/// Of quads that follow each other in the window.
inline vec2<float> frag_coord(const FragmentArrays& arrays) {
    const int column = arrays.lane % 2, row = arrays.lane / 2 % 2, quad = arrays.lane / 4;
    return {static_cast<float>(2 * quad + column) + 0.5f, static_cast<float>(row) + 0.5f};
}
inline void store(const FragmentArrays& arrays, int slot, int value) {
    static_cast<std::int32_t*>(arrays.outputs[slot])[arrays.lane] = value;
}
inline void store(const FragmentArrays& arrays, int slot, float value) {
    static_cast<float*>(arrays.outputs[slot])[arrays.lane] = value;
}
template <int n>
void store(const FragmentArrays& arrays, int slot, const vec<n, float>& value) {
    for (int i = 0; i < n; ++i) store(arrays, slot + i, value[i]);
}

}  // namespace quadrel::export_tests
