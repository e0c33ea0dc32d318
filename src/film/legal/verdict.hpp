// The parts of a judgement: what a plane's bits mean, what belongs together, how a value is judged.
#pragma once

#include <limits>
#include <string>

#include "quadrel/film/legal.hpp"

namespace quadrel {

/// A plane's value; an integer exactly.
double value_of(const Plane& plane, std::size_t i);

/// "N" of N.X, "R G B" of R: what the components of a vector have in common; else the name.
std::string vector_of(const std::string& channel);

/// LegalChannelReport::extent of a plane of `values`, pixels left out aside.
double extent_of(const Film& values, const Plane& plane, const std::vector<bool>& left_out);

/// Whether both images cover a pixel or neither does; else whether the reference says that this may
/// be decided otherwise.
enum class Covered : std::uint8_t { alike, alone_unknown, alone_undecided, alone_decided };

/// Of each pixel of the reference's window, row by row; `pixels` are those of `test` (pixels_in).
/// Alike where a side has no A, and where the test image lacks the pixel.
std::vector<Covered> compare_coverage(const LegalReference& reference, const Film& test,
                                      const std::vector<std::size_t>& pixels);

/// The range of a plane's pixel.
LegalRange range_at(const LegalReference& reference, std::size_t plane, std::size_t i);

/// How far a value that fails lies beyond its range, 0 or more; infinite for NaN, and for all where
/// only NaN is permitted.
double distance_from(const LegalRange& range, double value);

/// The index in `test` of each pixel of the reference's window, or `no_pixel`; row by row.
inline constexpr std::size_t no_pixel = std::numeric_limits<std::size_t>::max();
std::vector<std::size_t> pixels_in(const Film& test, const Window& window);

}  // namespace quadrel
