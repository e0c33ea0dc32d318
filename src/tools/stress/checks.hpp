// What is asked of a scene: drawn by every number type, and looked at.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "stress/scenes/scene.hpp"

namespace quadrel::stress {

/// Something that must not be. Of one kind and place there may be many.
struct Finding {
    std::string kind;    ///< "NaN", "status", "other bits", "refused"
    std::string where;   ///< what tells it from others: channel, stage
    std::string detail;  ///< of this one

    /// What a published text gives it gives here, too: to be known, and no error.
    static constexpr const char* of_listing = "NaN of a listing";
    bool is_error() const { return kind != of_listing; }
};

/// How far floats lie from doubles in one scene: pixels by distance in texels.
struct Departure {
    std::string frame, trace;
    std::uint64_t pixels = 0;      ///< that both hit, certified
    std::uint64_t beyond = 0;      ///< of these: half a texel or more apart
    std::uint64_t from_uv = 0;     ///< of those: the texture coordinate's own rounding is as large
    std::uint64_t from_frame = 0;  ///< else: the rays end half a texel apart
    std::uint64_t from_grazing = 0;   ///< else: the first hit moves fast with the ray there
    std::uint64_t from_search = 0;    ///< else
    std::uint64_t search_beyond = 0;  ///< of all: the float hit lies so far from its own ray's
    std::uint64_t double_beyond = 0;  ///< likewise the double hit from its
    double rays_99 = 0;      ///< texels between the two certified hits, of 99 % of the pixels
    double searches_99 = 0;  ///< texels by which the two searches err apart, likewise
};

struct SceneResult {
    std::vector<Finding> findings;
    bool refused = false;  ///< a message said why, before anything was drawn
    std::string refusal;
    std::map<std::uint32_t, std::uint64_t> statuses;  ///< pixels by hit.status, by float
    std::uint64_t fragments = 0, certified = 0;
    std::uint64_t left_out = 0;  ///< pixels that would have taken too long
    bool judged = true;  ///< whether the oracle was asked: not where rays pass too many tiles
    std::vector<Departure> departures;
};

/// Look-ups of a drawing that are waited for, unless another number is given: some seconds of plain
/// numbers for all drawings of a scene.
inline constexpr double usual_look_ups = 1e6;

struct CheckOptions {
    std::uint64_t sample = 0;  ///< varies what is done beside the usual, by its bits
    /// That drawing all pixels once may take; of a scene that takes more a part is drawn.
    double look_ups = usual_look_ups;
};

/// Draws scene.json of a folder.
SceneResult check_scene(const std::filesystem::path& folder, const StressScene& scene,
                        const CheckOptions& options);

}  // namespace quadrel::stress
