// Which search is exact enough on a scene's map, and what it costs.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "quadrel/errors.hpp"
#include "sweep/plan/plan.hpp"

namespace quadrel::sweep {

struct Question {
    std::filesystem::path scene;         ///< as load_scene takes it
    std::vector<std::string> overrides;  ///< "key=value"
    double texels = 0.5;                 ///< from the true hit, at most, at `percent` of the pixels
    double percent = 99;
    std::vector<double> angles;    ///< degrees between view and normal, ascending
    std::optional<double> budget;  ///< look-ups a fragment, in lockstep, at most
    int side = 96;                 ///< pixels of the frames that are judged
    std::string number = "float";
    std::function<void(std::size_t done, std::size_t all, const std::string& name)> progress;
};

/// A search with one set of parameters, over all angles.
struct Candidate {
    Algorithm algorithm;
    std::string maps;          ///< derived maps that it reads, "a, b"; empty: heights alone
    double look_ups = 0;       ///< a fragment in lockstep (measure.hpp), mean over angles
    double most_look_ups = 0;  ///< at the dearest angle
    double texels = 0;         ///< the percentile at the worst angle
    double worst_angle = 0;    ///< where that is
    std::array<double, error_kinds> wrong{};  ///< shares that are beyond the error there, by kind
    double nan = 0;                           ///< share without a finite distance there
    std::string failed;                       ///< why it could not be judged
    bool is_good = false;                     ///< keeps the error
    bool is_affordable = true;                ///< keeps the budget
};

/// All corrected rows, those that count steps with a ladder of 4 to 1024. Of a ladder no more is
/// tried than the first that keeps the error. Good and affordable ones first, cheapest first; then
/// the others, the most exact ones first. Throws as `render` does where no row can be judged.
std::vector<Candidate> advise(const Question& question);

/// A Markdown table of at most `most` rows of each kind and what it says, in words.
std::string advice_text(const Question& question, const std::vector<Candidate>& candidates,
                        std::size_t most);

/// "0.5texel", "0.5" or "1texels" as texels. Throws UsageError.
double parse_texels(const std::string& text);

/// "0..75" (every 15 degrees, both ends), "0..75:5" or "0,30,60". Throws UsageError.
std::vector<double> parse_angles(const std::string& text);

}  // namespace quadrel::sweep
