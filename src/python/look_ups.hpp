// Look-ups and derivatives over arrays of lanes, quad by quad, on plain numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "quadrel/num/derivative.hpp"
#include "quadrel/texture/view.hpp"

namespace quadrel::python {

/// How a look-up gets its level of detail, or what it is instead.
enum class LookUp { implicit, level, gradients, gather, fetch };

/// Arrays of `lanes` elements, a multiple of four: of quads, where derivatives are taken. What a
/// kind of look-up has no use for may be null.
template <class T>
struct LookUpArguments {
    std::size_t lanes = 0;
    const T *u = nullptr, *v = nullptr;
    const T* bias = nullptr;                                                     ///< implicit
    const T* level = nullptr;                                                    ///< level
    const T *dudx = nullptr, *dvdx = nullptr, *dudy = nullptr, *dvdy = nullptr;  ///< gradients
    const std::int32_t *x = nullptr, *y = nullptr, *z = nullptr;  ///< fetch: texel and level
    DerivativeMode mode = DerivativeMode::fine;
    int component = 0;  ///< gather
};

/// Four values per lane, r g b a (of gather: the texels) one after the other.
template <class T>
void look_up(const SampledTexture& texture, LookUp kind, const LookUpArguments<T>& arguments,
             T* values);

/// Five values per lane: rho, lambda, level, frac, 1 where it is magnified. Implicit, level,
/// gradients.
template <class T>
void levels_of_detail(const SampledTexture& texture, LookUp kind,
                      const LookUpArguments<T>& arguments, T* records);

inline constexpr std::size_t most_taps = 8;

/// For each lane most_taps places, of which those behind `count` stay as they are.
struct TapArrays {
    std::int32_t *count, *level, *x, *y;
    bool* border;
    double* weight;
    float* value;  ///< four a tap
};

/// The texels of the same look-ups.
template <class T>
void footprints(const SampledTexture& texture, LookUp kind, const LookUpArguments<T>& arguments,
                const TapArrays& taps);

enum class Difference { x, y, width };

/// dFdx, dFdy or fwidth of `lanes` elements.
template <class T>
void differences(Difference which, DerivativeMode mode, std::size_t lanes, const T* values,
                 T* results);

}  // namespace quadrel::python
