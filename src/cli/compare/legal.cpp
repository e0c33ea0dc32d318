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

ImageJudgement judge_legal(const LegalRules& rules, Images images, const std::string& channels) {
    if (!channels.empty())
        keep_ranged_channels("--channels", parse_list("--channels", channels),
                             images.reference.film, images.test.film);
    LegalRules own = rules;
    own.left_out = images.rules.left_out;
    ImageJudgement judgement =
        judge_images(images.reference, images.test, own, images.preparation.encoding);
    images.preparation.reference_storage = storage_text(images.reference);
    images.preparation.test_storage = storage_text(images.test);
    judgement.report.preparation = images.preparation;
    return judgement;
}

}  // namespace quadrel::cli
