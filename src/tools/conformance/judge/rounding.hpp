// By how much a few roundings may move the values of channels.
#pragma once

#include <string>
#include <vector>

#include "conformance/judge/perturbations.hpp"
#include "quadrel/film/film.hpp"

namespace quadrel::conformance {

/// Of channels of a film, which must outlive it and keep its planes.
class Roundings {
  public:
    Roundings() = default;
    Roundings(const Film& film, const std::vector<std::string>& channels,
              const PermittedErrors& errors);

    /// Of the longest component of the channel's vector at a pixel of the film; of hit.s no less
    /// than of the relief's height, of which it is a difference; of K no less than of gradients of
    /// uv over the relief's depth, of which it is a sum. 0 of integers.
    double of(std::size_t channel, std::size_t pixel) const;

  private:
    struct Channel {
        std::vector<const Plane*> vector;  ///< all of its components; none of integers
        std::vector<const Plane*> gradients;
        const Plane* depth = nullptr;
        double least = 0;
    };

    std::vector<Channel> channels_;
    double rounding_ = 0;
};

}  // namespace quadrel::conformance
