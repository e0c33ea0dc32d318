#include "cli/compare/legal.hpp"

#include <CLI/CLI.hpp>
#include <charconv>

#include "cli/common/arguments.hpp"
#include "film/legal/ranged_channels.hpp"
#include "quadrel/error.hpp"

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
    if (!channels.empty())
        keep_ranged_channels("--channels", parse_list("--channels", channels),
                             images.reference.film, images.test.film);
    LegalJudgement judgement{
        take_apart(images.reference.film, images.reference.file.string()), images.test.film, {}};
    LegalReference& reference = judgement.reference;
    images.reference.film = reference.values;
    std::map<std::string, Encoding> encodings;
    for (Film* film : {&reference.values, &reference.lo, &reference.hi})
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
