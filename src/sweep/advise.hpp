// Which search is exact enough on a scene's map, and what it costs.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/document/json.hpp"
#include "quadrel/errors.hpp"
#include "quadrel/relief/trace/oracle/first_hit.hpp"
#include "sweep/plan/plan.hpp"

namespace quadrel::sweep {

struct Question {
    std::filesystem::path scene;         ///< as load_scene takes it
    std::vector<std::string> overrides;  ///< "key=value"
    double texels = 0.5;                 ///< from the true hit, at most, at `percent` of the pixels
    double percent = 99;
    std::vector<double> angles;    ///< degrees between view and normal, ascending
    std::optional<double> budget;  ///< look-ups per fragment, in lockstep, at most
    int side = 96;                 ///< pixels of the frames that are judged
    std::string number = "float";
    std::function<void(std::size_t done, std::size_t all, const std::string& name)> progress;
};

/// A search with one set of parameters, over all angles.
struct Candidate {
    Algorithm algorithm;
    oracle::Surface surface{};  ///< that it searches, and is judged by
    std::string maps;           ///< derived maps that it reads, "a, b"; empty: heights alone
    double look_ups = 0;        ///< a fragment in lockstep (measure.hpp), mean over angles
    double most_look_ups = 0;   ///< at the dearest angle
    double texels = 0;          ///< the percentile at the worst angle
    double worst_angle = 0;     ///< where that is
    std::array<double, error_kinds> wrong{};  ///< shares that are beyond the error there, by kind
    double nan = 0;                           ///< share without a finite distance there
    std::string failed;                       ///< why it could not be judged
    bool is_good = false;                     ///< keeps the error
    bool is_affordable = true;                ///< keeps the budget
};

/// Hits of another surface than the scene's are not those that the scene shows, however exact they
/// are: such searches stand apart.
struct Advice {
    oracle::Surface surface{};        ///< the scene's
    std::vector<Candidate> searches;  ///< of this surface
    std::vector<Candidate> others;    ///< of another one
};

/// The surface that the scene's first material shows: that which its own search reads; where it has
/// none that is judged, blocks if its sampler takes the nearest texel, else bilinear patches.
oracle::Surface surface_of_scene(const Scene& scene);

/// All corrected rows, those that count steps with a ladder of 4 to 1024. Of a ladder no more is
/// tried than the first that keeps the error. Of each list good and affordable ones come first,
/// cheapest first; then the others, the most exact ones first; then what could not be judged.
/// Throws as `render` does where no row can be judged.
Advice advise(const Question& question);

/// Markdown tables of at most `most` rows of each kind and what they say, in words.
std::string advice_text(const Question& question, const Advice& advice, std::size_t most);

/// All of it: bench/README.md has the fields.
Json advice_json(const Question& question, const Advice& advice);

/// The error and the budget.
bool keeps_all(const Candidate& candidate);

/// "0.5texel", "0.5" or "1texels" as texels. Throws UsageError.
double parse_texels(const std::string& text);

/// "0..75" (every 15 degrees, both ends), "0..75:5" or "0,30,60". Throws UsageError.
std::vector<double> parse_angles(const std::string& text);

}  // namespace quadrel::sweep
