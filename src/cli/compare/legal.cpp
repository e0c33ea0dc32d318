#include "cli/compare/legal.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <set>

#include "cli/common/arguments.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/channels.hpp"
#include "text/suggest.hpp"

namespace quadrel::cli {
namespace {

double parse_share(const std::string& option, const std::string& text, double otherwise) {
    if (text.empty()) return otherwise;
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end || !(value >= 0 && value <= 1))
        throw UsageError(option + ": found \"" + text + "\", expected a share, 0 to 1");
    return value;
}

/// The channel that a plane of the reference says something of.
std::string judged_name(const std::string& plane) {
    for (const std::string prefix : gpu_range_prefixes)
        if (plane.starts_with(prefix)) return plane.substr(prefix.size());
    return plane;
}

bool is_meant(const std::string& channel, const std::string& request) {
    return channel == request || channel.starts_with(request + ".");
}

/// Drops the channels that the comma-separated `list` does not name, their ranges with them.
void select_judged(const std::string& list, Film& reference, Film& test) {
    const std::vector<std::string> requests = parse_list("--channels", list);
    std::set<std::string> ranged;
    for (const Plane& plane : reference.planes)
        if (judged_name(plane.name) != plane.name) ranged.insert(judged_name(plane.name));
    if (ranged.empty()) return;  // which is said of the reference as a whole
    for (const std::string& request : requests)
        if (std::none_of(ranged.begin(), ranged.end(),
                         [&](const std::string& name) { return is_meant(name, request); }))
            throw UsageError("--channels: the reference holds no range of \"" + request +
                             "\", expected " + one_of(request, ranged));
    const auto unwanted = [&](const Plane& plane) {
        return std::none_of(requests.begin(), requests.end(), [&](const std::string& request) {
            return is_meant(judged_name(plane.name), request);
        });
    };
    std::erase_if(reference.planes, unwanted);
    std::erase_if(test.planes, unwanted);
}

/// Rounds `film`, of the reference, and the test image's floats to what an encoding holds.
std::map<std::string, Encoding> encode_film(Film& film, const Images& images, Film& encoded) {
    const auto is_float = [&](const Plane& plane) {
        const Plane* other = images.test.film.find(plane.name);
        const Plane* value = images.reference.film.find(plane.name);
        return value->type == ChannelType::float32 && other != nullptr &&
               other->type == ChannelType::float32;
    };
    ComparableImage reference{
        images.reference.file, {film.frame, film.window, {}}, images.reference.stored, {}};
    ComparableImage test{images.test.file, {film.frame, film.window, {}}, images.test.stored, {}};
    for (const Plane& plane : film.planes)
        if (is_float(plane)) {
            reference.film.planes.push_back(plane);
            test.film.planes.push_back(*images.test.film.find(plane.name));
        }
    const auto encodings = encode_both(reference, test, images.preparation.encoding);
    for (Plane& plane : reference.film.planes) *film.find(plane.name) = std::move(plane);
    for (Plane& plane : test.film.planes) *encoded.find(plane.name) = std::move(plane);
    return encodings;
}

}  // namespace

void add_legal_options(CLI::App& verb, LegalArguments& legal) {
    verb.add_flag("--legal", legal.wanted,
                  "judge TEST by the ranges that REF holds: gpu.lo.*, gpu.hi.*, gpu.paths.*");
    const auto add = [&](const char* option, std::string& value, const char* help) {
        verb.add_option(option, value, help)->type_name("SHARE");
    };
    add("--widest", legal.widest,
        "a range beyond this share of its channel's extent says little (0.1)");
    add("--most-ambiguous", legal.most_ambiguous, "share of pixels that may be ambiguous (0.05)");
    add("--most-unconstrained", legal.most_unconstrained,
        "share of pixels that may be unconstrained (0.01)");
}

LegalRules legal_rules(const LegalArguments& legal) {
    LegalRules rules;
    struct {
        const char* option;
        const std::string& text;
        double& value;
    } const shares[] = {
        {"--widest", legal.widest, rules.widest},
        {"--most-ambiguous", legal.most_ambiguous, rules.most_ambiguous},
        {"--most-unconstrained", legal.most_unconstrained, rules.most_unconstrained}};
    for (const auto& share : shares) {
        if (!legal.wanted && !share.text.empty())
            throw UsageError(std::string(share.option) + ": expected with --legal only");
        share.value = parse_share(share.option, share.text, share.value);
    }
    return rules;
}

LegalJudgement judge_legal(const LegalRules& rules, Images images, const std::string& channels) {
    if (!channels.empty()) select_judged(channels, images.reference.film, images.test.film);
    LegalJudgement judgement{
        take_apart(images.reference.film, images.reference.file.string()), images.test.film, {}};
    LegalReference& reference = judgement.reference;
    images.reference.film = reference.values;
    std::map<std::string, Encoding> encodings;
    for (Film* film :
         {&reference.values, &reference.lo, &reference.hi, &reference.gap_lo, &reference.gap_hi})
        encodings = encode_film(*film, images, judgement.test);
    LegalRules own = rules;
    own.left_out = images.rules.left_out;
    judgement.report = judge(reference, judgement.test, own);
    for (LegalChannelReport& channel : judgement.report.channels)
        if (const auto found = encodings.find(channel.name); found != encodings.end())
            channel.encoding = found->second;
    images.preparation.reference_storage = storage_text(images.reference);
    images.preparation.test_storage = storage_text(images.test);
    judgement.report.preparation = images.preparation;
    return judgement;
}

}  // namespace quadrel::cli
