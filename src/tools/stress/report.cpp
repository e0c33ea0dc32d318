#include "stress/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace quadrel::stress {
namespace {

constexpr std::size_t most_examples = 3;
constexpr const char* status_names[] = {"NONE", "HIT",     "FLOOR", "CAP",
                                        "CLIP", "NOFRAME", "NAN",   "OUTSIDE"};

void add_to(Departure& sum, const Departure& one) {
    sum.pixels += one.pixels;
    sum.beyond += one.beyond;
    sum.from_uv += one.from_uv;
    sum.from_frame += one.from_frame;
    sum.from_grazing += one.from_grazing;
    sum.from_search += one.from_search;
    sum.search_beyond += one.search_beyond;
    sum.double_beyond += one.double_beyond;
}

std::string share(std::uint64_t part, std::uint64_t of) {
    if (of == 0) return "-";
    const double percent = 100 * static_cast<double>(part) / static_cast<double>(of);
    if (percent < 10 || part == of) return fmt::format("{:.{}g}", percent, part == of ? 3 : 2);
    // Nothing is all that is not.
    return fmt::format("{:.4g}", percent < 99.5 ? std::round(percent) : std::min(percent, 99.99));
}

std::string departure_rows(const std::map<std::string, Departure>& rows, const char* room) {
    std::string text = fmt::format(
        "| {} | pixels | half a texel or more, % | of these by uv, % | frame | grazing | search | "
        "float search off, % | double search off, % |\n|---|---|---|---|---|---|---|---|---|\n",
        room);
    for (const auto& [id, d] : rows)
        text += fmt::format("| `{}` | {} | {} | {} | {} | {} | {} | {} | {} |\n", id, d.pixels,
                            share(d.beyond, d.pixels), share(d.from_uv, d.beyond),
                            share(d.from_frame, d.beyond), share(d.from_grazing, d.beyond),
                            share(d.from_search, d.beyond), share(d.search_beyond, d.pixels),
                            share(d.double_beyond, d.pixels));
    return text;
}

}  // namespace

void Report::add(const std::string& scene, const SceneResult& result) {
    ++scenes_;
    refused_ += result.refused;
    if (result.refused) ++refusals_[result.refusal];
    unjudged_ += !result.judged;
    if (result.judged) fragments_ += result.fragments;
    certified_ += result.certified;
    in_part_ += result.left_out > 0;
    left_out_ += result.left_out;
    for (const auto& [status, pixels] : result.statuses) {
        statuses_[status] += pixels;
        if (result.left_out > 0) pixels_ += pixels;
    }
    for (const Finding& finding : result.findings) {
        errors_ += finding.is_error();
        FindingGroup& group = findings_[{finding.kind, finding.where}];
        if (++group.count <= most_examples) group.scenes.push_back(scene + ": " + finding.detail);
    }
    for (const Departure& one : result.departures) {
        add_to(by_frame_[one.frame], one);
        add_to(by_trace_[one.trace], one);
    }
}

std::string Report::findings_text(bool errors) const {
    std::string text;
    for (const auto& [key, group] : findings_) {
        if (Finding{key.first, "", ""}.is_error() != errors) continue;
        std::string examples;
        for (const std::string& one : group.scenes)
            examples += (examples.empty() ? "" : "; ") + one;
        text +=
            fmt::format("| {} | {} | {} | {} |\n", key.first, key.second, group.count, examples);
    }
    if (text.empty()) return "";
    return "| finding | where | times | for example |\n|---|---|---|---|\n" + text + "\n";
}

std::string Report::departures_text() const {
    return departure_rows(by_frame_, "frame") + "\n" + departure_rows(by_trace_, "trace");
}

std::string Report::left_out_text() const {
    if (in_part_ == 0) return "";
    return fmt::format(
        " {} would have taken too long: {} of their {} pixels, around the middle, have been drawn.",
        in_part_, pixels_, pixels_ + left_out_);
}

std::string Report::to_text() const {
    std::string text = fmt::format(
        "{} scenes, {} of them refused with a reason; {} with rays too long to be judged; of {} "
        "fragments of the others {} % have a certified hit.{}\n\nPixels by status:",
        scenes_, refused_, unjudged_, fragments_, share(certified_, fragments_), left_out_text());
    for (const auto& [status, pixels] : statuses_)
        text += fmt::format(" {} {}", status < std::size(status_names) ? status_names[status] : "?",
                            pixels);
    text += errors_ > 0
                ? "\n\n" + findings_text(true)
                : "\n\nNo crash, no hang, no NaN, no status without a reason, the same bits on "
                  "lanes and plain numbers.\n\n";
    text += "NaN where a listing gives it:\n\n" + findings_text(false);
    text += "Hits of floats beside those of doubles:\n\n" + departures_text();
    if (!refusals_.empty()) text += "\nReasons of refusal:\n\n";
    for (const auto& [reason, count] : refusals_) text += fmt::format("- {}: {}\n", count, reason);
    return text;
}

}  // namespace quadrel::stress
