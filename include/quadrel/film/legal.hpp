// Whether an image is one that a conforming implementation may give: its values against the range
// that the reference's file holds for each.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "quadrel/compare.hpp"
#include "quadrel/film/film.hpp"
#include "quadrel/film/preview.hpp"

namespace quadrel {

/// Of a value. Only `pass` is agreement: of ambiguous and unconstrained ones nothing wrong is
/// known.
enum class LegalVerdict : std::int32_t {
    pass,           ///< in its range, which is narrow and one
    ambiguous,      ///< in one of several ranges with gaps between them, which are narrow together;
                    ///< or covered on one side alone, where that may be decided either way
    unconstrained,  ///< not outside, but the range is unknown, infinite or wide: it says little
    fail            ///< outside of its range; a NaN that is not permitted; no such pixel; covered
                    ///< on one side alone, where that is decided
};
inline constexpr std::size_t legal_verdict_count = 4;

const char* legal_verdict_name(LegalVerdict verdict);

/// What one value may be: anything from lo to hi. A NaN at both ends: NaN alone; at one end: NaN
/// beside all that the other end permits.
struct LegalRange {
    float lo = 0, hi = 0;
    std::uint32_t paths =
        0;  ///< disjoint ranges between the ends; 0: nothing is known of the value
    /// No value lies between these two, the widest gap of the ranges; without effect where they are
    /// equal, not in order, or NaN.
    float gap_lo = 0, gap_hi = 0;
};

/// A reference taken apart. The films have the same planes, by the names of the channels.
struct LegalReference {
    Film values, lo, hi, paths;          ///< X, gpu.lo.X, gpu.hi.X, gpu.paths.X
    Film gap_lo, gap_hi;                 ///< gpu.gap.lo.X, gpu.gap.hi.X; where absent, gpu.hi.X
    std::vector<std::string> structure;  ///< a line for each channel whose parts are incomplete
    std::vector<std::string> rangeless;  ///< channels of which there is a value alone
    /// A, which is above 0 where something is covered, and `undecided`, whose bit
    /// undecided_presence says where an implementation may decide that otherwise.
    std::optional<Plane> coverage{}, undecided{};
};

/// Takes `reference` apart; channels whose parts are incomplete are left out. Throws InputError,
/// which names `file`, if it has no ranges at all.
LegalReference take_apart(const Film& reference, const std::string& file);

struct LegalRules {
    /// A range, less its widest gap, is wide beyond this share of the channel's extent
    /// (LegalChannelReport::extent).
    double widest = 0.1;
    double most_ambiguous = 0.05, most_unconstrained = 0.01;  ///< shares of a channel's pixels
    std::vector<bool> left_out{};  ///< pixels, row by row, at which nothing is judged; or empty
};

/// One value that fails, in image coordinates; values by their bits.
struct LegalPixel {
    int x = 0, y = 0;
    std::uint32_t reference = 0;
    std::optional<std::uint32_t> test{};  ///< none: the test image lacks the pixel
    LegalRange range{};
    bool covered_alone = false;  ///< on one side, where that is decided
};

struct LegalChannelReport {
    std::string name;
    ChannelType reference_type = ChannelType::float32, test_type = ChannelType::float32;
    Encoding encoding = Encoding::none;
    /// What `widest` is a share of: by how much the channel's finite reference values differ; at
    /// least 10 % of the largest magnitude in its vector (N.X: of N.X, N.Y and N.Z), or 10 * 2^-20
    /// where all of that is 0.
    double extent = 0;
    std::uint64_t pixels = 0;
    std::array<std::uint64_t, legal_verdict_count> counts{};  ///< by LegalVerdict
    std::uint64_t nan = 0, missing = 0;                       ///< of those that fail
    std::uint64_t empty_ranges = 0;       ///< lo above hi: these fail, whatever the value
    std::uint64_t reference_outside = 0;  ///< where the reference's own value would fail
    bool too_ambiguous = false, too_unconstrained = false;  ///< more than the rules permit
    /// Those that fail: missing pixels and NaN first, then by the distance from the range, then
    /// from the top-left, row by row.
    std::vector<LegalPixel> worst;

    std::uint64_t count(LegalVerdict verdict) const {
        return counts[static_cast<std::size_t>(verdict)];
    }
    bool passes() const {
        return count(LegalVerdict::fail) == 0 && !too_ambiguous && !too_unconstrained;
    }
};

struct LegalReport {
    std::optional<Preparation> preparation{};  ///< the caller's
    LegalRules rules;
    std::vector<std::string> structure;  ///< a line each: frames or channels that do not fit
    std::vector<std::string> notes;      ///< a line each: what is not judged and does not matter
    std::uint64_t left_out = 0;
    /// Pixels that are covered on one side alone: where that is undecided they are ambiguous in all
    /// channels, elsewhere they fail in all. Of a reference without `undecided` nothing is known:
    /// their values are judged as others are.
    std::uint64_t alone_undecided = 0, alone_decided = 0, alone_unknown = 0;
    std::vector<LegalChannelReport> channels{};

    /// Whether nothing fails, no channel is lacking, and the shares are within the rules.
    bool passes() const;
};

/// The verdict on one value, -inf to +inf or NaN, where the channel's extent is `extent`.
LegalVerdict legal_verdict(const LegalRange& range, double value, double extent, double widest);

/// Judges each channel of the reference. Windows may differ within one frame: pixels that `test`
/// lacks fail.
LegalReport judge(const LegalReference& reference, const Film& test, const LegalRules& rules);

/// For people: a table with a line per channel, then the worst pixels.
std::string to_text(const LegalReport& report);
/// One JSON object. NaN and infinities are strings.
std::string to_json(const LegalReport& report);

/// A picture of the verdicts: the worst of each pixel over all channels, then a panel for each
/// vector or single channel, with its name and the four colours: blue pass, yellow ambiguous, gray
/// unconstrained, vermilion fail; black is not judged. Told apart with any kind of colour blindness
/// (Okabe and Ito), and by their lightness. Throws UsageError if no channel is judged.
Picture legal_picture(const LegalReference& reference, const Film& test, const LegalRules& rules);

}  // namespace quadrel
