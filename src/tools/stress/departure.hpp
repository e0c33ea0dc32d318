// How far the hits of floats lie from those of doubles, and why.
#pragma once

#include "quadrel/film/film.hpp"
#include "quadrel/scene/scene.hpp"
#include "stress/checks.hpp"

namespace quadrel::stress {

inline constexpr double half_texel = 0.5;

/// Distances of one pixel, in texels of level 0; NaN where not both renders have a certified hit.
struct PixelDeparture {
    double rays = 0;           ///< between the two certified hits: what the rays' rounding does
    double hits = 0;           ///< between the two hits
    double single_search = 0;  ///< of the float hit from the certified one of its own ray
    double double_search = 0;  ///< likewise of the double hit
    double searches = 0;       ///< between these two
};

/// Films with uv, K, hit, oracle and certified, by float and by double; a texture of that size.
/// Places are compared within a period of the texture.
class Departures {
  public:
    Departures(const Film& single, const Film& exact, int width, int height);
    PixelDeparture at(std::size_t pixel) const;

  private:
    const Film &single_, &exact_;
    double size_[2];
};

/// Texels of the scene's height map, or 64 x 64.
std::array<int, 2> height_size(const Scene& scene);

/// Films of one scene, by float and by double.
Departure departure(const Film& float_film, const Film& double_film, const Scene& scene);

}  // namespace quadrel::stress
