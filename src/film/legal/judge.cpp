#include <fmt/format.h>

#include <algorithm>

#include "film/legal/verdict.hpp"

namespace quadrel {
namespace {

struct WorstPixel {
    double distance;
    LegalPixel pixel;
};

/// Walks over one channel's pixels, in order.
class ChannelJudge {
  public:
    ChannelJudge(const LegalReference& reference, std::size_t plane, const Plane& test,
                 const LegalRules& rules)
        : reference_(reference), plane_(plane), test_(test), rules_(rules) {
        const Plane& values = reference.values.planes[plane];
        report_.name = values.name;
        report_.reference_type = values.type;
        report_.test_type = test.type;
        report_.extent = extent_of(reference.values, values, rules.left_out);
    }

    void add(std::size_t i, std::size_t test_pixel, Covered covered) {
        const LegalRange range = range_at(reference_, plane_, i);
        const Plane& values = reference_.values.planes[plane_];
        ++report_.pixels;
        report_.empty_ranges += range.paths > 0 && range.lo > range.hi;
        report_.reference_outside += verdict(range, value_of(values, i)) == LegalVerdict::fail;
        const bool missing = test_pixel == no_pixel;
        const double value = missing ? 0 : value_of(test_, test_pixel);
        const bool alone = covered == Covered::alone_decided;
        const LegalVerdict found = missing || alone                      ? LegalVerdict::fail
                                   : covered == Covered::alone_undecided ? LegalVerdict::ambiguous
                                                                         : verdict(range, value);
        ++report_.counts[static_cast<std::size_t>(found)];
        if (found != LegalVerdict::fail) return;
        report_.missing += missing;
        report_.nan += !missing && value != value;
        keep_worst(i, range, missing || alone ? beyond_all : distance_from(range, value),
                   missing ? std::nullopt : std::optional(test_.bits[test_pixel]), alone);
    }

    LegalChannelReport finish() {
        const auto exceeds = [&](LegalVerdict verdict, double most) {
            return static_cast<double>(report_.count(verdict)) >
                   most * static_cast<double>(report_.pixels);
        };
        report_.too_ambiguous = exceeds(LegalVerdict::ambiguous, rules_.most_ambiguous);
        report_.too_unconstrained = exceeds(LegalVerdict::unconstrained, rules_.most_unconstrained);
        for (const WorstPixel& worst : worst_) report_.worst.push_back(worst.pixel);
        return report_;
    }

  private:
    static constexpr double beyond_all = std::numeric_limits<double>::infinity();

    LegalVerdict verdict(const LegalRange& range, double value) const {
        return legal_verdict(range, value, report_.extent, rules_.widest);
    }

    void keep_worst(std::size_t i, const LegalRange& range, double distance,
                    std::optional<std::uint32_t> test, bool alone) {
        const Window& window = reference_.values.window;
        const auto width = static_cast<std::size_t>(window.width());
        const WorstPixel one{
            distance,
            {window.x0 + static_cast<int>(i % width), window.y0 + static_cast<int>(i / width),
             reference_.values.planes[plane_].bits[i], test, range, alone}};
        const auto worse = [](const WorstPixel& a, const WorstPixel& b) {
            return a.distance > b.distance;
        };
        if (worst_.size() == most_worst_pixels && !worse(one, worst_.back())) return;
        worst_.insert(std::upper_bound(worst_.begin(), worst_.end(), one, worse), one);
        if (worst_.size() > most_worst_pixels) worst_.pop_back();
    }

    const LegalReference& reference_;
    std::size_t plane_;
    const Plane& test_;
    const LegalRules& rules_;
    LegalChannelReport report_;
    std::vector<WorstPixel> worst_;
};

std::string list_of(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += " " + name;
    return text;
}

/// What keeps coverage from being judged.
std::string note_on_coverage(const LegalReference& reference, const Film& test) {
    if (!reference.undecided) return "";
    const char* const side = !reference.coverage         ? "reference"
                             : test.find("A") == nullptr ? "test image"
                                                         : nullptr;
    return side ? fmt::format("coverage is not judged: the {} lacks A", side) : "";
}

/// What is not judged and does not matter.
std::vector<std::string> notes_on(const LegalReference& reference, const Film& test) {
    std::vector<std::string> notes, unknown;
    if (!reference.rangeless.empty())
        notes.push_back("not judged, the reference holds no range of:" +
                        list_of(reference.rangeless));
    for (const Plane& plane : test.planes) {
        const auto& rangeless = reference.rangeless;
        const bool known = reference.values.find(plane.name) != nullptr ||
                           std::count(rangeless.begin(), rangeless.end(), plane.name) > 0 ||
                           (plane.name == "A" && reference.coverage) ||
                           (plane.name == "undecided" && reference.undecided);
        if (!known) unknown.push_back(plane.name);
    }
    if (!unknown.empty()) notes.push_back("not judged, the reference lacks:" + list_of(unknown));
    if (std::string note = note_on_coverage(reference, test); !note.empty())
        notes.push_back(std::move(note));
    return notes;
}

/// Whether pixels of the two can be told to be the same.
bool compare_frames(const Film& reference, const Film& test, LegalReport& report) {
    if (reference.frame == test.frame) return true;
    const auto text = [](const Window& frame) {
        return fmt::format("{}x{} at {},{}", frame.width(), frame.height(), frame.x0, frame.y0);
    };
    report.structure.push_back(
        fmt::format("frame: reference {}, test {}", text(reference.frame), text(test.frame)));
    return false;
}

}  // namespace

bool LegalReport::passes() const {
    return structure.empty() && !channels.empty() &&
           std::all_of(channels.begin(), channels.end(),
                       [](const LegalChannelReport& channel) { return channel.passes(); });
}

LegalReport judge(const LegalReference& reference, const Film& test, const LegalRules& rules) {
    LegalReport report{{}, rules, reference.structure, notes_on(reference, test)};
    if (!compare_frames(reference.values, test, report)) return report;
    const std::vector<bool>& left_out = rules.left_out;
    report.left_out =
        static_cast<std::uint64_t>(std::count(left_out.begin(), left_out.end(), true));
    const std::vector<std::size_t> pixels = pixels_in(test, reference.values.window);
    const std::vector<Covered> covered = compare_coverage(reference, test, pixels);
    for (std::size_t i = 0; i < covered.size(); ++i)
        if (left_out.empty() || !left_out[i]) {
            report.alone_unknown += covered[i] == Covered::alone_unknown;
            report.alone_undecided += covered[i] == Covered::alone_undecided;
            report.alone_decided += covered[i] == Covered::alone_decided;
        }
    for (std::size_t plane = 0; plane < reference.values.planes.size(); ++plane) {
        const std::string& name = reference.values.planes[plane].name;
        const Plane* other = test.find(name);
        if (other == nullptr) {
            report.structure.push_back("channel " + name + ": missing in the test image");
            continue;
        }
        ChannelJudge channel(reference, plane, *other, rules);
        for (std::size_t i = 0; i < pixels.size(); ++i)
            if (left_out.empty() || !left_out[i]) channel.add(i, pixels[i], covered[i]);
        report.channels.push_back(channel.finish());
    }
    return report;
}

}  // namespace quadrel
