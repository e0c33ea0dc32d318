// How far a run's hits are from the true first ones: what `quadrel errors` says of the same scene.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "quadrel/errors.hpp"
#include "quadrel/film/film.hpp"

namespace quadrel::sweep {

/// The run's errors. `search` is that of the search alone, on the exact frame; `whole` that of what
/// is drawn, which holds the error of the scene's frame as well (quadrel/errors.hpp).
struct RunError {
    std::uint64_t judged = 0, certified = 0;  ///< pixels; of these those whose truth is proven
    ErrorPartSummary whole, search;

    /// Of the search, by pixel: texels from the true hit, NaN where that is not known.
    std::vector<float> texels;
    std::vector<ErrorKind> kinds;
    double mean_texels = 0;
    double wrong = 0;  ///< share of the judged that are further off than the plan allows, or NaN
    std::array<double, error_kinds> wrong_kinds{};  ///< the same by kind
    double nan = 0;  ///< share of the judged whose distance is not finite

    /// What so many per cent of the finite distances do not exceed; NaN where there are none.
    double texels_at(double percent) const;
};

/// The channels that `run_error` reads.
std::vector<std::string> run_error_channels();

/// Of a film with these channels. `tolerance`: in texels.
RunError run_error(const Film& film, double tolerance);

/// The spread of a part's measure: "s" or "uv". Throws UsageError where it has none.
const ErrorSpread& spread_of(const ErrorPartSummary& part, const std::string& measure);

}  // namespace quadrel::sweep
