// Permitted errors that cannot be had as a range: a look-up's texel weights, its level of detail,
// what it filters, the ray's K and depth rate. The stages of a group run once more on an
// implementation's own earlier values, moved by such an error; what it has must lie between the
// results.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "conformance/judge/groups.hpp"
#include "quadrel/film/film.hpp"

namespace quadrel::conformance {

/// OpenGL states none of these. Weights of 8 bits, rounded, are off by up to 2^-9; mip levels of
/// implementations by up to 0.043 (data/gl), where 2^-4 is assumed (data/limits); K by some ulps of
/// its terms.
struct PermittedErrors {
    /// 16 ulp of a vector's longest component: GLSL permits 2 to 7 for each square root, quotient
    /// and normalize, of which a stage has a few in a row.
    double rounding = 0x1p-19;
    double height = 0x1p-22;  ///< of hit.s: two ulp of the relief's height, 1
    double weight = 0x1p-9;   ///< of a texel, each axis
    double level = 0x1p-4;
    /// Of K, of r and of the vector to the eye that a vertex program hands on, relative.
    double ray = 0x1p-20;
    double normal = 0x1p-20;  ///< of each component of the frame\'s normal
    double texel = 0x1p-16;   ///< of a filtered height, relative: `filtered` of data/limits
    double depth = 0x1p-20;   ///< of a fragment in its window, relative: 16 ulp
};

/// One way to move what a group's stages are given.
struct Perturbation {
    std::string name;
    double u = 0, v = 0;  ///< the place of look-ups moves by so many texels of the height map
    double level = 0;     ///< gradients are those of a footprint 2^level as long
    double ray = 0;       ///< K, and the relief's depth, grow by this part of them
    double rate = 0;      ///< r grows by this part of it, by which rays bend over curved reliefs
    double texel = 0;     ///< heights grow by this part of them
    /// Components of P, or of the hit's for shadows, grow by these parts, and turn the ray from
    /// the eye, or to the light.
    std::array<double, 3> turn{};
    std::array<double, 3> tilt{};  ///< is added to the frame\'s normal, which has lights behind it
    /// The eye moves along the object's axes by these parts of its distance from the object's
    /// origin, for searches whose ray comes from a vertex program: no image has that.
    std::array<double, 3> eye{};
};

/// Those that a group's stages may make; none of groups that look nothing up. `vertex_rays`:
/// whether searches take rays from vertex programs. First each error in full, then parts of it:
/// searches are not continuous, and where the whole of an error flips a test, a part of it may not.
std::vector<Perturbation> perturbations_of(GroupKind group, const PermittedErrors& errors,
                                           bool vertex_rays);

/// The parts of errors that are tried.
inline constexpr double permitted_parts[] = {1, 0x1p-2, 0x1p-4, 0x1p-6};

struct TexelSize {
    double u = 0, v = 0;  ///< in UV; 0: there is no height map
};

/// The earlier values, moved; heights are not among them. What a search starts from moves with uv,
/// what is looked up at a hit with hit.uv.
Film perturbed(Film film, GroupKind group, const Perturbation& perturbation,
               const TexelSize& texel);

/// By how much the search's result has moved with what it started from, for channels hit.U, hit.V.
double moved_along(const std::string& channel, GroupKind group, const Perturbation& perturbation,
                   const TexelSize& texel);

}  // namespace quadrel::conformance
